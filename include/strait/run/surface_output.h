// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_surface_output_h
#define strait_run_surface_output_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/contact/contact_state.h>
#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * Say what the surface on the grid is like: rms values, and of a measured one or
   * where the scene asks for the spectrum, Hurst exponent and roll-off. Throws InputError
   * for a slope that no surface has. Collective.
   */
  void report_surface(const Scene &scene, const SlabField &heights, Log &log);

  /**
   * Write surface.nc and spectrum.csv to the output directory as far as the scene
   * asks for them. Collective.
   */
  void write_surface(const Scene &scene, const SlabField &heights);

  /** Write surface-indented.nc, @p heights as @p contact has left them behind, if the
   * scene asks for surface.nc and the contact yields. Collective. */
  void write_indented_surface(const Scene        &scene,
                              const SlabField    &heights,
                              const ContactState &contact);
} // namespace strait

#endif
