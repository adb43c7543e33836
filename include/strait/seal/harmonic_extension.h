// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_harmonic_extension_h
#define strait_seal_harmonic_extension_h

#include <strait/base/fluid_parameters.h>
#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * Continues a fluid pressure, known at the open grid points, smoothly under the
   * contact: there it solves Laplace's equation (five-point stencil), with the
   * pressure at the open points around it and at the reservoirs as boundary values.
   * So it obeys the maximum principle, and a uniform pressure stays uniform.
   *
   * A point that is about to open must not change the result at once, or the iteration
   * of contact and flow jumps to and fro with it. Points at the contact line, whose gap
   * is less than half of the largest beside them, are therefore tied to the fluid by a
   * spring: −∇²p + κ (p − p_f) = 0, with κ from 0 where the gap vanishes to infinity
   * where the point counts as open.
   *
   * Conjugate gradients, preconditioned by successive over-relaxation to and fro, each
   * rank by its own rows.
   *
   * @p pressure: on entry that of the fluid where @p flow_gap > 0 and a start
   * elsewhere; on return that everywhere, to 1e-7 of the boundary values. On the seam,
   * which is inlet and outlet at once, every point gets the mean of the two reservoirs,
   * as the sum over the grid is a trapezoidal rule. Returns the number of iterations.
   * Collective.
   */
  int extend_under_contact(SlabField       &pressure,
                           const SlabField &flow_gap,
                           FlowDirection    direction,
                           double           inlet_pressure,
                           double           outlet_pressure);
} // namespace strait

#endif
