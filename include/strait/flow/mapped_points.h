// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_mapped_points_h
#define strait_flow_mapped_points_h

#include <strait/flow/flow_mesh.h>

#include <vector>

namespace strait
{
  /** A grid point and the unit coordinates (s, t) that it has in a cell. */
  struct MappedPoint
  {
    int    ix     = 0;
    int    iy     = 0;
    double s      = 0.;
    double t      = 0.;
    bool   inside = false; // or beside the cell, at the outline
  };

  /**
   * The grid points, in steps of @p stride that are counted from 0, of a cell of a seal
   * mesh; with edges taken as straight, hence along the outline those as well that lie
   * beside the cell by less than a third of it, at the nearest unit coordinates.
   */
  std::vector<MappedPoint> mapped_points(const FlowMesh                &mesh,
                                         const dealii::CellAccessor<2> &cell,
                                         int                            stride = 1);
} // namespace strait

#endif
