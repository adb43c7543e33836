// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/csv_file.h>
#include <strait/driver/adhesion_tables.h>

#include <cmath>

namespace strait
{
  void
  write_jumps(const std::string &path, const std::vector<Jump> &jumps)
  {
    CsvFile file;
    file.open(path,
              {"kind",
               "pressure_before",
               "pressure_after",
               "mean_gap_before",
               "mean_gap_after",
               "contact_area_before",
               "contact_area_after",
               "dissipated_energy"});
    // After a pull-off there is no state.
    const auto after = [](const Jump &jump, const double value) {
      return full_precision(jump.is_pull_off ? std::nan("") : value);
    };
    for (const Jump &jump : jumps)
      file.append({jump.is_pull_off                                     ? "pull-off"
                   : jump.after.contact_area > jump.before.contact_area ? "closing"
                                                                        : "opening",
                   full_precision(jump.before.pressure),
                   full_precision(jump.after.pressure),
                   full_precision(jump.before.mean_gap),
                   after(jump, jump.after.mean_gap),
                   full_precision(jump.before.contact_area),
                   after(jump, jump.after.contact_area),
                   full_precision(jump.dissipated)});
  }

  void
  write_relaxation(const std::string &path, const std::vector<RelaxationStep> &relaxation)
  {
    CsvFile file;
    file.open(path, {"iteration", "energy", "residual", "step"});
    for (const RelaxationStep &step : relaxation)
      file.append({std::to_string(step.iteration),
                   full_precision(step.energy),
                   full_precision(step.residual),
                   full_precision(step.step)});
  }
} // namespace strait
