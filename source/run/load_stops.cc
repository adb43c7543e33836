// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/load_stops.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    /** Append the way back of a cycle: all stops in reverse order without the last
     *  load, the slip lengths of each load in their own order. */
    void
    append_way_back(std::vector<LoadStop> &stops, const std::size_t n_slips)
    {
      std::vector<LoadStop> all = stops;
      for (std::size_t k = stops.size(); k > n_slips; k -= n_slips)
        for (std::size_t slip = 0; slip < n_slips; ++slip)
          all.push_back(stops[k - 2 * n_slips + slip]);
      stops = std::move(all);
    }
  } // namespace

  std::vector<LoadStop>
  plan_stops(const Scene &scene, const std::vector<Transition> &thresholds)
  {
    const std::vector<double> slips =
      scene.fluid.enabled ? scene.fluid.slip_lengths : std::vector<double>{0.};
    std::vector<LoadStop> stops;
    for (const double target :
         scene.contact.enabled ? scene.programme.pressures : std::vector<double>{0.})
      for (const double slip_length : slips)
        stops.push_back({target, slip_length});

    if (scene.programme.path == LoadPath::cycle)
      append_way_back(stops, slips.size());

    std::vector<LoadStop> near_threshold;
    for (const Transition &threshold : thresholds)
      for (const double reduced : scene.programme.reduced_loads)
        near_threshold.push_back(
          {(1 - reduced) * threshold.middle(), threshold.slip_length, true});
    const bool upwards = scene.programme.path != LoadPath::unloading;
    std::stable_sort(near_threshold.begin(),
                     near_threshold.end(),
                     [upwards](const LoadStop &a, const LoadStop &b) {
                       return upwards ? a.target < b.target : a.target > b.target;
                     });
    if (!near_threshold.empty())
      near_threshold.front().begins_anew = true;
    stops.insert(stops.end(), near_threshold.begin(), near_threshold.end());
    return stops;
  }

  std::string
  branch_of(const Scene &scene, const std::vector<LoadStop> &stops, std::size_t k)
  {
    bool       loading = scene.programme.path != LoadPath::unloading;
    const bool matters =
      scene.contact.has_memory() || scene.programme.path == LoadPath::cycle;
    for (; matters && k > 0 && !stops[k].begins_anew; --k)
      if (stops[k].target != stops[k - 1].target)
        {
          // Mean gaps fall while the load grows.
          loading = (stops[k].target > stops[k - 1].target) == (scene.contact.loads());
          break;
        }
    return loading ? "loading" : "unloading";
  }
} // namespace strait
