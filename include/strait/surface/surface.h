// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_surface_h
#define strait_surface_surface_h

#include <strait/spectral/slab_field.h>

#include <string>
#include <vector>

namespace strait
{
  /** What is to be said of a surface: one sentence each. */
  struct Remarks
  {
    std::vector<std::string> notes;
    std::vector<std::string> warnings;
  };

  /** A rough, rigid, periodic substrate that can be sampled on any grid. */
  class Surface
  {
  public:
    virtual ~Surface() = default;

    /**
     * The height h at every point of the grid of @p layout, whose box must be
     * the Size of the scene; scene's unit of length. Collective.
     * Throws InputError (on all ranks) where the surface cannot be had on this
     * grid: a height map of another size, an expression that is not finite.
     */
    virtual SlabField heights(const SlabLayoutPtr &layout) const = 0;

    /** What was done to make the last heights(), for the user; on rank 0. */
    virtual Remarks
    remarks() const
    {
      return {};
    }
  };
} // namespace strait

#endif
