// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/contact_parameters.h>
#include <strait/base/exceptions.h>
#include <strait/base/rounding.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/surface/self_affine_surface.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace strait
{
  namespace
  {
    /** No grid resolves more waves along a side. */
    constexpr int most_waves_in_a_box = most_grid_points / 2;

    double
    square(const double value)
    {
      return value * value;
    }

    /** The finaliser of splitmix64 (Steele, Lea, Flood 2014): a bijection. */
    std::uint64_t
    mix(std::uint64_t bits)
    {
      bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
      bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
      return bits ^ (bits >> 31);
    }

    std::uint64_t
    absorb(const std::uint64_t state, const std::uint64_t word)
    {
      return mix((state ^ word) + 0x9e3779b97f4a7c15ULL);
    }

    /** A number in (0, 1], uniformly distributed. */
    double
    uniform(const std::uint64_t bits)
    {
      return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
    }
  } // namespace

  SelfAffineSurface::SelfAffineSurface(const SurfaceParameters &parameters_,
                                       MPI_Comm                 communicator)
    : parameters(parameters_)
    , roll_off(1 / parameters.roll_off_wavelength)
    // The cut-off itself is excluded; the margin makes that safe from rounding.
    , cut_off((1 - rounding) / parameters.short_cut_off_wavelength)
  {
    if (std::max(parameters.size[0], parameters.size[1]) * cut_off > most_waves_in_a_box)
      throw InputError("Surface/Short cut-off wavelength is less than 1/" +
                       std::to_string(most_waves_in_a_box) +
                       " of the box, which no grid resolves: make it longer or the box "
                       "smaller.");
    const double sum = band_sum(communicator);
    if (!(sum > 0))
      throw InputError(
        "Surface/Short cut-off wavelength leaves no wave in the box: make it "
        "shorter than the longer side of Surface/Size.");
    scale = square(parameters.rms_value) / sum;
  }

  double
  SelfAffineSurface::spectrum(const int kx, const int ky) const
  {
    const double wave_number =
      std::sqrt(square(kx / parameters.size[0]) + square(ky / parameters.size[1]));
    if (wave_number == 0. || wave_number >= cut_off)
      return 0.;
    if (wave_number < roll_off)
      return scale;
    return scale * std::pow(wave_number / roll_off, -2 * (1 + parameters.hurst_exponent));
  }

  double
  SelfAffineSurface::band_sum(MPI_Comm communicator) const
  {
    const auto &size = parameters.size;
    // Lines of constant kx are distributed over the ranks, but added up in the same
    // order everywhere, so that the sum does not depend on the number of ranks. One
    // quadrant stands for all four.
    const int           largest_kx = static_cast<int>(size[0] * cut_off) + 1;
    const int           largest_ky = static_cast<int>(size[1] * cut_off) + 1;
    std::vector<double> lines(largest_kx + 1, 0.);
    for (int kx = rank_in(communicator); kx <= largest_kx; kx += n_ranks_in(communicator))
      for (int ky = 0; ky <= largest_ky; ++ky)
        {
          const double q_squared =
            square(2 * M_PI) * (square(kx / size[0]) + square(ky / size[1]));
          const double weight = (kx > 0 ? 2. : 1.) * (ky > 0 ? 2. : 1.);
          lines[kx] +=
            weight * spectrum(kx, ky) * (parameters.rms_is_of_height ? 1. : q_squared);
        }
    sum_in_place(communicator, lines);

    double sum = 0;
    for (const double line : lines)
      sum += line;
    return sum;
  }

  SlabField
  SelfAffineSurface::heights(const SlabLayoutPtr &layout) const
  {
    const PeriodicGrid &grid = layout->grid();
    SlabField           field(layout);
    FourierTransform    transform(layout);
    transform.synthesize(field.data(), [&](const int kx, const int ky) {
      const bool carried = 2 * std::abs(kx) < grid.nx && 2 * std::abs(ky) < grid.ny;
      return carried ? mode(kx, ky) : std::complex<double>();
    });
    return field;
  }

  std::complex<double>
  SelfAffineSurface::mode(const int kx, const int ky) const
  {
    // Draw for only one of q and −q: the surface is real.
    if (kx < 0 || (kx == 0 && ky < 0))
      return std::conj(mode(-kx, -ky));
    const double variance = spectrum(kx, ky);
    if (variance == 0.)
      return 0.;

    const std::uint64_t state =
      absorb(absorb(mix(parameters.seed), static_cast<std::uint64_t>(kx)),
             static_cast<std::uint64_t>(ky));
    const double phase   = 2 * M_PI * uniform(absorb(state, 1));
    double       modulus = std::sqrt(variance);
    // The Box–Muller transform, scaled to a mean square of one.
    if (parameters.amplitudes == Amplitudes::gaussian)
      modulus *= std::sqrt(-std::log(uniform(absorb(state, 2))));
    return std::polar(modulus, phase);
  }

  std::vector<std::string>
  check_resolution(const SurfaceParameters &parameters, const PeriodicGrid &grid)
  {
    if (parameters.kind != SurfaceKind::self_affine)
      return {};
    const double wavelength = parameters.short_cut_off_wavelength;
    const double n_points   = wavelength / std::max(grid.dx(), grid.dy());
    // Exactly n points are not fewer than n, however Size was rounded.
    const auto fewer_than = [n_points](const int n) {
      return n_points < n * (1 - rounding);
    };

    const std::string finding =
      "Surface/Short cut-off wavelength = " + scene_number(wavelength) + " spans only " +
      scene_number(std::round(100 * n_points) / 100) + " grid points";
    const auto remedy = [&](const int n) {
      return "set Contact/Grid points = " +
             scene_number(std::ceil(n * grid.lx / wavelength - rounding)) + ", " +
             scene_number(std::ceil(n * grid.ly / wavelength - rounding)) +
             " or more, or a longer wavelength.";
    };
    if (fewer_than(2))
      throw InputError(finding + ", and two are needed at the least: " + remedy(2));
    if (fewer_than(4))
      return {finding + ", too few for trustworthy contact and flow: " + remedy(4)};
    return {};
  }
} // namespace strait
