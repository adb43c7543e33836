// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/mapped_points.h>

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
  } // namespace

  std::vector<MappedPoint>
  mapped_points(const FlowMesh                &mesh,
                const dealii::CellAccessor<2> &cell,
                const int                      stride)
  {
    constexpr double    rounding = 1e-9, beside = 1. / 3;
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
    std::vector<MappedPoint> points;
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
