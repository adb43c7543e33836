// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_theory_run_h
#define strait_run_theory_run_h

#include <strait/base/log.h>
#include <strait/base/scene.h>

namespace strait
{
  /**
   * Evaluate the theory alone at every load and slip length of @p scene and write its
   * results to the output directory. Makes heights on a grid only to measure their
   * spectrum, where the scene asks for that. Collective on @p comm. Throws InputError
   * before anything is written if the scene's input is bad.
   */
  void run_theory(const Scene &scene, Log &log, MPI_Comm comm);

  /** What run_theory() would do; computes nothing but the surface. Collective. */
  void describe_theory(const Scene &scene, Log &log);
} // namespace strait

#endif
