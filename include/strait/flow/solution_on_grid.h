// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/flow/flow_mesh.h>
#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  class ReynoldsSolver;

  /** Return the potential of @p solver (1 at the inlet, 0 at the outlet) in the box, at
   *  the points of its grid and windows; on the seam, that at the inlet. Where the
   *  channel does not reach, the value has no meaning. Collective. */
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

  /** Every @p stride-th grid point each way, from point 0, without copies on the seam. */
  PointRows rows_of_grid(const PeriodicGrid &grid, int stride);

  /** The points of window @p window. */
  PointRows rows_of_window(const SlabLayout &layout, int window);

  /** A point (ix, iy) of some rows, with its unit coordinates (s, t) in a cell. */
  struct PointInCell
  {
    int    ix     = 0;
    int    iy     = 0;
    double s      = 0.;
    double t      = 0.;
    bool   inside = true; // false: beside the cell, at the outline

    /** Return the bilinear function with the first four values of @p corners at the
     *  corners of the cell, in deal.II's order. */
    template <class Values>
    double
    interpolate(const Values &corners) const
    {
      return (1 - t) * ((1 - s) * corners[0] + s * corners[1]) +
             t * ((1 - s) * corners[2] + s * corners[3]);
    }
  };

  /**
   * Return the points of @p rows in a cell.
   *
   * In the box these lie inside the cell or on its lower edges, so that every point
   * belongs to one cell; the rows may go on beyond the seam, by less than a period. In a
   * seal mesh they lie inside the cell or on any edge, where edges count as straight. At
   * the outline, points beside the cell by up to a third of its size are therefore
   * included, with the nearest unit coordinates.
   */
  std::vector<PointInCell> points_in_cell(const FlowMesh                &mesh,
                                          const dealii::CellAccessor<2> &cell,
                                          const PointRows               &rows);

  /** The flow at some points, row by row. */
  struct FlowAtPoints
  {
    std::vector<float> pressure; // the potential: 1 at the inlet, 0 at the outlet
    std::vector<float> current;  // density for a leak rate of 1 [1/length]
  };

  /**
   * For pictures: return the flow at the points of @p rows, the same on all ranks. The
   * current is |∇ψ| of the stream function: unlike K∇p, it does not imprint the grid's
   * fine structure of K on coarse cells. Collective.
   */
  FlowAtPoints flow_at_points(const ReynoldsSolver &solver, const PointRows &rows);
} // namespace strait
