// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/grid_points.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace strait
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    /** The unit coordinates of a point in a quadrilateral, by Newton's method. */
    std::array<double, 2>
    invert(const dealii::CellAccessor<2> &cell, const Point<2> &x)
    {
      // Half of it is enough for a parallelogram or what is nearly one, as Newton's
      // method squares the error; double of it gives the same to rounding.
      constexpr int      n_steps = 8;
      const Tensor<1, 2> a       = cell.vertex(1) - cell.vertex(0),
                         b       = cell.vertex(2) - cell.vertex(0),
                         c       = cell.vertex(3) - cell.vertex(1) - b;
      double s = .5, t = .5;
      for (int step = 0; step < n_steps; ++step)
        {
          const Tensor<1, 2> off   = x - (cell.vertex(0) + s * a + t * b + s * t * c);
          const Tensor<1, 2> along = a + t * c, up = b + s * c;
          const double       det = along[0] * up[1] - along[1] * up[0];
          if (det == 0)
            break;
          s += (off[0] * up[1] - off[1] * up[0]) / det;
          t += (along[0] * off[1] - along[1] * off[0]) / det;
        }
      return {{s, t}};
    }

    /** From the first to before the last of the points, along one axis of the box. */
    struct Range
    {
      Range(const int cell_index, const int exponent, const int stride)
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

      int first, end;
    };

    std::vector<PointInCell>
    points_in_cell_of_box(const GridCell &cell, const int stride)
    {
      const Range              x(cell.i, cell.exponent, stride);
      const Range              y(cell.j, cell.exponent, stride);
      const double             size = std::ldexp(1., cell.exponent);
      std::vector<PointInCell> points;
      for (int iy = y.first; iy < y.end; iy += stride)
        for (int ix = x.first; ix < x.end; ix += stride)
          points.push_back({ix, iy, ix / size - cell.i, iy / size - cell.j});
      return points;
    }
  } // namespace

  std::vector<PointInCell>
  points_in_cell(const FlowMesh                &mesh,
                 const dealii::CellAccessor<2> &cell,
                 const int                      stride)
  {
    if (mesh.seal() == nullptr)
      return points_in_cell_of_box(mesh.grid_cell(cell), stride);
    // In units of the cell: a point so near to an edge lies on it. Half and double of it
    // decide alike, unless a point happens to lie as near as that.
    constexpr double rounding = 1e-9;
    // In units of the cell: so far beside a cell at the outline, whose edge may be curved
    // away from them, points are taken for its own. Half of it leaves points out beside
    // coarse cells on arcs, double of it looks at more points for nothing.
    constexpr double    beside      = 1. / 3;
    const PeriodicGrid &grid        = mesh.grid();
    const double        slack       = cell.at_boundary() ? beside : rounding;
    const double        spacing[2]  = {grid.dx() * stride, grid.dy() * stride};
    const int           n_points[2] = {grid.nx / stride, grid.ny / stride};
    int                 first[2], last[2];
    for (unsigned int d = 0; d < 2; ++d)
      {
        double low = cell.vertex(0)[d], high = low;
        for (const unsigned int v : cell.vertex_indices())
          {
            low  = std::min(low, cell.vertex(v)[d]);
            high = std::max(high, cell.vertex(v)[d]);
          }
        const double margin = slack * (high - low);
        first[d] = std::max(static_cast<int>(std::ceil((low - margin) / spacing[d])), 0);
        last[d]  = std::min(static_cast<int>(std::floor((high + margin) / spacing[d])),
                           n_points[d]);
      }
    std::vector<PointInCell> points;
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i)
        {
          const auto [s, t] = invert(cell, Point<2>(i * spacing[0], j * spacing[1]));
          const auto within = [s = s, t = t](const double d) {
            return s >= -d && s <= 1 + d && t >= -d && t <= 1 + d;
          };
          if (within(slack))
            points.push_back({i * stride,
                              j * stride,
                              std::clamp(s, 0., 1.),
                              std::clamp(t, 0., 1.),
                              within(rounding)});
        }
    return points;
  }
} // namespace strait
