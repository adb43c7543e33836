// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_make_surface_h
#define strait_surface_make_surface_h

#include <strait/base/surface_parameters.h>
#include <strait/surface/surface.h>

#include <memory>

namespace strait
{
  /**
   * The surface that the section Surface of a scene describes, inverted and
   * rotated if it says so. Files are read here, on rank 0. Collective.
   * Throws InputError (on all ranks) for a bad file or expression, a box that
   * does not fit the kind, or a spectrum without a single wave.
   */
  std::unique_ptr<const Surface> make_surface(const SurfaceParameters &parameters,
                                              MPI_Comm                 communicator);
} // namespace strait

#endif
