// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_theory_effective_medium_h
#define strait_theory_effective_medium_h

#include <strait/theory/gap_distribution.h>

namespace strait
{
  /** Shares of a medium with different conductivities. */
  struct MediumPart
  {
    double share;
    double conductivity; // >= 0
  };

  /** The conductivity K_e at which ∫ dK P(K) (K − K_e)/(K + (n−1) K_e) = 0, to rounding;
   *  the sum of the shares may be one to rounding. Zero where the share with zero
   *  conductivity reaches 1 − 1/n. @p n > 1; two is Bruggeman's theory in the plane. */
  double effective_conductivity(const std::vector<MediumPart> &medium, double n);

  /** 12 η K_e of a gap in which @p gaps are distributed at random [length³]. */
  double effective_cubed_gap(const GapDistribution &gaps, double n);

  /** The n at which K_e vanishes where the share @p blocked, between 0 and 1, does not
   *  conduct: 1/(1 − a_c). */
  double dimension_parameter(double blocked);
} // namespace strait

#endif
