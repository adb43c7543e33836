// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** How much of the nominal area has which gap: P(u) in bins. */
  struct GapDistribution
  {
    double              contact_area = 0.; // fraction of the area where the gap is zero
    std::vector<double> edges;             // of the bins, ascending from 0; one more
    std::vector<double> fractions;         // of the nominal area, one a bin
    std::vector<double> gaps;              // that stand for the bins
  };

  /** Edges of bins from zero: 0, smallest, and so on in equal ratios, @p per_decade of
   *  them a decade, until @p largest is reached. */
  std::vector<double> gap_bins(double smallest, double largest, int per_decade);

  /** The distribution of what simulated gaps exceed @p closed >= 0 by: where they do not,
   *  is contact. Bins reach from the largest gap down by @p n_decades, below which one
   *  bin holds the rest; the mean of what is in it stands for a bin. Collective. */
  GapDistribution
  gap_histogram(const SlabField &gap, int n_decades, int per_decade, double closed = 0.);

  /** The same over given @p edges; what is beyond the last counts in the last bin. */
  GapDistribution
  gap_histogram(const SlabField &gap, std::vector<double> edges, double closed = 0.);

  /** 12 η K_e of an effective medium in which @p gaps are distributed at random
   *  [length³]: the K_e at which ∫ dK P(K) (K − K_e)/(K + (n−1) K_e) = 0, to rounding;
   *  the sum of all fractions may be one to rounding. Zero where the contact reaches
   *  1 − 1/n of the area. @p n > 1; two is Bruggeman's theory in the plane. */
  double effective_cubed_gap(const GapDistribution &gaps, double n);
} // namespace strait
