// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_transformed_surfaces_h
#define strait_surface_transformed_surfaces_h

#include <strait/surface/surface.h>

namespace strait
{
  /** Valleys for peaks: −h of another surface. */
  class InvertedSurface : public Surface
  {
  public:
    explicit InvertedSurface(std::unique_ptr<const Surface> surface);

    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    std::unique_ptr<const Surface> original;
  };

  /**
   * Another surface turned by 90° about the origin, counter-clockwise:
   * h(x, y) = h_original(y, −x). The original lives in the box ly × lx.
   */
  class RotatedSurface : public Surface
  {
  public:
    explicit RotatedSurface(std::unique_ptr<const Surface> surface);

    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    std::unique_ptr<const Surface> original;
  };
} // namespace strait

#endif
