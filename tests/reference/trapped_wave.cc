// SPDX-License-Identifier: GPL-2.0-or-later
#include "trapped_wave.h"

#include <cmath>

namespace strait::reference
{
  namespace
  {
    double
    mean_gap(const double load)
    {
      return load < 1. ? 1. - load + load * std::log(load) : 0.;
    }
  } // namespace

  double
  TrappedWave::fluid_pressure(const double load) const
  {
    // Without fluid the gap is too small, with all that the load has grown by in the
    // fluid it is as large as when it was trapped, which a fluid that shrinks does not
    // fill.
    double lower = 0., upper = load - load_when_trapped;
    if (bulk_modulus == 0.)
      return upper;
    while (true)
      {
        const double middle = .5 * (lower + upper);
        if (middle == lower || middle == upper)
          return middle;
        const double strain =
          bulk_modulus_slope == 0.
            ? middle / bulk_modulus
            : std::log1p(bulk_modulus_slope * middle / bulk_modulus) / bulk_modulus_slope;
        (mean_gap(load - middle) < mean_gap(load_when_trapped) * std::exp(-strain)
           ? lower
           : upper) = middle;
      }
  }
} // namespace strait::reference
