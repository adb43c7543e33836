// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_load_stops_h
#define strait_run_load_stops_h

#include <strait/base/scene.h>
#include <strait/seal/seal_search.h>

#include <cstddef>
#include <string>
#include <vector>

namespace strait
{
  /** One step to come. */
  struct LoadStop
  {
    double target; // nominal pressure or mean gap
    double slip_length;
    bool   is_reduced  = false; // the target is that far from the critical load
    bool   begins_anew = false; // a contact that remembers begins a new path here
  };

  /**
   * The steps of @p scene in their order: the Pressures, back again in a cycle, each
   * with all slip lengths; and the Reduced loads of each of the @p thresholds.
   */
  std::vector<LoadStop> plan_stops(const Scene                   &scene,
                                   const std::vector<Transition> &thresholds);

  /** "loading" or "unloading": what the scene says, but where the path matters or turns
   *  the direction of the last change up to the stop @p k. */
  std::string
  branch_of(const Scene &scene, const std::vector<LoadStop> &stops, std::size_t k);
} // namespace strait

#endif
