// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** The distribution P(u) of the gaps over the nominal area, in bins. */
  struct GapDistribution
  {
    double              contact_area = 0.; // fraction of the area where the gap is zero
    std::vector<double> edges;             // of the bins, from 0 up; one more than bins
    std::vector<double> fractions;         // of the nominal area, one for each bin
    std::vector<double> gaps;              // the gap that stands for each bin
  };

  /** Return the edges of bins: 0, @p smallest, and so on in equal ratios, @p per_decade
   *  of them a decade, until @p largest is reached. */
  std::vector<double> gap_bins(double smallest, double largest, int per_decade);

  /** Return the distribution of the excess of simulated gaps over @p closed >= 0; points
   *  without it are in contact. Bins reach from the largest gap down by @p n_decades, and
   *  one holds all below. The mean of its content stands for a bin. Collective. */
  GapDistribution
  gap_histogram(const SlabField &gap, int n_decades, int per_decade, double closed = 0.);

  /** The same in bins with given @p edges; larger values count in the last bin. */
  GapDistribution
  gap_histogram(const SlabField &gap, std::vector<double> edges, double closed = 0.);

  /** Return 12 η K_e of an effective medium in which @p gaps are distributed at random
   *  [length³]: the K_e for which ∫ dK P(K) (K − K_e)/(K + (n−1) K_e) = 0, to rounding.
   *  The fractions need to sum to one only to rounding. Zero if the contact reaches
   *  1 − 1/n of the area. @p n > 1; two is Bruggeman's theory in the plane. */
  double effective_cubed_gap(const GapDistribution &gaps, double n);
} // namespace strait
