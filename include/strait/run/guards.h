// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_guards_h
#define strait_run_guards_h

#include <strait/base/scene.h>

#include <mpi.h>

#include <string>
#include <vector>

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

  /** Numbers of a scene in stated units that are off by powers of ten from what seals are
   *  made of, one sentence each. Throws InputError where no result would have a
   *  meaning. */
  std::vector<std::string> implausible_numbers(const Scene &scene);

  /** The same of the rms slope of the surface; empty if there is nothing to say. */
  std::string implausible_slope(const Scene &scene, double rms_slope);
} // namespace strait

#endif
