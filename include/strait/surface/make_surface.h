// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/surface_parameters.h>
#include <strait/spectral/slab_field.h>

namespace strait
{
  struct Remarks;

  /**
   * Make the surface that the section Surface of a scene describes, inverted and rotated
   * if asked for: its height h, in the scene's unit of length, at every grid point of
   * @p layout, whose box must be the Size of the scene. Rank 0 reads the files; its
   * @p remarks, if wanted, tell what was done to a map and what is doubtful. Collective.
   * Throws InputError (on all ranks) for a bad file or expression, a box or a grid that
   * does not fit the kind, a spectrum without a wave, or a height that is not finite.
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
   *    approximation of small slopes, as in Hertz's theory.
   *  - expression: a muParser expression of x and y, in which lx, ly (sides of the box,
   *    before a rotation) and pi may be used.
   */
  SlabField make_surface(const SurfaceParameters &parameters,
                         const SlabLayoutPtr     &layout,
                         Remarks                 *remarks = nullptr);
} // namespace strait
