// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_self_affine_spectrum_h
#define strait_surface_self_affine_spectrum_h

#include <strait/base/surface_parameters.h>

#include <mpi.h>

#include <array>

namespace strait
{
  /**
   * The height spectrum C(q) = ⟨|h~(q)|²⟩ of a self-affine surface:
   * constant below the roll-off 2π/λr, ∝ q^{−2(1+H)} from there to the cut-off
   * 2π/λs (exclusive), zero above and at q = 0, where
   * q = 2π |(kx/lx, ky/ly)| and kx, ky are integers.
   *
   * C is scaled such that Σ q² C (or Σ C), summed over every wave of the band,
   * is the square of the rms slope (or height) asked for. The sum knows no grid,
   * so refining the grid never changes the surface. With fixed amplitudes a
   * realisation has the rms value exactly, with Gaussian ones on average.
   */
  class SelfAffineSpectrum
  {
  public:
    /** Collective. Throws InputError if no wave, or too many, lie in the band. */
    SelfAffineSpectrum(const SurfaceParameters &parameters, MPI_Comm communicator);

    /** C of the wave vector (2π kx/lx, 2π ky/ly), in length². */
    double operator()(int kx, int ky) const;

  private:
    /** Σ C, or Σ q² C, over all waves, before C is scaled. */
    double band_sum(Normalisation normalisation, MPI_Comm communicator) const;

    std::array<double, 2> size;
    double                hurst_exponent;
    double                roll_off; // of q/2π
    double                cut_off;  // of q/2π
    double                scale = 1.;
  };
} // namespace strait

#endif
