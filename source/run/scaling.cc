// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/scaling.h>
#include <strait/run/step.h>
#include <strait/spectral/state_archive.h>
#include <strait/theory/closing_law.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>
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
                     sample.is_coarse,
                     sample.values);
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

  std::vector<ExponentFit>
  local_slopes(std::vector<ScalingPoint> points)
  {
    std::sort(points.begin(), points.end(), [](const auto &a, const auto &b) {
      return a.reduced_load > b.reduced_load;
    });
    std::vector<ExponentFit> slopes;
    for (std::size_t k = 1; k < points.size(); ++k)
      if (points[k].reduced_load < points[k - 1].reduced_load)
        slopes.push_back(fit_exponent({points[k - 1], points[k]}, 1.));
    return slopes;
  }

  namespace
  {
    /** The slope of y against x by least squares, and its standard error. */
    std::pair<double, double>
    fit_line(const std::vector<double> &x, const std::vector<double> &y)
    {
      const auto   n      = static_cast<double>(x.size());
      const double mean_x = std::accumulate(x.begin(), x.end(), 0.) / n;
      const double mean_y = std::accumulate(y.begin(), y.end(), 0.) / n;
      double       xx = 0, xy = 0, yy = 0;
      for (std::size_t k = 0; k < x.size(); ++k)
        {
          xx += (x[k] - mean_x) * (x[k] - mean_x);
          xy += (x[k] - mean_x) * (y[k] - mean_y);
          yy += (y[k] - mean_y) * (y[k] - mean_y);
        }
      const double left_over = std::max(yy - xy * xy / xx, 0.);
      return {xy / xx, n > 2 ? std::sqrt(left_over / ((n - 2) * xx)) : 0.};
    }

    /** s of value ∝ exp(s ε) by least squares over exponential_decay. Not a number with
     *  fewer than two points in that range. */
    double
    decay_rate(const std::vector<ScalingPoint> &points)
    {
      std::vector<double> x, y;
      for (const auto &[epsilon, value, status] : points)
        if (exponential_decay.contains(epsilon))
          {
            x.push_back(epsilon);
            y.push_back(std::log(value));
          }
      return x.size() < 2 ? std::nan("") : fit_line(x, y).first;
    }

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

  ExponentFit
  fit_exponent(const std::vector<ScalingPoint> &points, const double largest)
  {
    ExponentFit         fit;
    std::vector<double> x, y;
    for (const auto &[epsilon, value, status] : points)
      if (LoadWindow{0., largest}.contains(epsilon))
        {
          add_words(fit.status, status);
          fit.from = x.empty() ? epsilon : std::min(fit.from, epsilon);
          fit.to   = std::max(fit.to, epsilon);
          x.push_back(std::log(epsilon));
          y.push_back(std::log(value));
        }
    fit.n_points = static_cast<int>(x.size());
    if (fit.from == fit.to) // of the same load again nothing is learnt
      fit.n_points = std::min(fit.n_points, 1);
    if (fit.n_points < 2)
      return fit;
    std::tie(fit.exponent, fit.error) = fit_line(x, y);
    return fit;
  }

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
    return rows;
  }

  bool
  Scaling::suffice(const char       *result,
                   const double      slip_length,
                   const LoadWindow &window,
                   const Trust       trust,
                   Log              &log) const
  {
    int         n_steps = 0, n_used = 0;
    std::string status_of_others = "ok";
    for (const Sample &sample : samples)
      if (sample.slip_length == slip_length && window.contains(sample.reduced_load))
        {
          ++n_steps;
          if (sample.serves(leak_rate, trust))
            ++n_used;
          else
            add_words(status_of_others,
                      trust == Trust::resolved && sample.is_coarse ? "coarse-throat"
                                                                   : sample.status);
        }
    if (n_used == n_steps)
      return true;
    log.warn(
      (n_used < 2 ? std::string("no ") + result + ", which takes two steps" : result) +
      format(": %d of %d steps with 1 - L/L_c from %.3g to %.3g serve; the "
             "others are left out for %s",
             n_used,
             n_steps,
             window.from,
             window.to,
             status_of_others.c_str()));
    return n_used >= 2;
  }

  void
  Scaling::summarise(const std::vector<Transition> &thresholds,
                     RunSummary                    &summary,
                     Log                           &log) const
  {
    double slip_length = std::nan("");
    for (const Sample &sample : samples)
      slip_length = std::fmax(slip_length, sample.slip_length); // they are negative
    const ExponentFit fit =
      fit_exponent(series(leak_rate, slip_length, Trust::doubtless), largest);
    if (fit.n_points > 1)
      {
        summary.exponent       = fit.exponent;
        summary.exponent_error = fit.error;
      }
    if (!suffice(
          "exponent of leak_rate", slip_length, {0., largest}, Trust::doubtless, log))
      add_words(summary.status, "no-exponent");
    if (!suffice("crossover load", slip_length, exponential_decay, Trust::resolved, log))
      add_words(summary.status, "no-crossover");

    const auto find_crossover = [&](const Quantity quantity, const char *name) {
      const double rate = decay_rate(series(quantity, slip_length, Trust::resolved));
      if (!(rate < leak_rate_exponent))
        return leak_rate_exponent / rate;
      log.warn(
        format("no crossover load of the %s: its logarithm rises by less than "
               "69/20 times 1 - L/L_c from %.3g to %.3g",
               name,
               exponential_decay.from,
               exponential_decay.to));
      if (quantity == leak_rate)
        add_words(summary.status, "no-crossover");
      return std::nan("");
    };
    summary.crossover      = find_crossover(leak_rate, "leak rate");
    const double of_theory = find_crossover(theory_leak_rate, "theory's leak rate");
    if (const Transition *threshold = threshold_of(thresholds, slip_length))
      {
        summary.crossover_load        = (1. - summary.crossover) * threshold->middle();
        summary.theory_crossover_load = (1. - of_theory) * threshold->middle();
      }
  }
} // namespace strait
