// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/surface_parameters.h>
#include <strait/spectral/slab_field.h>

namespace strait
{
  struct Remarks;

  /**
   * The surface that the section Surface of a scene describes, inverted and rotated if it
   * says so: its height h at every point of the grid of @p layout, whose box must be the
   * Size of the scene; scene's unit of length. Files are read on rank 0, which gets
   * @p remarks on what was done to a map, if wanted. Collective. Throws InputError (on
   * all ranks) for a bad file or expression, a box or a grid that does not fit the kind,
   * a spectrum without a single wave, or an expression that is not finite.
   *
   * Some surfaces are given by a formula, in which Δ is the parameter Amplitude:
   *  - sine: Westergaard's wave.
   *  - square saddle: heights from 0 to 4Δ, peaks on a square lattice; near closing, a
   *    saddle between them is an isolated constriction.
   *  - triangular and honeycomb peaks: three cosine waves c1 + c2 + c3 of equal length
   *    at 120° to each other, in their rectangular periodic cell of 1 × √3 or √3 × 1
   *    lattice spacings (two peaks or four). Heights run from 0 to 4.5 Δ; one is the
   *    inversion of the other.
   *  - sphere: one of radius R = Δ that touches h = 0 at the centre of the box, in the
   *    approximation of small slopes, which the theory of Hertz makes as well.
   *  - expression: a muParser expression of x and y, in which lx, ly (sides of the box,
   *    before a rotation) and pi may be used.
   */
  SlabField make_surface(const SurfaceParameters &parameters,
                         const SlabLayoutPtr     &layout,
                         Remarks                 *remarks = nullptr);
} // namespace strait
