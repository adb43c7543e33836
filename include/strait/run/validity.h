// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_validity_h
#define strait_run_validity_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/run/step.h>
#include <strait/seal/transition.h>

#include <string>
#include <vector>

namespace strait
{
  /** Compare @p step with every limit of the model for which @p scene gives what is
   *  needed, and warn of those that are passed. doc/validity.md lists the limits with
   *  their sources. @p rms_slope is that of the surface. Collective. */
  void judge_validity(Step &step, const Scene &scene, double rms_slope, Log &log);

  /** Why the exponent of the leak rate cannot be told from a step that leaks below its
   *  @p threshold: words for the column `status`. Warns of each, with what would help. */
  std::vector<std::string>
  doubts_near_threshold(const Step &step, const Transition &threshold, Log &log);

  /** Knudsen numbers, mean free path over gap. */
  struct KnudsenNumbers
  {
    double at_throat = 0.; // where the gap is smallest
    double mean      = 0.; // along the path, weighted with the fall of the pressure
  };

  /** Of a gas in viscous flow along @p path, where its squared pressure falls in
   *  proportion to ∫ ds/gap³. */
  KnudsenNumbers knudsen_numbers(const FlowPath &path, const Scene &scene);
} // namespace strait

#endif
