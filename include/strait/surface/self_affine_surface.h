// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/surface_parameters.h>
#include <strait/spectral/slab_field.h>

#include <complex>
#include <string>
#include <vector>

namespace strait
{
  /**
   * A random self-affine surface h(r) = Σ_q h~(q) exp(i q·r), where
   * q = 2π (kx/lx, ky/ly) and kx, ky are integers.
   *
   * h~(q) is a function of the seed and the wave vector alone, so that the
   * realisation is the same on every grid and number of ranks. Waves that a
   * grid cannot carry (2|kx| ≥ nx or 2|ky| ≥ ny) are left out there; see
   * check_resolution().
   */
  class SelfAffineSurface
  {
  public:
    /** Collective. Throws InputError if no wave, or too many, lie in the band. */
    SelfAffineSurface(const SurfaceParameters &parameters, MPI_Comm communicator);

    /** The heights at the grid points of @p layout. Collective. */
    SlabField heights(const SlabLayoutPtr &layout) const;

    /** h~ of the wave vector (2π kx/lx, 2π ky/ly); h~(−q) is its conjugate. */
    std::complex<double> mode(int kx, int ky) const;

    /**
     * The height spectrum C(q) = ⟨|h~(q)|²⟩ of that wave vector [length²]: constant below
     * the roll-off 2π/λr, ∝ q^{−2(1+H)} from there to the cut-off 2π/λs (exclusive), zero
     * above and at q = 0.
     *
     * C is scaled such that Σ q² C (or Σ C), summed over all waves of the band, is the
     * square of the rms slope (or height) asked for. The sum does not depend on the grid,
     * so refining the grid never changes the surface. A realisation has the rms value
     * exactly with fixed amplitudes, and on average with Gaussian ones.
     */
    double spectrum(int kx, int ky) const;

  private:
    /** Σ C, or Σ q² C, over all waves, before C is scaled. */
    double band_sum(MPI_Comm communicator) const;

    SurfaceParameters parameters;
    double            roll_off; // as q/2π
    double            cut_off;  // as q/2π
    double            scale = 1.;
  };

  /**
   * Check whether @p grid carries the shortest waves of a self-affine surface; other
   * kinds pass. Throws InputError if there are fewer than two grid points per short
   * cut-off wavelength; fewer than four give a warning.
   * @return warnings for the user, one sentence each.
   */
  std::vector<std::string> check_resolution(const SurfaceParameters &parameters,
                                            const PeriodicGrid      &grid);
} // namespace strait
