// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_half_space_h
#define strait_contact_half_space_h

#include <strait/spectral/periodic_grid.h>

#include <cmath>

/**
 * How a periodic elastic half-space of the contact modulus E* answers waves: u~(q) =
 * 2 p~(q)/(q E*) for q ≠ 0 and u~(0) = 0 (Johnson, Contact Mechanics, 1985). p > 0
 * presses, u > 0 points away from the substrate. To be multiplied with by a
 * FourierTransform.
 */
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

  /** 2/(q E*), by which it answers a pressure, and 0 for a uniform one; to the digits of
   *  @p Number. */
  template <class Number>
  class WaveCompliance
  {
  public:
    WaveCompliance(const PeriodicGrid &grid, const double contact_modulus)
      : unit(grid.lx / (M_PI * contact_modulus))
      , aspect(static_cast<Number>(grid.lx / grid.ly))
    {
    }

    /** As of WaveStiffness. */
    double
    operator()(const int kx, const int ky) const
    {
      const Number x = static_cast<Number>(kx), y = static_cast<Number>(ky) * aspect;
      const Number square = x * x + y * y;
      return square > 0 ? unit / std::sqrt(square) : 0.;
    }

  private:
    double unit;
    Number aspect;
  };
} // namespace strait

#endif
