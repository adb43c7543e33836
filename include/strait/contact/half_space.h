// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_half_space_h
#define strait_contact_half_space_h

#include <strait/spectral/fourier_transform.h>

#include <cmath>
#include <functional>

namespace strait
{
  /** E* q/2, by which a half-space answers a displacement by a wave of a periodic box. */
  class WaveStiffness
  {
  public:
    WaveStiffness(const PeriodicGrid &grid, const double contact_modulus)
      : unit(M_PI * contact_modulus / grid.lx)
      , aspect(grid.lx / grid.ly)
    {
    }

    /** Of the wave that fits into the box @p kx times along x and @p ky times along y. */
    double
    operator()(const int kx, const int ky) const
    {
      // In units of lx, so that tiny boxes do not underflow.
      const double x = kx, y = ky * aspect;
      return unit * std::sqrt(x * x + y * y);
    }

  private:
    double unit; // of the wave that fits once along x
    double aspect;
  };

  /**
   * A periodic elastic half-space: u = G p with u~(q) = 2 p~(q) / (q E*) for
   * q ≠ 0 and u~(0) = 0 (Johnson, Contact Mechanics, 1985). p > 0 presses, u > 0
   * points away from the substrate.
   */
  template <class Number>
  class BasicHalfSpace : private BasicFourierTransform<Number>
  {
    using Transform = BasicFourierTransform<Number>;

  public:
    /** @p contact_modulus is E* > 0. Collective. */
    BasicHalfSpace(const SlabLayoutPtr &layout, double contact_modulus);

    /**
     * u = G p, one value a local grid point; @p pressure and @p displacement may
     * be the same. Returns the mean of p·u over all grid points. Collective; one
     * FFT pair.
     */
    double apply(const Number *pressure, Number *displacement);

    /**
     * The same for callers that run over the rows before and after: before(row)
     * may still write the local row of the pressure, after(row, work), with the
     * mean of p·u, finds the displacement of the row. before() runs from the last
     * row to the first, and finds its row of scratch() unharmed. Collective.
     */
    double apply(const Number                           *pressure,
                 Number                                 *displacement,
                 const std::function<void(int)>         &before,
                 const std::function<void(int, double)> &after);

    // Of the transform: room for one value a local grid point that lasts until the next
    // apply(), to free that, how many FFT pairs there were, and bytes on this rank.
    using Transform::memory_consumption;
    using Transform::n_pairs;
    using Transform::release;
    using Transform::scratch;

  private:
    double modulus;
  };

  /** In double precision. */
  using HalfSpace = BasicHalfSpace<double>;
} // namespace strait

#endif
