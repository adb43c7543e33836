// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/run/step.h>

#include <string>

namespace strait
{
  // doc/results.md describes the contents of the files. All functions are collective.

  /** Write fields-STEP.h5 to @p directory, and fields-STEP.xmf beside it. Fields of an
   *  effect that is off are absent. */
  void write_grid_fields(const std::string &directory, const Step &step, MPI_Comm comm);

  /** Write flow-STEP.vtu and flow-STEP.pvtu to @p directory for ParaView, and flow.pvd,
   *  which lists those of all steps. Write nothing if nothing percolates. */
  void write_flow_fields(const std::string &directory, const Step &step);

  /** Write picture-STEP.h5 to @p directory, from which the plotting script draws
   *  picture-STEP.png: the fields at grid points, at most 1024 along a side. */
  void write_picture_data(const std::string     &directory,
                          const Step            &step,
                          const FluidParameters &fluid);

  /** Make the surface on the grid of @p scene, and report to @p log what is known of both
   *  before a contact. Throws InputError for numbers that have no meaning, and if the
   *  grid is too coarse for the surface or too large for the memory. */
  SlabField make_heights(const Scene &scene, MPI_Comm comm, Log &log);

  /** Write surface.nc and spectrum.csv to the output directory, if the scene asks for
   *  them. */
  void write_surface(const Scene &scene, const SlabField &heights);

  /** Write surface-indented.nc, @p heights less the indentation that @p contact has left,
   *  if the scene asks for surface.nc and the contact yields. */
  void write_indented_surface(const Scene        &scene,
                              const SlabField    &heights,
                              const ContactState &contact);
} // namespace strait
