// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_transition_h
#define strait_seal_transition_h

#include <array>
#include <optional>
#include <vector>

namespace strait
{
  /** A load or an inlet pressure at which a seal begins or ceases to leak, enclosed. */
  struct Transition
  {
    double slip_length = 0.;
    // With hysteresis these are on the path that the search follows.
    double                lower        = 0.;
    double                upper        = 0.;
    double                contact_area = 0.;         // at lower
    std::array<double, 2> bottleneck   = {{0., 0.}}; // place in the open state [length]
    int                   n_solves     = 0;          // states that were asked for
    long                  fft_pairs    = 0;          // of those
    bool                  converged    = true;       // the states at both ends

    double
    middle() const
    {
      return .5 * (lower + upper);
    }

    double
    relative_width() const
    {
      return (upper - lower) / upper;
    }
  };

  /** The critical load of a slip length; null if there is none. */
  inline const Transition *
  threshold_of(const std::vector<Transition> &thresholds, const double slip_length)
  {
    for (const Transition &threshold : thresholds)
      if (threshold.slip_length == slip_length)
        return &threshold;
    return nullptr;
  }

  /** The inlet pressures at which a seal under a load opens and closes again. */
  struct BlowOut
  {
    double                    load = 0.;
    Transition                opening; // 0 where it leaks without any pressure
    std::optional<Transition> closing; // if it was sought; 0 where it never closes
  };
} // namespace strait

#endif
