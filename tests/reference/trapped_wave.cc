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
    // At zero fluid pressure the gap is too small for the fluid. If the fluid bears all
    // of the load's increase, the gap is that at trapping, too large for a compressed
    // fluid.
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
