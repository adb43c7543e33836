// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_expression_surface_h
#define strait_surface_expression_surface_h

#include <strait/surface/surface.h>

#include <array>
#include <string>

namespace strait
{
  /**
   * h(x, y) as a muParser expression of x and y, in which lx, ly (sides of the
   * box, before a rotation) and pi may be used.
   */
  class ExpressionSurface : public Surface
  {
  public:
    /** Throws InputError if the expression is empty or cannot be parsed. */
    explicit ExpressionSurface(const SurfaceParameters &parameters);

    SlabField heights(const SlabLayoutPtr &layout) const override;

  private:
    std::string           expression;
    std::array<double, 2> size;
  };
} // namespace strait

#endif
