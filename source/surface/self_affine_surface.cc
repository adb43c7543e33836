// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/spectral/fourier_transform.h>
#include <strait/surface/self_affine_surface.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace strait
{
  namespace
  {
    const double two_pi = 2 * std::acos(-1.);

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

  SelfAffineSurface::SelfAffineSurface(const SurfaceParameters &parameters,
                                       MPI_Comm                 communicator)
    : spectrum(parameters, communicator)
    , seed(parameters.seed)
    , amplitudes(parameters.amplitudes)
  {
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
    // Draw for one of q and −q only: the surface is real.
    if (kx < 0 || (kx == 0 && ky < 0))
      return std::conj(mode(-kx, -ky));
    const double variance = spectrum(kx, ky);
    if (variance == 0.)
      return 0.;

    const std::uint64_t state = absorb(absorb(mix(seed), static_cast<std::uint64_t>(kx)),
                                       static_cast<std::uint64_t>(ky));
    const double        phase = two_pi * uniform(absorb(state, 1));
    double              modulus = std::sqrt(variance);
    // Box and Muller's transform, scaled to a mean square of one.
    if (amplitudes == Amplitudes::gaussian)
      modulus *= std::sqrt(-std::log(uniform(absorb(state, 2))));
    return std::polar(modulus, phase);
  }
} // namespace strait
