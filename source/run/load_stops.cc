// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/load_sweep.h>
#include <strait/seal/make_seal.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  std::vector<LoadStop>
  plan_stops(const Scene &scene, const std::vector<Transition> &thresholds)
  {
    const std::vector<double> slips =
      scene.fluid.enabled ? scene.fluid.slip_lengths : std::vector<double>{0.};
    std::vector<double> targets =
      scene.contact.enabled ? scene.programme.pressures : std::vector<double>{0.};
    if (scene.programme.path == LoadPath::cycle) // and back, the last load only once
      for (auto k = static_cast<int>(targets.size()) - 2; k >= 0; --k)
        targets.push_back(targets[k]);
    std::vector<LoadStop> stops;
    for (const double target : targets)
      for (const double slip_length : slips)
        stops.push_back({target, slip_length});

    std::vector<LoadStop> near_threshold;
    for (const Transition &threshold : thresholds)
      for (const double reduced : scene.programme.reduced_loads)
        near_threshold.push_back(
          {(1 - reduced) * threshold.middle(), threshold.slip_length, true});
    const bool upwards     = scene.programme.path != LoadPath::unloading;
    const auto comes_first = [upwards](const LoadStop &a, const LoadStop &b) {
      return upwards ? a.target < b.target : a.target > b.target;
    };
    std::stable_sort(near_threshold.begin(), near_threshold.end(), comes_first);
    for (std::vector<LoadStop> *path : {&stops, &near_threshold})
      {
        double largest = 0.;
        for (const LoadStop &stop : *path)
          largest = std::max(largest, std::abs(stop.target));
        for (LoadStop &stop : *path)
          stop.largest_on_path = largest;
        if (!path->empty())
          path->front().starts_new_path = true;
      }
    stops.insert(stops.end(), near_threshold.begin(), near_threshold.end());

    const bool path_matters =
      scene.depends_on_path() || scene.programme.path == LoadPath::cycle;
    // Under gap control, loading means that the mean gap falls.
    const bool rises_with_load = scene.contact.is_load_controlled();
    const bool rises_on_path   = rises_with_load == upwards;
    bool       loads           = upwards;
    double     furthest        = 0.; // target of the path so far
    for (std::size_t k = 0; k < stops.size(); ++k)
      {
        LoadStop &stop = stops[k];
        if (stop.starts_new_path)
          {
            loads    = upwards;
            furthest = stop.target;
          }
        else if (path_matters && stop.target != stops[k - 1].target)
          loads = (stop.target > stops[k - 1].target) == rises_with_load;
        stop.branch = loads ? "loading" : "unloading";
        stop.goes_further =
          stop.target == furthest || (stop.target > furthest) == rises_on_path;
        if (stop.goes_further)
          furthest = stop.target;
      }
    return stops;
  }

  SealPath::SealPath(const Scene &scene_, SealModel model_)
    : model(std::move(model_))
    , scene(scene_)
  {
  }

  /** Whether steps at Reduced loads begin where the search for the critical load
   *  ended. */
  bool
  SealPath::begins_where_search_ended() const
  {
    return scene.contact.zoom.enabled ||
           (scene.contact.yields && scene.programme.path == LoadPath::unloading);
  }

  void
  SealPath::begin_after(SealSearch &search)
  {
    // Begin where the search ended, so that a channel that the fluid has opened does not
    // close before the first step, a throat keeps the windows in which it closed, and a
    // contact that opens again keeps its indentations. Other paths begin without a past.
    // If a resumed run has answers left to repeat, its checkpoint has the start.
    if (!search.is_replaying() &&
        ((scene.fluid.feedback.enabled && !scene.contact.adhesion.enabled) ||
         begins_where_search_ended()))
      start = search.take_state();
  }

  Arrival
  SealPath::advance_to(const LoadStop          &stop,
                       const Control           &control,
                       std::optional<SealState> last,
                       const Aim                aim)
  {
    if (stop.starts_new_path)
      last.reset();
    if (last && holds_under(control, *last)) // only the slip length differs
      {
        last->control               = control;
        last->costs.contact_seconds = 0.;
        return {std::move(last), {}};
      }
    // Windows shift the critical load a little, and indentations a lot: steps at Reduced
    // loads keep those with which it was found.
    const bool begins_at_start =
      !last || (begins_where_search_ended() && stop.is_reduced);
    const std::optional<SealState> &from    = begins_at_start ? start : last;
    Arrival                         arrival = follow(model,
                             control,
                             from ? &*from : nullptr,
                             aim,
                             step_rule(scene, stop.largest_on_path));
    const bool                      is_last_from_start =
      stop.is_reduced || scene.programme.reduced_loads.empty();
    if (arrival.state && !begins_where_search_ended() && is_last_from_start)
      start.reset();
    return arrival;
  }

  void
  SealPath::transfer(StateArchive &archive, const SlabLayoutPtr &layout)
  {
    if (transfer_presence(archive, start))
      strait::transfer(archive, *start, layout);
  }
} // namespace strait
