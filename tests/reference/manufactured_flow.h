// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_tests_reference_manufactured_flow_h
#define strait_tests_reference_manufactured_flow_h

#include <array>

namespace strait::reference
{
  /**
   * A smooth solution of −∇·(K ∇p) = f on the unit square with K = g³/12
   * (viscosity 1): p = 1 on the inlet x = 0, p = 0 on the outlet x = 1, periodic
   * in y.
   */
  namespace manufactured_flow
  {
    /** g = 1 + ½ cos 2πx cos 2πy. */
    double gap(double x, double y);

    /** K = g³/12. */
    double conductivity(double x, double y);

    /** p = 1 − x + 0.1 sin πx cos 2πy. */
    double pressure(double x, double y);

    /** ∇p. */
    std::array<double, 2> pressure_gradient(double x, double y);

    /** f = −∇·(K ∇p). */
    double source(double x, double y);
  } // namespace manufactured_flow
} // namespace strait::reference

#endif
