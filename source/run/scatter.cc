// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/scatter.h>

#include <cmath>
#include <functional>

namespace strait
{
  std::vector<ScatterRow>
  scatter_of(const std::vector<RealisationRow> &realisations, const Scene &scene)
  {
    using Row = RealisationRow;
    std::vector<ScatterRow> rows;
    const auto              add = [&](const char *quantity, const auto value) {
      std::vector<double> samples;
      for (const Row &row : realisations)
        if (std::isfinite(std::invoke(value, row)))
          samples.push_back(std::invoke(value, row));
      const auto n    = static_cast<double>(samples.size());
      double     mean = samples.empty() ? std::nan("") : 0., square = 0;
      for (const double sample : samples)
        mean += sample / n;
      for (const double sample : samples)
        square += (sample - mean) * (sample - mean);
      rows.push_back({quantity,
                      mean,
                      n > 1 ? std::sqrt(square / (n - 1)) : std::nan(""),
                      samples.size(),
                      realisations.size() - samples.size()});
    };
    if (!scene.programme.find_threshold)
      return rows; // none of them is sought
    add("contact_area", &Row::contact_area);
    add("critical_load", [](const Row &row) { return .5 * (row.lower + row.upper); });
    add("crossover_load", &Row::crossover_load);
    add("crossover_reduced_load", &Row::crossover_reduced_load);
    add("exponent", &Row::exponent);
    if (scene.theory.enabled)
      add("theory_crossover_load", &Row::theory_crossover_load);
    return rows;
  }
} // namespace strait
