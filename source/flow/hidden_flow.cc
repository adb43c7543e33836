// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/hidden_flow.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    using Cell = dealii::CellAccessor<2>;

    /** Tells cells on a path, or beside it by no more than their own size. */
    class PathOnMesh
    {
    public:
      PathOnMesh(const Channel &channel, const FlowMesh &mesh)
      {
        if (channel.paths.empty())
          return;
        const SlabLayout    &layout = channel.gap.layout();
        const PeriodicGrid  &grid   = layout.grid();
        dealii::Tensor<1, 2> period;
        period[1 - mesh.axis_along()] = mesh.axis_along() == 0 ? grid.ly : grid.lx;
        // In a window the path may be one period away from the box, and beside it two.
        const int reach = mesh.seal() == nullptr ? 2 : 0;
        for (const GridPoint &on_path : channel.paths.front().points)
          {
            const auto [x, y] = layout.position(on_path.window, on_path.ix, on_path.iy);
            for (int n = -reach; n <= reach; ++n)
              points.push_back(dealii::Point<2>(x, y) + static_cast<double>(n) * period);
          }
        std::sort(points.begin(), points.end(), [](const auto &a, const auto &b) {
          return a[0] < b[0];
        });
      }

      bool
      touches(const Cell &cell) const
      {
        // Steps of the path that are longer than the cell must leave no gap, nor may
        // cells touch at a corner alone: the box counts with one more on each side.
        const auto   box   = cell.bounding_box();
        const double left  = box.lower_bound(0) - box.side_length(0);
        const double right = box.upper_bound(0) + box.side_length(0);
        auto         point =
          std::lower_bound(points.begin(),
                           points.end(),
                           left,
                           [](const auto &a, const double x) { return a[0] < x; });
        for (; point != points.end() && (*point)[0] <= right; ++point)
          if (box.point_inside(*point, 1.))
            return true;
        return false;
      }

    private:
      std::vector<dealii::Point<2>> points; // in the order of x
    };

    /** The flow through @p cell on which both disagree. */
    double
    disagreement(const Cell                &cell,
                 const std::vector<double> &p,
                 const double               conductivity,
                 const std::vector<double> &psi,
                 const double               leak)
    {
      const auto change_along_x = [](const std::vector<double> &corners) {
        return .5 * (corners[1] - corners[0] + corners[3] - corners[2]);
      };
      const auto change_along_y = [](const std::vector<double> &corners) {
        return .5 * (corners[2] - corners[0] + corners[3] - corners[1]);
      };
      const double shape = cell.extent_in_direction(1) / cell.extent_in_direction(0);
      return std::hypot(conductivity * shape * change_along_x(p) +
                          leak * change_along_y(psi),
                        conductivity / shape * change_along_y(p) -
                          leak * change_along_x(psi));
    }
  } // namespace

  dealii::Vector<float>
  hidden_flows(const FlowMesh         &mesh,
               const GapField         &gap,
               const Bracket          &bracket,
               const PotentialProblem &pressure,
               const PotentialProblem &stream_function,
               const Channel          &channel)
  {
    const PathOnMesh path(channel, mesh);
    const double     width = 1. - bracket.lower / bracket.upper;
    const double     through_path =
      channel.paths.empty()
            ? 0.
            : std::min(bracket.upper - bracket.lower,
                   gap.conductivity_of(channel.paths.front().bottleneck_gap));
    dealii::Vector<float> result(mesh.triangulation().n_active_cells());
    for_each_owned_cell(pressure, stream_function, [&](const CellSolutions &here) {
      const auto &[cell, c, p, psi] = here;
      const double conductivity     = pressure.mean_coefficient(c);
      const double resistivity      = stream_function.mean_coefficient(c);
      // Where the gap is wide, rounding alone makes currents larger than the leak.
      const double flow =
        std::min(disagreement(*cell, p, conductivity, psi, bracket.lower),
                 bracket.upper - bracket.lower);
      double hidden = flow / bracket.upper * std::min(flow * resistivity, 1.);
      // A cell without contact takes as much of the drop however small it is.
      const double excess  = resistivity - 1. / conductivity;
      const double on_path = width * std::min(through_path * excess, 1.);
      if (on_path > hidden && path.touches(*cell))
        hidden = on_path;
      result(cell->active_cell_index()) = static_cast<float>(hidden);
    });
    return result;
  }
} // namespace strait
