// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/periodic_grid.h>

#include <cmath>

/**
 * The response of a periodic elastic half-space of the contact modulus E* to waves:
 * u~(q) = 2 p~(q)/(q E*) for q ≠ 0 and u~(0) = 0 (Johnson, Contact Mechanics, 1985). A
 * pressure p > 0 presses; a displacement u > 0 points away from the substrate.
 */
namespace strait
{
  /**
   * Return the stiffness E* q/2 as a function of (kx, ky): the traction per displacement
   * for the wave that fits into the periodic box kx times along x and ky times along y.
   * Neither needs to be a whole number.
   */
  inline auto
  wave_stiffness(const PeriodicGrid &grid, const double contact_modulus)
  {
    // In units of lx, so that tiny boxes do not underflow.
    const double unit = M_PI * contact_modulus / grid.lx, aspect = grid.lx / grid.ly;
    return [=](const auto kx, const auto ky) {
      const double x = kx, y = ky * aspect;
      return unit * std::sqrt(x * x + y * y);
    };
  }

  /** Return the compliance 2/(q E*) as a function of (kx, ky): the displacement per
   *  pressure, 0 for a uniform one. It is computed in the precision of @p Number. */
  template <class Number>
  auto
  wave_compliance(const PeriodicGrid &grid, const double contact_modulus)
  {
    const auto unit   = static_cast<Number>(grid.lx / (M_PI * contact_modulus)),
               aspect = static_cast<Number>(grid.lx / grid.ly);
    return [=](const auto kx, const auto ky) {
      const Number x = static_cast<Number>(kx), y = static_cast<Number>(ky) * aspect;
      const Number square = x * x + y * y;
      return square > 0 ? unit / std::sqrt(square) : Number(0);
    };
  }
} // namespace strait
