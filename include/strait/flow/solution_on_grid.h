// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/flow/flow_mesh.h>
#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  class ReynoldsSolver;

  /** The potential of @p solver (1 at the inlet, 0 at the outlet) on a box, at the points
   *  of its grid, on the seam that at the inlet. Where the channel does not reach it
   * means nothing. Collective. */
  SlabField potential_on_grid(const ReynoldsSolver &solver, const SlabLayoutPtr &layout);

  /** Rows of equally spaced points, in units of the grid's spacings. */
  struct PointRows
  {
    double x0   = 0.;
    double y0   = 0.;
    double step = 1.;
    int    nx   = 0;
    int    ny   = 0;
  };

  /** The grid points in steps of @p stride that are counted from 0, without the seam's
   *  copies. */
  PointRows rows_of_grid(const PeriodicGrid &grid, int stride);

  /** The points of window @p window. */
  PointRows rows_of_window(const SlabLayout &layout, int window);

  /** One of some rows of points and the unit coordinates (s, t) that it has in a cell. */
  struct PointInCell
  {
    int    ix     = 0;
    int    iy     = 0;
    double s      = 0.;
    double t      = 0.;
    bool   inside = true; // or beside the cell, at the outline

    /** The bilinear function that has the first four of @p corners, in deal.II's order,
     *  at the corners of the cell. */
    template <class Values>
    double
    interpolate(const Values &corners) const
    {
      return (1 - t) * ((1 - s) * corners[0] + s * corners[1]) +
             t * ((1 - s) * corners[2] + s * corners[3]);
    }
  };

  /**
   * Those of @p rows in a cell.
   *
   * Of the box those that lie in the cell or on its lower edges, so that every point
   * belongs to one cell; the rows may go on beyond the seam, by less than a period. Of a
   * seal mesh those in the cell or on any edge, with edges taken as straight; hence along
   * the outline those as well that lie beside the cell by less than a third of it, at the
   * nearest unit coordinates.
   */
  std::vector<PointInCell> points_in_cell(const FlowMesh                &mesh,
                                          const dealii::CellAccessor<2> &cell,
                                          const PointRows               &rows);

  /** The flow at some points, row by row. */
  struct FlowAtPoints
  {
    std::vector<float> pressure; // 1 at the inlet, 0 at the outlet
    std::vector<float> current;  // density of a leak of 1 [1/length]
  };

  /**
   * For pictures: the flow at the points of @p rows, the same on all ranks. The current
   * is |∇ψ| of the stream function: unlike K∇p that does not carry the grid's fine
   * structure of K across coarse cells. Collective.
   */
  FlowAtPoints flow_at_points(const ReynoldsSolver &solver, const PointRows &rows);
} // namespace strait
