// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/driver/blow_out.h>
#include <strait/driver/slow_approach.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    // Of a usual pressure: what leaks with so little leaks by itself.
    constexpr double negligible = 1e-6;

    ComputationError
    not_found(const double held)
    {
      return ComputationError("An inlet pressure of " + to_text(held) +
                              " is held; no blow-out pressure was found.");
    }
  } // namespace

  void
  transfer_probe(StateArchive &archive, BlowOutProbe &probe)
  {
    archive.value(probe.leaks);
    archive.value(probe.contact_area);
    archive.value(probe.constriction.ix);
    archive.value(probe.constriction.iy);
  }

  BlowOut
  find_blow_out(const std::function<BlowOutProbe(double)> &probe,
                const double                               first,
                const double                               tolerance)
  {
    constexpr double excessive = 1e3;
    BlowOut          result;
    const auto       leaks = [&](const double pressure) {
      const BlowOutProbe found = probe(pressure);
      ++result.n_solves;
      if (found.leaks)
        {
          result.upper        = pressure;
          result.constriction = found.constriction;
        }
      else
        {
          result.lower        = pressure;
          result.contact_area = found.contact_area;
        }
      return found.leaks;
    };

    if (leaks(negligible * first))
      {
        result.upper = 0;
        return result;
      }
    double pressure = first;
    while (!leaks(pressure))
      {
        pressure *= 2;
        if (pressure > excessive * first)
          throw not_found(result.lower);
      }
    if (!approach_slowly({result.lower, result.upper}, tolerance, leaks))
      throw not_found(result.lower);
    return result;
  }

  Resealing
  find_resealing(const std::function<BlowOutProbe(double)> &probe,
                 const double                               leaking,
                 const double                               tolerance,
                 int                                       &n_solves)
  {
    Resealing  result{0., leaking};
    const auto leaks = [&](const double pressure) {
      ++n_solves;
      const bool open                      = probe(pressure).leaks;
      (open ? result.upper : result.lower) = pressure;
      return open;
    };
    // Where there is no hysteresis it closes at once.
    for (double step = tolerance; leaks((1. - std::min(step, .5)) * result.upper);)
      {
        step *= 2;
        if (result.upper < negligible * leaking)
          return {};
      }
    const auto closes = [&](const double pressure) { return !leaks(pressure); };
    if (!approach_slowly({result.upper, result.lower}, tolerance, closes))
      return {};
    return result;
  }
} // namespace strait
