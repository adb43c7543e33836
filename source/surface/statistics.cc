// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/rounding.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/surface/statistics.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    using Mode = std::complex<double>;

    /** log C = a + b max(0, log q − log q_r), by weighted least squares. */
    struct Line
    {
      double a       = 0.;
      double b       = 0.;
      double chi2    = 0.;
      double b_error = 0.;
    };

    struct Sample
    {
      double log_q, log_c, weight;
    };

    Line
    fit_line(const std::vector<Sample> &samples, const double log_roll_off)
    {
      double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
      for (const Sample &sample : samples)
        {
          const double x = std::max(0., sample.log_q - log_roll_off);
          s += sample.weight;
          sx += sample.weight * x;
          sy += sample.weight * sample.log_c;
          sxx += sample.weight * x * x;
          sxy += sample.weight * x * sample.log_c;
        }
      const double determinant = s * sxx - sx * sx;
      Line         line;
      line.b = (s * sxy - sx * sy) / determinant;
      line.a = (sy - line.b * sx) / s;
      for (const Sample &sample : samples)
        line.chi2 +=
          sample.weight * std::pow(sample.log_c - line.a -
                                     line.b * std::max(0., sample.log_q - log_roll_off),
                                   2);
      const double freedom = static_cast<double>(samples.size()) - 3;
      line.b_error         = std::sqrt(line.chi2 / freedom * s / determinant);
      return line;
    }

    /** The logarithms of the bins up to a cut-off. */
    std::vector<Sample>
    usable(const std::vector<SpectrumBin> &spectrum)
    {
      // Density of a bin over that of the one before: less is a cut-off. With half of it,
      // one that lies within a bin may pass for a part of the law; with double of it, the
      // scatter of the first bins, of a few waves each, may pass for a cut-off.
      constexpr double drop = 1e-3;
      // The average over n waves has a relative variance of 1/n, and no law holds better
      // than to 10 %. With half of it the last bins, of many waves, weigh more against
      // the first ones, with double of it less.
      constexpr double    model_variance = 0.01;
      std::vector<Sample> samples;
      double              before = 0;
      for (const SpectrumBin &bin : spectrum)
        {
          if (!(bin.density > drop * before))
            {
              // The cut-off lies within the bin before, which is thus incomplete.
              if (!samples.empty())
                samples.pop_back();
              break;
            }
          before = bin.density;
          samples.push_back({std::log(bin.q),
                             std::log(bin.density),
                             1 / (1 / bin.modes + model_variance)});
        }
      return samples;
    }
  } // namespace

  SurfaceStatistics
  statistics(const SlabField &height)
  {
    const PeriodicGrid &grid = height.grid();

    std::array<double, 2> sums{}; // of q² |h~|² and (qx⁴ + qy⁴) |h~|²
    const auto            add =
      [&](const int kx, const int ky, const Mode &mode, const double weight) {
        const double qx_squared = std::pow(2 * M_PI * kx / grid.lx, 2);
        const double qy_squared = std::pow(2 * M_PI * ky / grid.ly, 2);
        const double power      = weight * std::norm(mode);
        sums[0] += power * (qx_squared + qy_squared);
        sums[1] += power * (qx_squared * qx_squared + qy_squared * qy_squared);
      };
    FourierTransform(height.layout_pointer()).analyze(height.data(), add);
    sum_in_place(height.layout().communicator(), sums);

    SurfaceStatistics result;
    result.rms_height       = rms(height);
    result.rms_slope        = std::sqrt(sums[0]);
    result.rms_curvature    = std::sqrt(sums[1] / 2);
    result.curvature_radius = 1 / result.rms_curvature;
    result.highest          = max_value(height);
    result.lowest           = min_value(height);
    return result;
  }

  std::vector<SpectrumBin>
  radial_spectrum(const SlabField &heights)
  {
    constexpr int       bins_per_octave = 4;
    const PeriodicGrid &grid            = heights.grid();
    const double        q_least         = 2 * M_PI / std::max(grid.lx, grid.ly);
    const double        q_most          = M_PI * std::min(1 / grid.dx(), 1 / grid.dy());
    const auto          bin_of          = [&](const double q) {
      return static_cast<int>(std::floor(bins_per_octave * std::log2(q / q_least) + 0.5));
    };
    const int           n_bins = bin_of(q_most) + 1; // the last one ends at q_most
    std::vector<double> sums(2 * static_cast<std::size_t>(std::max(n_bins, 1)), 0.);

    const auto add =
      [&](const int kx, const int ky, const Mode &mode, const double weight) {
        const double q = 2 * M_PI * std::hypot(kx / grid.lx, ky / grid.ly);
        if (q == 0. || q > (1 + rounding) * q_most)
          return;
        const int bin = bin_of(std::min(q, q_most));
        sums[2 * bin] += weight;
        sums[2 * bin + 1] += weight * std::norm(mode);
      };
    FourierTransform(heights.layout_pointer()).analyze(heights.data(), add);
    sum_in_place(heights.layout().communicator(), sums);

    std::vector<SpectrumBin> spectrum;
    const double             area  = grid.lx * grid.ly / (4 * M_PI * M_PI);
    const auto               limit = [&](const double bin) {
      return std::min(q_least * std::exp2(bin / bins_per_octave), q_most);
    };
    for (int bin = 0; bin < n_bins; ++bin)
      if (sums[2 * bin] > 0)
        spectrum.push_back({std::sqrt(limit(bin - .5) * limit(bin + .5)),
                            sums[2 * bin + 1] / sums[2 * bin] * area,
                            sums[2 * bin]});
    return spectrum;
  }

  std::optional<SelfAffineFit>
  fit_self_affine(const std::vector<SpectrumBin> &spectrum)
  {
    // Number of bins, three of which lie above the roll-off. With half of it the fit
    // would have more parameters than data; double of it refuses small grids.
    const std::vector<Sample> samples      = usable(spectrum);
    constexpr std::size_t     least_needed = 5;
    if (samples.size() < least_needed)
      return {};
    // The best roll-off between each two adjacent bins; at least three must lie above it.
    const double first = samples.front().log_q;
    const auto   chi2  = [&samples](const double place) {
      return fit_line(samples, place).chi2;
    };
    double roll_off = first, least = chi2(first);
    for (std::size_t k = 1; k + 3 < samples.size(); ++k)
      {
        const auto [place, value] =
          boost::math::tools::brent_find_minima(chi2,
                                                samples[k - 1].log_q,
                                                samples[k].log_q,
                                                std::numeric_limits<double>::digits / 2);
        if (value < least)
          {
            least    = value;
            roll_off = place;
          }
      }
    const Line    best = fit_line(samples, roll_off);
    SelfAffineFit fit;
    fit.hurst_exponent = -best.b / 2 - 1;
    fit.hurst_error    = best.b_error / 2;
    fit.roll_off       = std::exp(roll_off);
    fit.plateau        = std::exp(best.a);
    fit.q_from         = std::exp(first);
    fit.q_to           = std::exp(samples.back().log_q);
    fit.has_roll_off   = roll_off > samples[1].log_q;
    return fit;
  }
} // namespace strait
