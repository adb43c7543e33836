// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/constrictions.h>
#include <strait/flow/grid_points.h>
#include <strait/flow/reynolds_solver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace strait
{
  namespace
  {
    /** The fluid's pressure, 1 at the inlet and 0 at the outlet, at the points of
     *  @p path, the same on all ranks. Collective. */
    std::vector<double>
    pressure_along(const ReynoldsSolver &solver, const FlowPath &path)
    {
      constexpr double                           unknown = -1.;
      std::map<std::pair<int, int>, std::size_t> wanted;
      for (std::size_t k = 0; k < path.points.size(); ++k)
        wanted[{path.points[k].ix, path.points[k].iy}] = k;
      // Of cells that hold the point, and of those beside it, which serve where no other
      // does, on any rank.
      std::vector<double>    result(path.points.size(), unknown), beside(result);
      const auto            &dofs = solver.pressure().dof_handler();
      dealii::Vector<double> corners(dofs.get_fe().n_dofs_per_cell());
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const PointInCell &p : points_in_cell(solver.mesh(), *cell))
            if (const auto point = wanted.find({p.ix, p.iy}); point != wanted.end())
              {
                cell->get_dof_values(solver.pressure().solution(), corners);
                (p.inside ? result : beside)[point->second] = p.interpolate(corners);
              }
      for (std::vector<double> *values : {&result, &beside})
        dealii::Utilities::MPI::max(*values,
                                    solver.mesh().triangulation().get_communicator(),
                                    *values);
      for (std::size_t k = 0; k < result.size(); ++k)
        if (result[k] == unknown)
          result[k] = beside[k];
      // The path may end beyond the outline of a mesh, in the reservoirs, and ends beyond
      // the last grid point of the box, at the outlet.
      if (result.front() == unknown)
        result.front() = 1.;
      for (double &value : result)
        value = std::max(value, 0.);
      return result;
    }
  } // namespace

  ConstrictionReport
  report_constrictions(const Channel &channel, const ReynoldsSolver &solver)
  {
    const FlowPath     &path = channel.paths.front();
    const PeriodicGrid &grid = channel.gap.grid();
    ConstrictionReport  report;
    report.throat       = channel.throat;
    report.points_along = report.throat.length / std::max(grid.dx(), grid.dy());

    const std::vector<double> pressure = pressure_along(solver, path);
    std::vector<double>       drops;
    double                    total = 0;
    for (const Constriction &c : divide_into_constrictions(path.gaps))
      {
        drops.push_back(std::max(pressure[c.first] - pressure[c.last], 0.));
        total += drops.back();
      }
    std::sort(drops.begin(), drops.end(), std::greater<>());
    report.n_constrictions = static_cast<int>(drops.size());
    if (!(total > 0))
      return report;
    report.fraction_at_worst = drops.front() / total;
    for (double carried = 0; carried < .9 * total; ++report.n_for_90_percent)
      carried += drops[report.n_for_90_percent];
    return report;
  }
} // namespace strait
