// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_analytic_surfaces_h
#define strait_surface_analytic_surfaces_h

#include <strait/surface/surface.h>

namespace strait
{
  /** h = 0. */
  class FlatSurface : public Surface
  {
  public:
    SlabField heights(const SlabLayoutPtr &layout) const override;
  };

  /** h = Δ cos(2πx/lx), Westergaard's wave; Δ is the parameter Amplitude. */
  class SineSurface : public Surface
  {
  public:
    explicit SineSurface(const SurfaceParameters &parameters);

    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    double amplitude;
    double lx;
  };

  /**
   * h = Δ [2 + cos(2πx/lx) + cos(2πy/ly)], from 0 to 4Δ: peaks on a square
   * lattice; near closing, a saddle between them is an isolated constriction.
   */
  class SquareSaddleSurface : public Surface
  {
  public:
    explicit SquareSaddleSurface(const SurfaceParameters &parameters);

    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    double amplitude;
    double lx, ly;
  };

  /**
   * Three cosine waves c1 + c2 + c3 of equal length at 120° to each other, in
   * their rectangular periodic cell of 1 × √3 or √3 × 1 lattice spacings (two
   * peaks or four). Heights run from 0 to 4.5 Δ:
   *  - triangular peaks: h = Δ (3/2 + c1 + c2 + c3), peaks on a triangular
   *    lattice;
   *  - honeycomb peaks: h = Δ (3 − c1 − c2 − c3), the inversion of the former.
   */
  class LatticePeaksSurface : public Surface
  {
  public:
    /** Throws InputError unless the sides of the box are as 1 : √3. */
    explicit LatticePeaksSurface(const SurfaceParameters &parameters);

    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    double amplitude;
    bool   honeycomb;
    double lx, ly;
    /** Whether the long side, √3 lattice spacings, is along x. */
    bool long_in_x;
  };

  /**
   * A sphere of radius R (the parameter Amplitude) that touches h = 0 at the
   * centre of the box, in the approximation of small slopes, which the theory
   * of Hertz makes as well: the paraboloid h = −r²/(2R).
   */
  class SphereSurface : public Surface
  {
  public:
    explicit SphereSurface(const SurfaceParameters &parameters);

    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    double radius;
    double lx, ly;
  };
} // namespace strait

#endif
