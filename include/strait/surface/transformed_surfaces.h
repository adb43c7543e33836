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

    Remarks
    remarks() const override
    {
      return original->remarks();
    }

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

    Remarks
    remarks() const override
    {
      return original->remarks();
    }

  private:
    std::unique_ptr<const Surface> original;
  };

  /**
   * Two rough bodies face to face: the second one, seen from its own side, is
   * turned over, so that h(x, y) = h_first(x, y) + h_second(−x, y).
   */
  class CombinedSurface : public Surface
  {
  public:
    CombinedSurface(std::unique_ptr<const Surface> first,
                    std::unique_ptr<const Surface> second);

    SlabField heights(const SlabLayoutPtr &layout) const override;
    Remarks   remarks() const override;

  private:
    std::unique_ptr<const Surface> first;
    std::unique_ptr<const Surface> second;
  };
} // namespace strait

#endif
