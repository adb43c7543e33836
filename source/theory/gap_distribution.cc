// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/rounding.h>
#include <strait/theory/gap_distribution.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace strait
{
  std::vector<double>
  gap_bins(const double smallest, const double largest, const int per_decade)
  {
    const auto n =
      static_cast<int>(std::ceil(per_decade * std::log10(largest / smallest) - rounding));
    std::vector<double> edges = {0.};
    for (int k = 0; k <= n; ++k)
      edges.push_back(smallest * std::pow(10., static_cast<double>(k) / per_decade));
    return edges;
  }

  GapDistribution
  gap_histogram(const SlabField &gap,
                const int        n_decades,
                const int        per_decade,
                const double     closed)
  {
    double largest = max_value(gap);
    if (!(largest > 0))
      largest = 1.; // all closed: the bins stay empty
    return gap_histogram(
      gap, gap_bins(largest * std::pow(10., -n_decades), largest, per_decade), closed);
  }

  GapDistribution
  gap_histogram(const SlabField &gap, std::vector<double> edges, const double closed)
  {
    const std::size_t n = edges.size() - 1;
    // The number of points of each bin and the sum of their gaps, weighted by area; then
    // the contact.
    std::vector<double> sums(2 * n + 1, 0.);
    for (const SlabLayout::Range &range : gap.layout().ranges())
      for (std::size_t point = range.begin; point < range.end; ++point)
        if (const double u = gap[point] - closed; u > 0)
          {
            const auto        next = std::upper_bound(edges.begin(), edges.end(), u);
            const std::size_t bin =
              std::min<std::size_t>(next - edges.begin() - 1, n - 1);
            sums[2 * bin] += range.area;
            sums[2 * bin + 1] += range.area * u;
          }
        else
          sums[2 * n] += range.area;
    sum_in_place(gap.layout().communicator(), sums);

    GapDistribution result;
    const auto      n_points = static_cast<double>(gap.grid().n_points());
    result.contact_area      = sums[2 * n] / n_points;
    for (std::size_t k = 0; k < n; ++k)
      {
        result.fractions.push_back(sums[2 * k] / n_points);
        result.gaps.push_back(sums[2 * k] > 0 ? sums[2 * k + 1] / sums[2 * k]
                                              : .5 * (edges[k] + edges[k + 1]));
      }
    result.edges = std::move(edges);
    return result;
  }

  double
  effective_cubed_gap(const GapDistribution &gaps, const double n)
  {
    std::vector<double> cubes;
    double              open = 0;
    for (std::size_t k = 0; k < gaps.gaps.size(); ++k)
      {
        cubes.push_back(std::pow(gaps.gaps[k], 3));
        open += gaps.fractions[k];
      }
    const double blocked = gaps.contact_area / (gaps.contact_area + open);
    if (!(open > 0) || blocked >= 1 - 1 / n)
      return 0.;

    const double alone   = 1 - blocked * n / (n - 1);
    const auto   balance = [&](const double log_effective) {
      const double effective = std::exp(log_effective);
      double       sum       = -gaps.contact_area / (n - 1);
      for (std::size_t k = 0; k < cubes.size(); ++k)
        sum +=
          gaps.fractions[k] * (cubes[k] - effective) / (cubes[k] + (n - 1) * effective);
      return sum;
    };
    // Between the results for the smallest and for the largest conductivity everywhere,
    // widened for the rounding if all open gaps conduct alike.
    const double   from       = std::log(alone * cubes.front()) - 1.;
    const double   to         = std::log(alone * cubes.back()) + 1.;
    std::uintmax_t most_steps = 200;
    const auto [low, high]    = boost::math::tools::toms748_solve(
      balance, from, to, boost::math::tools::eps_tolerance<double>(), most_steps);
    return std::exp(.5 * (low + high));
  }
} // namespace strait
