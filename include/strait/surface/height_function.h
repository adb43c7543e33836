// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_height_function_h
#define strait_surface_height_function_h

#include <strait/base/surface_parameters.h>

#include <functional>

namespace strait
{
  /** The height at (x, y), in the scene's unit of length. */
  using HeightFunction = std::function<double(double x, double y)>;

  /**
   * The surfaces that are given by a formula; Δ is the parameter Amplitude, the box
   * lx × ly:
   *  - flat: h = 0.
   *  - sine: h = Δ cos(2πx/lx), Westergaard's wave.
   *  - square saddle: h = Δ [2 + cos(2πx/lx) + cos(2πy/ly)], from 0 to 4Δ: peaks on a
   *    square lattice; near closing, a saddle between them is an isolated constriction.
   *  - triangular and honeycomb peaks: three cosine waves c1 + c2 + c3 of equal length
   *    at 120° to each other, in their rectangular periodic cell of 1 × √3 or √3 × 1
   *    lattice spacings (two peaks or four). Heights run from 0 to 4.5 Δ.
   *    Triangular: h = Δ (3/2 + c1 + c2 + c3), peaks on a triangular lattice;
   *    honeycomb: h = Δ (3 − c1 − c2 − c3), the inversion of the former.
   *  - sphere: one of radius R = Δ that touches h = 0 at the centre of the box, in the
   *    approximation of small slopes, which the theory of Hertz makes as well: the
   *    paraboloid h = −r²/(2R).
   *  - expression: a muParser expression of x and y, in which lx, ly (sides of the box,
   *    before a rotation) and pi may be used.
   *
   * Throws InputError unless the sides of the box are as 1 : √3 where they must, and
   * if an expression is empty or cannot be parsed.
   */
  HeightFunction height_function(const SurfaceParameters &parameters);
} // namespace strait

#endif
