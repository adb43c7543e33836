// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/theory/persson.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    const double pi = std::acos(-1.);

    // The ends of the table of W. Below the smallest, W grows as −γ ln s up to a
    // correction of the order s², 1e-10: twice as far up four times that. Beyond the
    // largest it is less than 1e-20; at half of it, it would still be 1e-6. Half the
    // steps between make the cubic's error, a relative 1e-9 at most, 16 times as large,
    // double of them as much smaller.
    constexpr double smallest_s = 1e-5, largest_s = 7.;
    constexpr int    n_steps      = 4096;
    const double     log_smallest = std::log(smallest_s);
    const double     log_step     = (std::log(largest_s) - log_smallest) / n_steps;

    /** Probability that |separation + roughness z| < u, z normal. */
    double
    share_below(const GapLayer &layer, const double u)
    {
      const double scale = std::sqrt(.5) / layer.roughness;
      return .5 * (std::erf((u - layer.separation) * scale) +
                   std::erf((u + layer.separation) * scale));
    }
  } // namespace

  CompressionIntegral::CompressionIntegral(const double gamma_)
    : gamma(gamma_)
    , table(n_steps + 1, 0.)
  {
    // Simpson's rule, from the far end on.
    for (int k = n_steps - 1; k >= 0; --k)
      {
        const double left = log_smallest + k * log_step;
        table[k]          = table[k + 1] +
                   log_step / 6 *
                     (slope(std::exp(left)) + 4 * slope(std::exp(left + .5 * log_step)) +
                      slope(std::exp(left + log_step)));
      }
  }

  double
  CompressionIntegral::slope(const double s) const
  {
    const double error_function = std::erf(s);
    return (gamma + 3 * (1 - gamma) * error_function * error_function) * std::exp(-s * s);
  }

  double
  CompressionIntegral::operator()(const double s) const
  {
    if (s >= largest_s)
      return 0.;
    const double position = (std::log(s) - log_smallest) / log_step;
    if (position < 0)
      return table.front() - gamma * position * log_step;
    // Cubic through the four nearest entries.
    const int    k = std::clamp(static_cast<int>(position) - 1, 0, n_steps - 3);
    const double x = position - k;
    return table[k] * (1 - x) * (2 - x) * (3 - x) / 6 +
           table[k + 1] * x * (2 - x) * (3 - x) / 2 -
           table[k + 2] * x * (1 - x) * (3 - x) / 2 +
           table[k + 3] * x * (1 - x) * (2 - x) / 6;
  }

  double
  CompressionIntegral::largest()
  {
    return largest_s;
  }

  PerssonTheory::PerssonTheory(RadialSpectrum    spectrum,
                               const double      effective_modulus,
                               const double      gamma,
                               const Resolution &resolution_)
    : waves(std::move(spectrum))
    , modulus(effective_modulus)
    , compression(gamma)
    , resolution(resolution_)
  {
  }

  double
  PerssonTheory::contact_area(const double pressure) const
  {
    return std::erf(std::sqrt(2.) * pressure / modulus / std::sqrt(waves.slope_square()));
  }

  double
  PerssonTheory::mean_gap(const double seen, const double smoothed) const
  {
    const double left_over = waves.slope_square() - seen;
    if (!(left_over > 0))
      return 0.;
    // In ln v all is smooth but the corners of the spectrum. What lies further to the
    // left than this contributes nothing, 4e-18, since the integrand is at most v times a
    // logarithm; at half of it 2e-9 would be missing, double of it adds panels in vain.
    constexpr double    furthest = 40.;
    const double        end      = .5 * std::log(left_over);
    std::vector<double> breaks   = {
        std::max(std::log(smoothed / CompressionIntegral::largest()), end - furthest)};
    for (const double q : waves.corners())
      if (const double above = waves.slope_square_below(q) - seen;
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
        const auto   n = static_cast<int>(std::ceil(length / resolution.panel_width));
        for (int panel = 0; panel < n; ++panel)
          sum += boost::math::quadrature::gauss<double, 8>::integrate(
            integrand,
            breaks[k - 1] + panel * length / n,
            breaks[k - 1] + (panel + 1) * length / n);
      }
    return std::sqrt(2 / pi) * sum;
  }

  std::vector<double>
  PerssonTheory::magnifications(const double smoothed) const
  {
    // Where the contact area falls: in equal ratios of ḡ². Beneath the first, the area
    // is complete to rounding: 1 − erf(6) = 2e-17. At half of it a contact of 2e-5 of the
    // area would be left out, double of it adds magnifications at which nothing happens.
    constexpr double    complete = 6.;
    const double        last     = waves.slope_square();
    std::vector<double> slopes   = {last};
    const int           n        = resolution.layers / 2;
    const double        first    = std::pow(smoothed / complete, 2);
    for (int k = 0; k < n && first < last; ++k)
      slopes.push_back(first * std::pow(last / first, static_cast<double>(k) / n));

    // Dense in q where the remaining roughness vanishes; and at the corners, up to which
    // all is smooth.
    const double lowest = waves.smallest_wave_number();
    const double band   = waves.largest_wave_number() / lowest;
    const auto   add    = [&](const double q) {
      if (const double slope = waves.slope_square_below(q); slope > first)
        slopes.push_back(slope);
    };
    for (int k = 0; k < n; ++k)
      add(lowest * std::pow(band, .5 * (1 - std::cos(pi * k / n))));
    for (const double q : waves.corners())
      add(q);
    std::sort(slopes.begin(), slopes.end());
    // Neighbours closer than this are one magnification: half and double of it are
    // rounding as well, of the slopes that are compared.
    constexpr double resolved = 1e-13;
    slopes.erase(std::unique(slopes.begin(),
                             slopes.end(),
                             [](const double a, const double b) {
                               return b - a <= resolved * b;
                             }),
                 slopes.end());
    return slopes;
  }

  PerssonState
  PerssonTheory::solve(const double pressure) const
  {
    PerssonState state;
    const double smoothed = std::sqrt(2.) * pressure / modulus;
    state.pressure        = pressure;
    state.contact_area    = contact_area(pressure);
    state.mean_gap        = mean_gap(0., smoothed);

    const std::vector<double> slopes = magnifications(smoothed);
    double                    gap = 0., open = 0., height = 0.; // of the last one
    for (std::size_t k = 0; k < slopes.size(); ++k)
      {
        const double x           = smoothed / std::sqrt(slopes[k]);
        const double area        = std::erf(x);
        const double last_gap    = gap;
        const double last_open   = open;
        const double last_height = height;
        open                     = std::erfc(x);
        gap                      = mean_gap(slopes[k], smoothed / area);
        height             = waves.height_square_above(waves.wave_number_at(slopes[k]));
        const double share = open - last_open;
        if (k == 0 || !(share > 0))
          continue;
        // d(ūA)/dA as a quotient of differences, without that of products close to
        // each other.
        state.layers.push_back({share,
                                .5 * (gap + last_gap) + (1 - .5 * (open + last_open)) *
                                                          (last_gap - gap) / share,
                                std::sqrt(.5 * (height + last_height))});
      }
    return state;
  }

  GapDistribution
  PerssonTheory::distribution(const PerssonState &state, const double closed) const
  {
    // Where 1e-6 of the shortest waves' height is a gap, the fluid does not notice.
    const double    shortest = std::sqrt(waves.height_square_above(
      .5 * (waves.largest_wave_number() + waves.smallest_wave_number())));
    GapDistribution result;
    result.contact_area = state.contact_area;
    result.edges        = gap_bins(1e-6 * shortest,
                            1e3 * std::sqrt(waves.height_square()),
                            resolution.per_decade,
                            closed);
    const std::size_t n = result.edges.size() - 1;
    result.shares.assign(n, 0.);
    for (const GapLayer &layer : state.layers)
      {
        double below = 0;
        for (std::size_t k = 0; k < n; ++k)
          {
            // Whatever is larger belongs to the last bin; the walls are far apart there.
            const double next = k + 1 < n ? share_below(layer, result.edges[k + 1]) : 1.;
            result.shares[k] += layer.share * (next - below);
            below = next;
            if (below == 1.)
              break;
          }
      }
    result.gaps.push_back(.5 * result.edges[1]);
    for (std::size_t k = 1; k < n; ++k)
      result.gaps.push_back(closed + std::sqrt(std::max(result.edges[k] - closed, 0.) *
                                               (result.edges[k + 1] - closed)));
    return result;
  }

  double
  gap_density(const PerssonState &state, const double u)
  {
    double density = 0;
    for (const GapLayer &layer : state.layers)
      {
        const double scale = std::sqrt(.5) / layer.roughness;
        const double left  = (u - layer.separation) * scale;
        const double right = (u + layer.separation) * scale;
        density += layer.share * scale / std::sqrt(pi) *
                   (std::exp(-left * left) + std::exp(-right * right));
      }
    return density;
  }
} // namespace strait
