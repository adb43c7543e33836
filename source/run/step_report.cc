// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/step.h>

#include <cmath>

namespace strait
{
  namespace
  {
    std::string
    time_in_words(const double seconds)
    {
      return seconds < 100.    ? format("%.0f s", seconds)
             : seconds < 6000. ? format("%.0f min", seconds / 60.)
                               : format("%.1f h", seconds / 3600.);
    }

    /** Describe the largest error of a leak rate that is known, what would reduce it, and
     *  which errors are not known. */
    std::string
    largest_of(const StepErrors &errors)
    {
      std::string unknown;
      for (const ErrorItem &item : errors.items)
        if (std::isnan(item.relative))
          unknown +=
            "; that of the " + item.source + " is not known (" + item.parameter + ")";
      const ErrorItem &largest = errors.largest_known();
      std::string text = format("  largest %serror of the leak rate: %s, %.2g %% (%s)",
                                unknown.empty() ? "" : "known ",
                                largest.source.c_str(),
                                100. * largest.relative,
                                largest.parameter.c_str()) +
                         unknown;
      if (errors.extrapolated)
        text += format("; order in the grid %.2f, extrapolated leak rate %.5g",
                       *errors.grid_order,
                       *errors.extrapolated);
      return text;
    }
  } // namespace

  void
  announce_step(const int number, const int n_steps, const double seconds_each, Log &log)
  {
    log.stage(
      format("step %d of %d", number, n_steps) +
      (seconds_each > 0.
         ? ", about " + time_in_words(seconds_each * (n_steps - number + 1)) + " left"
         : ""));
  }

  void
  report_step(const Step &step, const int n_steps, Log &log)
  {
    std::string text = format("step %d of %d", step.number, n_steps);
    if (step.state.contact)
      text +=
        format(": pressure %.5g, contact %.3f %%, residual %.1e (%ld FFT pairs, %.1f s)",
               step.state.contact->nominal_pressure,
               100. * step.state.contact->contact_area,
               step.state.contact->residual,
               step.state.costs.fft_pairs,
               step.state.costs.contact_seconds);
    if (step.state.contact && step.state.contact->plasticity)
      text += format("; %.3f %% flows", 100. * step.state.contact->plasticity->area);
    if (step.flow && std::isinf(step.flow->leakage.rate))
      text += "; nothing limits the leak";
    else if (step.flow && step.flow->channel.percolates())
      {
        const double percent = 100. * step.flow->leakage.relative_error();
        text += format("; leak rate %.5g ± %s %% (%llu cells, %.1f s)",
                       step.flow->leakage.rate,
                       format(percent < 9.5 ? "%.1g" : "%.0f", percent).c_str(),
                       step.flow->leakage.cells,
                       step.flow_seconds);
      }
    else if (step.flow)
      text += "; sealed";
    if (step.reduced_load)
      text += format("; 1 - L/L_c = %.3g", *step.reduced_load);
    if (step.theory)
      text += format("%stheory: contact %.3f %%, leak rate %.4g",
                     step.state.contact || step.flow
                       ? "; "
                       : format(": pressure %.5g, ", step.theory->pressure).c_str(),
                     100. * step.theory->contact_area,
                     step.theory->leak_rate);
    if (step.status() != "ok")
      text += "; " + step.status();
    if (step.validity() != "ok")
      text += "; validity: " + step.validity();
    log.line(text);
    if (!step.errors.items.empty())
      log.line(largest_of(step.errors));
  }
} // namespace strait
