// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_grid_points_h
#define strait_flow_grid_points_h

namespace strait
{
  /**
   * The grid points, along one axis, of a cell of the quadtree: those that lie in it
   * or on its lower edge, from `first` to before `end` in steps of @p stride that
   * are counted from 0. Integers decide, so every point belongs to one cell.
   */
  struct PointsOfCell
  {
    PointsOfCell(const int cell_index, const int exponent, const int stride = 1)
    {
      const auto raise = [stride](const int k) {
        return (k + stride - 1) / stride * stride;
      };
      if (exponent >= 0)
        {
          first = raise(cell_index << exponent);
          end   = (cell_index + 1) << exponent;
        }
      else
        {
          const int n = 1 << -exponent;
          first       = raise((cell_index + n - 1) / n);
          end         = cell_index % n == 0 ? cell_index / n + 1 : 0;
        }
    }

    bool
    empty() const
    {
      return first >= end;
    }

    int first, end;
  };

  /** The bilinear function of the unit coordinates (s, t) of a cell that has the
   *  first four of @p corners, in deal.II's order, at the corners. */
  template <class Values>
  double
  interpolate_bilinearly(const Values &corners, const double s, const double t)
  {
    return (1 - t) * ((1 - s) * corners[0] + s * corners[1]) +
           t * ((1 - s) * corners[2] + s * corners[3]);
  }
} // namespace strait

#endif
