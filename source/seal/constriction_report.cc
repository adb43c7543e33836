// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/path_pressure.h>
#include <strait/seal/constriction_report.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace strait
{
  ConstrictionReport
  report_constrictions(const SlabField      &gap,
                       const FlowPath       &path,
                       const ReynoldsSolver &solver)
  {
    ConstrictionReport report;
    report.throat            = measure_throat(gap, path.bottleneck);
    const PeriodicGrid &grid = gap.grid();
    report.points_along      = report.throat.length / std::max(grid.dx(), grid.dy());

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
    report.share_of_worst = drops.front() / total;
    for (double carried = 0; carried < .9 * total; ++report.n_for_90_percent)
      carried += drops[report.n_for_90_percent];
    return report;
  }
} // namespace strait
