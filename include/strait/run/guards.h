// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>

#include <mpi.h>

/** What is looked at before any work is done. */
namespace strait
{
  /** Bytes that the grid of a scene takes on all ranks together, without the mesh of the
   *  flow. */
  double memory_of_grid(const Scene &scene);

  /** Memory that processes of this machine can still get [bytes]: what the system and the
   *  limits of this process and its container leave; infinite where that is unknown. */
  double free_memory();

  /** The most bytes that the processes of all ranks have had in RAM so far, with the
   *  program and its libraries. Collective. */
  double most_memory(MPI_Comm comm);

  /** Throws InputError on all ranks if the grid of @p scene, or @p n_grids of them that
   *  are shared out evenly, do not fit into the memory that is free on one of the
   * machines that share them. Collective. */
  void require_memory(const Scene &scene, MPI_Comm comm, int n_grids = 1);

  /** Throws InputError if no result under a load would have a meaning, in stated units:
   *  no solid bears it, or @p fluid would lift the walls off. */
  void require_bearable(const Scene &scene, double load, const FluidParameters &fluid);

  /** Warn of numbers of a scene in stated units that are off by powers of ten from what
   *  seals are made of. Throws InputError as require_bearable() does. */
  void check_numbers(const Scene &scene, Log &log);

  /** The same of the rms slope of the surface. */
  void check_slope(const Scene &scene, double rms_slope, Log &log);
} // namespace strait
