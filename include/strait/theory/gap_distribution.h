// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_theory_gap_distribution_h
#define strait_theory_gap_distribution_h

#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** How much of the nominal area has which gap: P(u) in bins. */
  struct GapDistribution
  {
    double              contact_area = 0.; // share of the area where the gap is zero
    std::vector<double> edges;             // of the bins, ascending from 0; one more
    std::vector<double> shares;            // of the nominal area, one a bin
    std::vector<double> gaps;              // that stand for the bins
  };

  /**
   * Edges of bins from zero: 0, smallest, and so on in equal ratios, @p per_decade of
   * them a decade, until @p largest is reached. If gaps up to @p closed > 0 conduct
   * nothing, these are the first bin, and the others are shifted beyond.
   */
  std::vector<double>
  gap_bins(double smallest, double largest, int per_decade, double closed = 0.);

  /**
   * The distribution of simulated gaps: what is not positive is contact. Bins reach from
   * the largest gap down by @p n_decades, below which one bin holds the rest; the mean
   * of its gaps stands for a bin. @p closed as for gap_bins(). Collective.
   */
  GapDistribution
  gap_histogram(const SlabField &gap, int n_decades, int per_decade, double closed = 0.);

  /** The same over given @p edges; gaps beyond the last count in the last bin. */
  GapDistribution gap_histogram(const SlabField &gap, std::vector<double> edges);

  /** The same in bins of @p n each, but for the first, which reaches from zero, and
   *  maybe the last. */
  GapDistribution merge_bins(const GapDistribution &fine, std::size_t n);
} // namespace strait

#endif
