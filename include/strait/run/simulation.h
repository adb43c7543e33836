// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_simulation_h
#define strait_run_simulation_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/run/exponent_fit.h>
#include <strait/seal/seal_search.h>
#include <strait/spectral/periodic_grid.h>

#include <vector>

namespace strait
{
  /** The grid that @p scene asks for. */
  PeriodicGrid grid_of(const Scene &scene);

  /** What a run leaves besides its files. */
  struct RunSummary
  {
    bool                    converged = true;  // all steps
    bool                    stopped   = false; // by a signal, before the last step
    std::vector<Transition> thresholds;        // if the scene looks for them
    ExponentFit             exponent;          // of the leak rate at the smallest slip
    double                  crossover = 0.; // reduced load, see crossover_reduced_load()
    double theory_crossover = 0.; // that of the theory, if the scene asks for it
  };

  /**
   * Run @p scene, without its section Realisations, and write its results to the
   * output directory. Collective. Throws InputError before anything is written if the
   * scene's input is bad, and ComputationError if no threshold is found.
   *
   * With @p resume the run in the output directory is continued from its last complete
   * step; InputError, before anything is written, if its checkpoint does not serve.
   */
  RunSummary simulate(const Scene &scene, Log &log, bool resume = false);

  /**
   * Check @p scene as simulate() would and print sizes, memory, resolution
   * warnings and active effects; compute nothing but the surface. Collective.
   */
  void describe(const Scene &scene, Log &log);
} // namespace strait

#endif
