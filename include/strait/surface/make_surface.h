// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_make_surface_h
#define strait_surface_make_surface_h

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
   */
  SlabField make_surface(const SurfaceParameters &parameters,
                         const SlabLayoutPtr     &layout,
                         Remarks                 *remarks = nullptr);
} // namespace strait

#endif
