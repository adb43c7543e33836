// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/scaling.h>
#include <strait/run/step.h>
#include <strait/spectral/state_archive.h>
#include <strait/theory/closing_law.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace strait
{
  void
  Scaling::collect(const Step &step)
  {
    if (!step.reduced_load || !(*step.reduced_load > 0))
      return;
    Sample sample{step.state.control.slip_length, *step.reduced_load, step.status()};
    for (const ValidityCheck &check : step.checks)
      if (check.word == "coarse-throat")
        sample.is_coarse = !check.holds();
    if (step.flow && step.flow->constrictions && step.converged())
      {
        const Throat &throat         = step.flow->channel.throat;
        sample.values[leak_rate]     = std::abs(step.flow->leakage.rate);
        sample.values[throat_gap]    = throat.gap;
        sample.values[throat_length] = throat.length;
        sample.values[throat_width]  = throat.width;
      }
    if (step.theory)
      sample.values[theory_leak_rate] = std::abs(step.theory->leak_rate);
    samples.push_back(sample);
  }

  void
  Scaling::transfer(StateArchive &archive)
  {
    transfer_all(archive, samples, [&](Sample &sample) {
      archive.values(sample.slip_length,
                     sample.reduced_load,
                     sample.status,
                     sample.is_coarse);
      for (double &value : sample.values)
        archive.value(value);
    });
  }

  std::vector<ScalingPoint>
  Scaling::series(const Quantity quantity,
                  const double   slip_length,
                  const Trust    trust) const
  {
    std::vector<ScalingPoint> points;
    for (const Sample &sample : samples)
      if (sample.slip_length == slip_length && sample.serves(quantity, trust))
        points.push_back({sample.reduced_load, sample.values[quantity], sample.status});
    return points;
  }

  double
  Scaling::smallest_slip() const
  {
    double slip_length = std::nan("");
    for (const Sample &sample : samples)
      slip_length = std::fmax(slip_length, sample.slip_length); // they are negative
    return slip_length;
  }

  std::array<Scaling::Supply, 2>
  Scaling::supplies() const
  {
    std::array<Supply, 2> result = {
      {{"exponent of leak_rate", "no-exponent", {0., largest}, Trust::doubtless},
       {"crossover load", "no-crossover", exponential_decay, Trust::resolved}}};
    const double slip_length = smallest_slip();
    for (Supply &supply : result)
      for (const Sample &sample : samples)
        if (sample.slip_length == slip_length &&
            supply.window.contains(sample.reduced_load))
          {
            ++supply.n_steps;
            if (sample.serves(leak_rate, supply.trust))
              ++supply.n_used;
            else
              add_words(supply.status_of_others,
                        supply.trust == Trust::resolved && sample.is_coarse
                          ? "coarse-throat"
                          : sample.status);
          }
    return result;
  }

  bool
  Scaling::is_slow(const Quantity quantity) const
  {
    return decay_rate(series(quantity, smallest_slip(), Trust::resolved)) <
           leak_rate_exponent;
  }

  void
  Scaling::report_missing(Log &log) const
  {
    for (const Supply &supply : supplies())
      if (supply.n_steps > supply.n_used)
        log.warn((supply.is_short()
                    ? std::string("no ") + supply.result + ", which takes two steps"
                    : supply.result) +
                 format(": %d of %d steps with 1 - L/L_c from %.3g to %.3g serve; the "
                        "others are left out for %s",
                        supply.n_used,
                        supply.n_steps,
                        supply.window.from,
                        supply.window.to,
                        supply.status_of_others.c_str()));
    for (const auto &[quantity, name] :
         {std::pair{leak_rate, "leak rate"}, {theory_leak_rate, "theory's leak rate"}})
      if (is_slow(quantity))
        log.warn(
          format("no crossover load of the %s: its logarithm rises by less than "
                 "69/20 times 1 - L/L_c from %.3g to %.3g",
                 name,
                 exponential_decay.from,
                 exponential_decay.to));
  }

  void
  Scaling::summarise(const std::vector<Transition> &thresholds, RunSummary &summary) const
  {
    const double      slip_length = smallest_slip();
    const ExponentFit fit =
      fit_exponent(series(leak_rate, slip_length, Trust::doubtless), largest);
    if (fit.n_points > 1)
      {
        summary.exponent       = fit.exponent;
        summary.exponent_error = fit.error;
      }
    summary.crossover =
      crossover_reduced_load(series(leak_rate, slip_length, Trust::resolved));
    if (const Transition *threshold = threshold_of(thresholds, slip_length))
      {
        const double of_theory =
          crossover_reduced_load(series(theory_leak_rate, slip_length, Trust::resolved));
        summary.crossover_load        = (1. - summary.crossover) * threshold->middle();
        summary.theory_crossover_load = (1. - of_theory) * threshold->middle();
      }
    for (const Supply &supply : supplies())
      if (supply.is_short())
        add_words(summary.status, supply.word);
    if (is_slow(leak_rate))
      add_words(summary.status, "no-crossover");
  }

  namespace
  {
    /** Say what was fitted, and whether @p slopes within the window disagree. */
    void
    report_fit(const std::string              &name,
               const ExponentFit              &fit,
               const std::vector<ExponentFit> &slopes,
               Log                            &log)
    {
      // Where slopes still differ by more than this within a window, a single exponent
      // describes the window, not the threshold. At half the value, drifts that leave the
      // first decimal of the exponent alone would be warned of; at double, drifts that
      // change it would pass.
      constexpr double settled = 0.05;
      log.line(
        format("exponent of %s: %.3f ± %.3f for %.3g <= 1 - L/L_c <= %.3g (%d points)",
               name.c_str(),
               fit.exponent,
               fit.error,
               fit.from,
               fit.to,
               fit.n_points));
      double smallest = fit.exponent, greatest = fit.exponent;
      for (const ExponentFit &slope : slopes)
        if (slope.to <= fit.to)
          {
            smallest = std::min(smallest, slope.exponent);
            greatest = std::max(greatest, slope.exponent);
          }
      if (greatest - smallest > settled)
        log.warn(
          format("corrections to scaling: the local exponent of %s drifts from "
                 "%.3f to %.3f within the fit",
                 name.c_str(),
                 smallest,
                 greatest));
    }
  } // namespace

  std::vector<FitRow>
  Scaling::fits(Log &log) const
  {
    struct
    {
      Quantity    quantity;
      const char *name;
      double ClosingLaw::Exponents::*exponent;
      // An immobile layer cuts the throat off where it is still wide and smooth.
      double exponent_with_slip;
    } const quantities[] = {
      {leak_rate, "leak_rate", &ClosingLaw::Exponents::leak_rate, 3.},
      {throat_gap, "throat_gap", &ClosingLaw::Exponents::gap, 1.},
      {throat_length, "throat_length", &ClosingLaw::Exponents::length, .5},
      {throat_width, "throat_width", &ClosingLaw::Exponents::width, .5}};
    const auto middle = [](const ExponentFit &slope) {
      return std::sqrt(slope.from * slope.to);
    };
    std::set<double> slip_lengths;
    for (const Sample &sample : samples)
      slip_lengths.insert(sample.slip_length);
    std::vector<FitRow>            rows;
    std::vector<ClosingLaw::Slope> closing;
    for (const ExponentFit &slope : local_slopes(series(leak_rate, 0., Trust::doubtless)))
      if (LoadWindow{0., largest}.contains(slope.to))
        closing.push_back({middle(slope), slope.exponent});
    const ClosingLaw law = ClosingLaw::fit(closing);
    for (const double slip_length : slip_lengths)
      for (const auto &[quantity, name, exponent, with_slip] : quantities)
        {
          for (const ExponentFit &slope :
               local_slopes(series(quantity, slip_length, Trust::all)))
            rows.push_back(
              {slope,
               name,
               slip_length,
               "local",
               slip_length < 0 ? with_slip : law.at(middle(slope)).*exponent});
          const auto        trusted = series(quantity, slip_length, Trust::doubtless);
          const ExponentFit fit     = fit_exponent(trusted, largest);
          if (fit.n_points < 2)
            continue;
          rows.push_back({fit, name, slip_length, "fit", std::nan("")});
          report_fit(name, fit, local_slopes(trusted), log);
        }
    report_missing(log);
    return rows;
  }
} // namespace strait
