// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>

#include <mpi.h>

/** Checks that are made before any work is done. */
namespace strait
{
  /** Estimate the memory [bytes] that the grid of a scene takes on all ranks together,
   *  without the mesh of the flow. */
  double memory_of_grid(const Scene &scene);

  /** The memory available on this machine [bytes]: the least of what the system can give
   *  and the limits of this process and its container; infinite if none is known. */
  double free_memory();

  /** The sum over all ranks of the largest memory [bytes] that each process has had in
   *  RAM so far, program and libraries included. Collective. */
  double peak_memory(MPI_Comm comm);

  /** Throws InputError on all ranks if @p n_grids grids of @p scene, distributed evenly
   *  over the ranks, do not fit into the memory that is free on each machine.
   *  Collective. */
  void require_memory(const Scene &scene, MPI_Comm comm, int n_grids = 1);

  /** Throws InputError if results under @p load would be meaningless because no solid
   *  bears it, or @p fluid would lift the walls off. Only for scenes in stated units. */
  void require_bearable(const Scene &scene, double load, const FluidParameters &fluid);

  /** Warn of numbers of a scene in stated units that are powers of ten away from those of
   *  any seal. Throws InputError as require_bearable() does for each load. */
  void check_numbers(const Scene &scene, Log &log);

  /** Warn of an rms slope above 1 if the modulus is in physical units. Throws InputError
   *  instead for one above 10 if the unit of length is stated as well. */
  void check_slope(const Scene &scene, double rms_slope, Log &log);
} // namespace strait
