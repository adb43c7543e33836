// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/theory/radial_spectrum.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** Return ∫ t^(power − 1) dt from 1 to e^x. */
    double
    growth(const double power, const double x)
    {
      return power == 0. ? x : std::expm1(power * x) / power;
    }

    /** Return the x at which growth() is @p fraction of its value at @p end. */
    double
    inverse_growth(const double power, const double fraction, const double end)
    {
      return power == 0. ? fraction * end
                         : std::log1p(fraction * std::expm1(power * end)) / power;
    }

    /** Return the section that contains @p q, if @p q is within the band. */
    std::vector<RadialSpectrum::Section>::const_iterator
    section_of(const std::vector<RadialSpectrum::Section> &sections, const double q)
    {
      const auto ends_beyond = [](const double value, const auto &section) {
        return value < section.to;
      };
      return std::upper_bound(sections.begin(), sections.end(), q, ends_beyond);
    }

    /** C = (q/from)^(−decay), not yet scaled. */
    RadialSpectrum::Section
    power_law(const double from, const double to, const double decay)
    {
      const double x = std::log(to / from);
      return {from,
              to,
              decay,
              2 * M_PI * from * from * growth(2 - decay, x),
              2 * M_PI * std::pow(from, 4) * growth(4 - decay, x)};
    }
  } // namespace

  RadialSpectrum::RadialSpectrum(std::vector<Section> sections_)
    : sections(std::move(sections_))
    , slope_below(sections.size() + 1, 0.)
    , height_above(sections.size() + 1, 0.)
  {
    for (std::size_t k = 0; k < sections.size(); ++k)
      slope_below[k + 1] = slope_below[k] + sections[k].slope_square;
    for (std::size_t k = sections.size(); k-- > 0;)
      height_above[k] = height_above[k + 1] + sections[k].height_square;
    require(height_above.front() > 0,
            "Theory/Enabled: the surface is flat, and the theory of rough "
            "contact has nothing to say about it; switch it off.");
  }

  double
  RadialSpectrum::slope_square_below(const double q) const
  {
    if (!(q > sections.front().from))
      return 0.;
    if (q >= sections.back().to)
      return slope_below.back();
    const auto   next  = section_of(sections, q);
    const double power = 4 - next->decay;
    return slope_below[next - sections.begin()] +
           next->slope_square * growth(power, std::log(q / next->from)) /
             growth(power, std::log(next->to / next->from));
  }

  double
  RadialSpectrum::height_square_above(const double q) const
  {
    if (!(q > sections.front().from))
      return height_above.front();
    if (q >= sections.back().to)
      return 0.;
    const auto   here  = section_of(sections, q);
    const double power = 2 - here->decay;
    return height_above[here - sections.begin() + 1] +
           here->height_square * std::pow(q / here->from, power) *
             growth(power, std::log(here->to / q)) /
             growth(power, std::log(here->to / here->from));
  }

  double
  RadialSpectrum::wave_number_at(const double slope_square) const
  {
    if (!(slope_square > 0))
      return sections.front().from;
    if (slope_square >= slope_below.back())
      return sections.back().to;
    const auto next =
      std::upper_bound(slope_below.begin(), slope_below.end(), slope_square);
    const std::size_t k = next - slope_below.begin() - 1;
    const Section    &s = sections[k];
    return s.from *
           std::exp(inverse_growth(4 - s.decay,
                                   (slope_square - slope_below[k]) / s.slope_square,
                                   std::log(s.to / s.from)));
  }

  RadialSpectrum
  model_spectrum(const SurfaceParameters &parameters)
  {
    const double box      = std::sqrt(parameters.size[0] * parameters.size[1]);
    const double lowest   = 2 * M_PI / box;
    const double roll_off = 2 * M_PI / parameters.roll_off_wavelength;
    const double cut_off  = 2 * M_PI / parameters.short_cut_off_wavelength;
    const double decay    = 2 * (1 + parameters.hurst_exponent);
    require(cut_off > lowest,
            "Surface/Short cut-off wavelength leaves no wave in the box: make "
            "it shorter than the side of Surface/Size.");
    std::vector<RadialSpectrum::Section> sections;
    if (roll_off > lowest)
      sections.push_back(power_law(lowest, std::min(roll_off, cut_off), 0.));
    if (cut_off > roll_off)
      sections.push_back(power_law(std::max(lowest, roll_off), cut_off, decay));
    double sum = 0;
    for (const auto &section : sections)
      sum += parameters.rms_is_of_height ? section.height_square : section.slope_square;
    const double scale = parameters.rms_value * parameters.rms_value / sum;
    for (auto &section : sections)
      {
        section.height_square *= scale;
        section.slope_square *= scale;
      }
    return RadialSpectrum(std::move(sections));
  }

  RadialSpectrum
  measured_spectrum(const SlabField &heights)
  {
    // Rings are as wide as the step between waves, and further out a fiftieth of their
    // radius. Half of that makes twice as many rings to integrate over; double of it
    // smooths the spectrum twice as much.
    constexpr double    widest = 1.02;
    const PeriodicGrid &grid   = heights.grid();
    const double        step   = 2 * M_PI / std::max(grid.lx, grid.ly);
    const double        last   = 2 * M_PI * std::hypot(.5 / grid.dx(), .5 / grid.dy());
    std::vector<double> edges(1, .5 * step);
    while (edges.back() <= last)
      edges.push_back(std::max(edges.back() + step, widest * edges.back()));

    const std::size_t   n_rings = edges.size() - 1;
    std::vector<double> sums(2 * n_rings, 0.);
    const auto          add_mode = [&](int kx, int ky, const auto &mode, double weight) {
      const double q = 2 * M_PI * std::hypot(kx / grid.lx, ky / grid.ly);
      if (q < edges.front())
        return;
      const std::size_t ring =
        std::upper_bound(edges.begin(), edges.end(), q) - edges.begin() - 1;
      sums[2 * ring] += weight * std::norm(mode);
      sums[2 * ring + 1] += weight * std::norm(mode) * q * q;
    };
    FourierTransform(heights.layout_pointer()).analyze(heights.data(), add_mode);
    sum_in_place(heights.layout().communicator(), sums);

    // Rings beyond the shortest wave hold only rounding: they add nothing to the sum.
    double total = 0;
    for (std::size_t k = 0; k < n_rings; ++k)
      total += sums[2 * k + 1];
    std::vector<RadialSpectrum::Section> sections;
    std::size_t                          n_used = n_rings;
    while (n_used > 0 && total + sums[2 * n_used - 1] == total)
      --n_used;
    double from = edges.front();
    for (std::size_t k = 0; k < n_used; ++k)
      if (sums[2 * k] > 0) // an empty ring becomes part of the next
        {
          sections.push_back({from, edges[k + 1], 0., sums[2 * k], sums[2 * k + 1]});
          from = edges[k + 1];
        }
    return RadialSpectrum(std::move(sections));
  }
} // namespace strait
