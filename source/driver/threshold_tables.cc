// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/text.h>
#include <strait/driver/threshold_tables.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  void
  write_thresholds(const std::string            &path,
                   const std::vector<Threshold> &thresholds,
                   const PeriodicGrid           &grid)
  {
    CsvFile file;
    file.open(path,
              {"critical_load_lower",
               "critical_load_upper",
               "contact_area",
               "x",
               "y",
               "slip_length",
               "contact_solves",
               "fft_pairs"});
    for (const Threshold &t : thresholds)
      file.append({full_precision(t.lower),
                   full_precision(t.upper),
                   full_precision(t.contact_area),
                   full_precision(t.last_constriction.ix * grid.dx()),
                   full_precision(t.last_constriction.iy * grid.dy()),
                   full_precision(t.slip_length),
                   std::to_string(t.n_solves),
                   std::to_string(t.fft_pairs)});
  }

  void
  write_blow_outs(const std::string          &path,
                  const std::vector<BlowOut> &blow_outs,
                  const PeriodicGrid         &grid)
  {
    CsvFile                  file;
    std::vector<std::string> names = {"pressure",
                                      "blow_out_pressure_lower",
                                      "blow_out_pressure_upper",
                                      "contact_area",
                                      "x",
                                      "y",
                                      "solves"};
    if (!blow_outs.empty() && blow_outs.front().resealing)
      names.insert(names.end(), {"resealing_pressure_lower", "resealing_pressure_upper"});
    file.open(path, names);
    for (const BlowOut &found : blow_outs)
      {
        std::vector<std::string> row = {full_precision(found.load),
                                        full_precision(found.lower),
                                        full_precision(found.upper),
                                        full_precision(found.contact_area),
                                        full_precision(found.constriction.ix * grid.dx()),
                                        full_precision(found.constriction.iy * grid.dy()),
                                        std::to_string(found.n_solves)};
        if (found.resealing)
          row.insert(row.end(),
                     {full_precision(found.resealing->lower),
                      full_precision(found.resealing->upper)});
        file.append(row);
      }
  }

  void
  ConstrictionTable::open(const std::string &path)
  {
    file.open(path,
              {"step",
               "pressure",
               "slip_length",
               "reduced_load",
               "x",
               "y",
               "gap",
               "length",
               "width",
               "points_along",
               "share_of_worst",
               "constrictions",
               "constrictions_for_90_percent"});
  }

  void
  ConstrictionTable::append(const Step &step)
  {
    if (!step.flow || !step.flow->constrictions)
      return;
    const ConstrictionReport &report = *step.flow->constrictions;
    const FlowPath           &path   = step.flow->channel.paths.front();
    file.append({std::to_string(step.number),
                 full_precision(step.contact->nominal_pressure),
                 full_precision(step.slip_length),
                 full_precision(step.reduced_load.value_or(std::nan(""))),
                 full_precision(path.bottleneck.ix * step.gap.grid().dx()),
                 full_precision(path.bottleneck.iy * step.gap.grid().dy()),
                 full_precision(report.throat.gap),
                 full_precision(report.throat.length),
                 full_precision(report.throat.width),
                 full_precision(report.points_along),
                 full_precision(report.fraction_at_worst),
                 std::to_string(report.n_constrictions),
                 std::to_string(report.n_for_90_percent)});
  }

  void
  ScalingTable::collect(const Step &step)
  {
    if (step.theory && step.reduced_load && *step.reduced_load > 0 &&
        step.theory->leak_rate != 0)
      theory[step.slip_length].push_back(
        {*step.reduced_load, std::abs(step.theory->leak_rate)});
    if (!step.flow || !step.flow->constrictions || !step.reduced_load ||
        !(*step.reduced_load > 0) || !step.converged())
      return;
    const Throat &throat     = step.flow->constrictions->throat;
    Quantities   &quantities = by_slip_length[step.slip_length];
    const auto    add        = [&](const char *name, const double value) {
      if (!(value > 0))
        return;
      quantities.all[name].push_back({*step.reduced_load, value});
      if (step.doubts.empty())
        quantities.trusted[name].push_back({*step.reduced_load, value});
    };
    add("leak_rate", std::abs(step.flow->leakage.rate));
    add("throat_gap", throat.gap);
    add("throat_length", throat.length);
    add("throat_width", throat.width);
  }

  namespace
  {
    /** The keys of @p map, then what @p transfer_value makes of each value. */
    template <typename Key, typename Value, typename Transfer>
    void
    transfer_map(StateArchive         &archive,
                 std::map<Key, Value> &map,
                 const Transfer       &transfer_value)
    {
      std::vector<Key> keys;
      for (const auto &[key, value] : map)
        keys.push_back(key);
      archive.value(keys);
      for (const Key &key : keys)
        transfer_value(map[key]);
    }
  } // namespace

  void
  ScalingTable::transfer(StateArchive &archive)
  {
    const auto transfer_series = [&](Series &series) {
      std::vector<double> flat;
      for (const auto &[reduced_load, value] : series)
        flat.insert(flat.end(), {reduced_load, value});
      archive.value(flat);
      series.clear();
      for (std::size_t k = 0; k + 1 < flat.size(); k += 2)
        series.push_back({flat[k], flat[k + 1]});
    };
    transfer_map(archive, by_slip_length, [&](Quantities &quantities) {
      transfer_map(archive, quantities.all, transfer_series);
      transfer_map(archive, quantities.trusted, transfer_series);
    });
    transfer_map(archive, theory, transfer_series);
  }

  const ScalingTable::Series *
  ScalingTable::leak_rates(std::map<std::string, Series> Quantities::*which) const
  {
    if (by_slip_length.empty())
      return nullptr;
    const auto &series = by_slip_length.rbegin()->second.*which;
    const auto  found  = series.find("leak_rate");
    return found == series.end() ? nullptr : &found->second;
  }

  ExponentFit
  ScalingTable::leak_rate_fit() const
  {
    const Series *trusted = leak_rates(&Quantities::trusted);
    return trusted == nullptr ? ExponentFit{} : fit_exponent(*trusted, largest);
  }

  double
  ScalingTable::crossover() const
  {
    const Series *all = leak_rates(&Quantities::all);
    return all == nullptr ? std::nan("") : crossover_reduced_load(*all);
  }

  double
  ScalingTable::theory_crossover() const
  {
    return theory.empty() ? std::nan("")
                          : crossover_reduced_load(theory.rbegin()->second);
  }

  void
  ScalingTable::write(const std::string &path, Log &log, MPI_Comm comm) const
  {
    // Where slopes still differ by more than this within a window, a single exponent
    // describes the window, not the threshold.
    constexpr double settled = 0.05;
    CsvFile          file;
    int              rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0)
      file.open(
        path,
        {"quantity", "slip_length", "kind", "from", "to", "exponent", "error", "points"});
    const auto append = [&](const std::string &quantity,
                            const double       slip_length,
                            const char        *kind,
                            const ExponentFit &fit) {
      if (rank == 0)
        file.append({quantity,
                     full_precision(slip_length),
                     kind,
                     full_precision(fit.from),
                     full_precision(fit.to),
                     full_precision(fit.exponent),
                     full_precision(fit.error),
                     std::to_string(fit.n_points)});
    };
    for (const auto &[slip_length, quantities] : by_slip_length)
      for (const auto &[name, series] : quantities.all)
        {
          for (const ExponentFit &slope : local_slopes(series))
            append(name, slip_length, "local", slope);
          const auto trusted = quantities.trusted.find(name);
          if (trusted == quantities.trusted.end())
            continue;
          const ExponentFit fit = fit_exponent(trusted->second, largest);
          if (fit.n_points < 2)
            continue;
          append(name, slip_length, "fit", fit);
          log.line(format(
            "exponent of %s: %.3f ± %.3f for %.3g <= 1 - L/L_c <= %.3g (%d points)",
            name.c_str(),
            fit.exponent,
            fit.error,
            fit.from,
            fit.to,
            fit.n_points));
          double smallest = fit.exponent, greatest = fit.exponent;
          for (const ExponentFit &slope : local_slopes(trusted->second))
            if (slope.to <= fit.to)
              {
                smallest = std::min(smallest, slope.exponent);
                greatest = std::max(greatest, slope.exponent);
              }
          if (greatest - smallest > settled)
            {
              log.warn(
                format("corrections to scaling: the local exponent of %s drifts from "
                       "%.3f to %.3f within the fit",
                       name.c_str(),
                       smallest,
                       greatest));
            }
        }
  }
} // namespace strait
