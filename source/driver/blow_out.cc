// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/driver/blow_out.h>

namespace strait
{
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
    // What leaks with next to no pressure leaks by itself.
    constexpr double negligible = 1e-6, excessive = 1e3;
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
          throw ComputationError("An inlet pressure of " + to_text(result.lower) +
                                 " is held; no blow-out pressure was found.");
      }
    while (result.upper - result.lower > tolerance * result.upper)
      leaks(.5 * (result.lower + result.upper));
    return result;
  }
} // namespace strait
