// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait::reference
{
  /**
   * A smooth solution of ∇·(K ∇p) = 0 on the unit square with K = g³/12 (viscosity 1):
   * p = 1 on the inlet x = 0, p = 0 on the outlet x = 1, periodic in y. With harmonic
   * functions f and h, K = f² and p = h/f solve it: ∇·(K ∇p) = ∇·(f ∇h − h ∇f) = 0.
   */
  namespace manufactured_flow
  {
    /** K = f² with f = 1 + ½ cosh(2πx − π)/cosh π cos 2πy. */
    double conductivity(double x, double y);

    /** g = (12 K)^(1/3). */
    double gap(double x, double y);

    /** p = h/f with h = 1 − x + ½ sinh(2π − 2πx)/sinh 2π cos 2πy. */
    double pressure(double x, double y);
  } // namespace manufactured_flow
} // namespace strait::reference
