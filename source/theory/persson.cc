// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/theory/persson.h>

#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/expint.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    // The x at which exp(−x) is a rounding error of 1, as are erfc(√x) and W(√x).
    const double negligible_exponent = -std::log(std::numeric_limits<double>::epsilon());

    // Beyond this argument W is less than a rounding error of 1.
    const double largest_compression = std::sqrt(negligible_exponent);

    /** Return the probability of |separation + roughness z| < u, z standard normal. */
    double
    fraction_below(const GapLayer &layer, const double u)
    {
      const double scale = std::sqrt(.5) / layer.roughness;
      return .5 * (std::erf((u - layer.separation) * scale) +
                   std::erf((u + layer.separation) * scale));
    }

    /** Return exp(s²) ∫_s^∞ erf²(t) exp(−t²) dt/t, taken over t² − s². */
    double
    saturated_part(const double s)
    {
      const auto integrand = [s](const double u) {
        const double square = s * s + u, error_function = std::erf(std::sqrt(square));
        return error_function * error_function / square * std::exp(-u);
      };
      return .5 * boost::math::quadrature::exp_sinh<double>().integrate(
                    integrand, std::numeric_limits<double>::epsilon());
    }
  } // namespace

  PerssonTheory::PerssonTheory(RadialSpectrum spectrum,
                               const double   effective_modulus,
                               const double   gamma_,
                               const int      fineness_)
    : waves(std::move(spectrum))
    , modulus(effective_modulus)
    , gamma(gamma_)
    , erf_square_part(saturated_part, 0., largest_compression)
    , fineness(fineness_)
  {
  }

  double
  PerssonTheory::contact_area(const double pressure) const
  {
    return std::erf(std::sqrt(2.) * pressure / modulus / std::sqrt(waves.slope_square()));
  }

  YieldingAreas
  PerssonTheory::contact_areas(const double pressure, const double hardness) const
  {
    // Standard deviation of the pressure, E* ḡ/2; beyond nine of them nothing arrives.
    const double spread = .5 * modulus * std::sqrt(waves.slope_square());
    const double far    = 9. * spread;
    if (hardness - pressure > far)
      return {contact_area(pressure), 0.};
    if (pressure > far)
      {
        const double elastic = contact_area(hardness - pressure);
        return {elastic, 1. - elastic};
      }
    // What is not absorbed yet is a sum of decaying sines. It takes at most 54 of them
    // until the next ones are a rounding error.
    double elastic = 0., plastic = pressure / hardness;
    for (int n = 1;; ++n)
      {
        const double decay = n * M_PI * spread / hardness;
        const double term  = 2 / (M_PI * n) * std::exp(-.5 * decay * decay) *
                            std::sin(n * M_PI * pressure / hardness);
        elastic += n % 2 == 1 ? 2 * term : 0.;
        plastic -= n % 2 == 1 ? term : -term;
        if (.5 * decay * decay > negligible_exponent)
          return {elastic, std::max(plastic, 0.)}; // below zero is rounding
      }
  }

  double
  PerssonTheory::compression(const double s) const
  {
    if (s >= largest_compression)
      return 0.;
    // Without promotion of double, four times as fast as Boost's default.
    using Policy =
      boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    return .5 * gamma * boost::math::expint(1, s * s, Policy()) +
           3 * (1 - gamma) * std::exp(-s * s) * erf_square_part(s);
  }

  double
  PerssonTheory::mean_gap(const double seen, const double smoothed) const
  {
    const double left_over = waves.slope_square() - seen;
    if (!(left_over > 0))
      return 0.;
    // As a function of ln v all is smooth, except at the corners of the spectrum.
    const double        end    = .5 * std::log(left_over);
    std::vector<double> breaks = {std::log(smoothed / largest_compression)};
    for (const RadialSpectrum::Section &section : waves.sections)
      if (const double above = waves.slope_square_below(section.from) - seen;
          above > 0 && .5 * std::log(above) > breaks.back())
        breaks.push_back(.5 * std::log(above));
    if (!(end > breaks.front()))
      return 0.;
    breaks.push_back(end);

    const auto integrand = [&](const double log_v) {
      const double v = std::exp(log_v);
      return v * compression(smoothed / v) / waves.wave_number_at(seen + v * v);
    };
    double sum = 0;
    for (std::size_t k = 1; k < breaks.size(); ++k)
      {
        const double length = breaks[k] - breaks[k - 1];
        const auto   n      = static_cast<int>(std::ceil(length * fineness / 2));
        for (int panel = 0; panel < n; ++panel)
          sum += boost::math::quadrature::gauss<double, 8>::integrate(
            integrand,
            breaks[k - 1] + panel * length / n,
            breaks[k - 1] + (panel + 1) * length / n);
      }
    return std::sqrt(2 / M_PI) * sum;
  }

  std::vector<double>
  PerssonTheory::magnifications(const double smoothed) const
  {
    // Where the contact area falls: equal ratios of ḡ². Below the first one, the whole
    // area is in contact, to rounding.
    const double        last   = waves.slope_square();
    std::vector<double> slopes = {last};
    const int           n      = 128 * fineness;
    const double        first  = smoothed * smoothed / negligible_exponent;
    for (int k = 0; k < n && first < last; ++k)
      slopes.push_back(first * std::pow(last / first, static_cast<double>(k) / n));

    // Dense in q where the remaining roughness vanishes. Also the corners of the
    // spectrum, as everything is smooth between them.
    const double lowest = waves.sections.front().from;
    const double band   = waves.sections.back().to / lowest;
    const auto   add    = [&](const double q) {
      if (const double slope = waves.slope_square_below(q); slope > first)
        slopes.push_back(slope);
    };
    for (int k = 0; k < n; ++k)
      add(lowest * std::pow(band, .5 * (1 - std::cos(M_PI * k / n))));
    for (const RadialSpectrum::Section &section : waves.sections)
      add(section.from);
    std::sort(slopes.begin(), slopes.end());
    slopes.erase(std::unique(slopes.begin(), slopes.end()), slopes.end());
    return slopes;
  }

  PerssonState
  PerssonTheory::solve(const double pressure) const
  {
    PerssonState state;
    const double smoothed = std::sqrt(2.) * pressure / modulus;
    state.contact_area    = contact_area(pressure);
    state.mean_gap        = mean_gap(0., smoothed);

    const std::vector<double> slopes = magnifications(smoothed);
    double                    gap = 0., open = 0., height = 0.; // at the last k
    for (std::size_t k = 0; k < slopes.size(); ++k)
      {
        const double x           = smoothed / std::sqrt(slopes[k]);
        const double area        = std::erf(x);
        const double last_gap    = gap;
        const double last_open   = open;
        const double last_height = height;
        open                     = std::erfc(x);
        gap                      = mean_gap(slopes[k], smoothed / area);
        height = waves.height_square_above(waves.wave_number_at(slopes[k]));
        const double fraction = open - last_open;
        if (k == 0 || !(fraction > 0))
          continue;
        // d(ūA)/dA as a quotient of differences, but without the difference of two
        // products that are close to each other.
        state.layers.push_back({fraction,
                                .5 * (gap + last_gap) + (1 - .5 * (open + last_open)) *
                                                          (last_gap - gap) / fraction,
                                std::sqrt(.5 * (height + last_height))});
      }
    return state;
  }

  GapDistribution
  PerssonTheory::distribution(const PerssonState &state,
                              const double        closed,
                              const int           merged) const
  {
    // Gaps of 1e-6 of the height of the shortest waves do not matter to the fluid.
    const double    shortest = std::sqrt(waves.height_square_above(
      .5 * (waves.sections.back().to + waves.sections.front().from)));
    GapDistribution result;
    result.contact_area = state.contact_area;
    result.edges        = gap_bins(1e-6 * shortest,
                            1e3 * std::sqrt(waves.height_square()),
                            bins_per_decade() / merged);
    const std::size_t n = result.edges.size() - 1;
    result.fractions.assign(n, 0.);
    for (const GapLayer &layer : state.layers)
      {
        // The fraction below 0 is 0/0 in a layer with neither roughness nor separation.
        double below = closed > 0 ? fraction_below(layer, closed) : 0.;
        result.contact_area += layer.fraction * below;
        for (std::size_t k = 0; k < n; ++k)
          {
            // All larger gaps belong to the last bin; the walls are far apart there.
            const double next =
              k + 1 < n ? fraction_below(layer, closed + result.edges[k + 1]) : 1.;
            result.fractions[k] += layer.fraction * (next - below);
            below = next;
            if (below == 1.)
              break;
          }
      }
    result.gaps.push_back(.5 * result.edges[1]);
    for (std::size_t k = 1; k < n; ++k)
      result.gaps.push_back(std::sqrt(result.edges[k] * result.edges[k + 1]));
    return result;
  }
} // namespace strait
