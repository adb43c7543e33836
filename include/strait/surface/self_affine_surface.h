// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_self_affine_surface_h
#define strait_surface_self_affine_surface_h

#include <strait/surface/self_affine_spectrum.h>
#include <strait/surface/surface.h>

#include <complex>

namespace strait
{
  /**
   * A random self-affine surface h(r) = Σ_q h~(q) exp(i q·r).
   *
   * h~(q) is a function of the seed and the wave vector alone, so that the
   * realisation is the same on every grid and number of ranks. Waves that a
   * grid cannot carry (2|kx| ≥ nx or 2|ky| ≥ ny) are left out there; see
   * check_resolution().
   */
  class SelfAffineSurface : public Surface
  {
  public:
    /** Collective. Throws InputError as SelfAffineSpectrum does. */
    SelfAffineSurface(const SurfaceParameters &parameters, MPI_Comm communicator);

    SlabField heights(const SlabLayoutPtr &layout) const override;

    /** h~ of the wave vector (2π kx/lx, 2π ky/ly); h~(−q) is its conjugate. */
    std::complex<double> mode(int kx, int ky) const;

  private:
    SelfAffineSpectrum spectrum;
    unsigned long long seed;
    Amplitudes         amplitudes;
  };
} // namespace strait

#endif
