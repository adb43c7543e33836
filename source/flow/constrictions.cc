// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/leakage.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/flow/solution_on_grid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace strait
{
  namespace
  {
    /** Return the fluid's pressure, scaled to 1 at the inlet and 0 at the outlet, at the
     *  points of @p path, the same on all ranks. Collective. */
    std::vector<double>
    pressure_along(const ReynoldsSolver &solver,
                   const SlabLayout     &layout,
                   const FlowPath       &path)
    {
      constexpr double unknown = -1.;
      // Where on the path the points of each level are, those of the grid first.
      using Places                 = std::map<std::pair<int, int>, std::size_t>;
      const int           n_levels = static_cast<int>(layout.windows().size()) + 1;
      std::vector<Places> wanted(n_levels);
      for (std::size_t k = 0; k < path.points.size(); ++k)
        wanted[path.points[k].window + 1][{path.points[k].ix, path.points[k].iy}] = k;
      std::vector<PointRows> rows = {rows_of_grid(layout.grid(), 1)};
      for (int w = 0; w + 1 < n_levels; ++w)
        rows.push_back(rows_of_window(layout, w));
      if (solver.mesh().seal() != nullptr)
        {
          // The outline of a seal mesh may run along the far edges of the box.
          ++rows.front().nx;
          ++rows.front().ny;
        }
      // From cells that contain the point, and from those beside it, which count only
      // where no cell on any rank contains it.
      std::vector<double>    result(path.points.size(), unknown), beside(result);
      dealii::Vector<double> corners(
        solver.pressure().dof_handler().get_fe().n_dofs_per_cell());
      for (const auto &cell : solver.pressure().cells())
        for (int level = 0; level < n_levels; ++level)
          if (const Places &places = wanted[level]; !places.empty())
            for (const PointInCell &p : points_in_cell(solver.mesh(), *cell, rows[level]))
              if (const auto point = places.find({p.ix, p.iy}); point != places.end())
                {
                  cell->get_dof_values(solver.pressure().solution(), corners);
                  (p.inside ? result : beside)[point->second] = p.interpolate(corners);
                }
      for (std::vector<double> *values : {&result, &beside})
        dealii::Utilities::MPI::max(*values,
                                    solver.mesh().triangulation().get_communicator(),
                                    *values);
      // For a gas the potential that was solved for is not the pressure.
      const double outlet = solver.pressure_at(0.), inlet = solver.pressure_at(1.);
      for (std::size_t k = 0; k < result.size(); ++k)
        {
          const double potential =
            std::clamp(result[k] == unknown ? beside[k] : result[k], 0., 1.);
          result[k] = (solver.pressure_at(potential) - outlet) / (inlet - outlet);
        }
      // The path begins and ends in the reservoirs, perhaps outside the seal mesh.
      result.front() = 1.;
      result.back()  = 0.;
      return result;
    }
  } // namespace

  ConstrictionReport
  report_constrictions(const Channel &channel, const ReynoldsSolver &solver)
  {
    const FlowPath    &path   = channel.paths.front();
    const SlabLayout  &layout = channel.gap.layout();
    ConstrictionReport report;
    report.points_along = channel.throat.length / channel.throat.spacing;

    const std::vector<double> pressure = pressure_along(solver, layout, path);
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
    for (double &drop : drops)
      drop /= total;
    report.fraction_at_worst = drops.front();
    for (double carried = 0; carried < .9; ++report.n_for_90_percent)
      carried += drops[report.n_for_90_percent];
    return report;
  }
} // namespace strait
