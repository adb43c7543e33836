// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/contact/grid_transfer.h>
#include <strait/run/load_sweep.h>
#include <strait/seal/make_seal.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    // A search begins on as few points as that each way: half of them know less of the
    // critical load than the surface's slope does, double of them cost four times as
    // much.
    constexpr int fewest_points = 256;

    // How far the critical load of every second point is off, relative, where no two
    // coarser grids tell: mostly less on sixteen random surfaces, 6e-3 on one of them.
    // A smaller one takes more solves where the two are farther apart, a larger one
    // begins with a wider bracket.
    constexpr double first_step = 2e-4;
  } // namespace

  int
  n_compared_grids(const Scene &scene)
  {
    // Where throats have windows every fourth point may find others, and tells no order.
    return scene.contact.zoom.enabled ? 1 : scene.output.error_budget ? 2 : 0;
  }

  CoarserSeals::CoarserSeals(const Scene             &scene_,
                             const ContactParameters &contact,
                             const SlabField         &heights,
                             Log                     &log_)
    : scene(scene_)
    , log(log_)
    , silent(heights.layout().communicator(), true)
  {
    if (!scene.fluid.enabled)
      return;
    const auto warn_of_unknown = [&](const char *why) {
      if (n_compared_grids(scene) > 0)
        log.warn(std::string("leak_rate_error is nan, as that of the contact grid is "
                             "not known: ") +
                 why);
    };
    if (scene.depends_on_path())
      {
        warn_of_unknown("no coarser grid has the same past of contact or fluid");
        return;
      }
    if (!can_be_coarsened(heights.grid()))
      warn_of_unknown("Contact/Grid points must be even and 64 or more to be halved");
    const bool searches = scene.programme.find_threshold && scene.fluid.mesh_file.empty();
    // Without the last level of windows, whose points are compared as well.
    ContactParameters coarser = contact;
    coarser.zoom.points_along_throat /= 3.;
    SlabField coarse = heights;
    while (can_be_coarsened(coarse.grid()) &&
           (size() < n_compared_grids(scene) ||
            (searches && std::min(coarse.grid().nx, coarse.grid().ny) > fewest_points)))
      {
        coarse = restrict_by_injection(coarse);
        seals.push_back({coarse.layout_pointer(),
                         make_seal(scene, coarser, coarse, nullptr, silent),
                         {},
                         {}});
      }
  }

  SearchStart
  CoarserSeals::find_critical_loads(SearchStart first)
  {
    for (auto seal = seals.rbegin(); seal != seals.rend(); ++seal)
      {
        if (seal->thresholds.empty())
          {
            SealSearch search(
              scene, seal->model, seal->layout, scene.fluid.direction, silent);
            seal->thresholds = search.find_critical_loads(first);
            seal->state      = search.take_state();
          }
        const double load = seal->thresholds.front().middle();
        log.progress(format("  critical load on %d × %d points: %.8g",
                            seal->layout->grid().nx,
                            seal->layout->grid().ny,
                            load));
        // Nearer than to the grid before.
        const double step = seal == seals.rbegin()
                              ? first_step
                              : std::max(std::abs(load / first.value - 1.),
                                         2. * scene.programme.threshold_tolerance);
        first             = {load, step};
      }
    return first;
  }

  double
  CoarserSeals::error_around_windows(const Transition &critical_load) const
  {
    const Transition *coarse =
      scene.contact.zoom.enabled && size() > 0
        ? threshold_of(seals.front().thresholds, critical_load.slip_length)
        : nullptr;
    return coarse == nullptr
             ? 0.
             : safety_factor * std::abs(coarse->middle() / critical_load.middle() - 1.);
  }

  void
  CoarserSeals::end_searches()
  {
    while (size() > n_compared_grids(scene))
      seals.pop_back();
  }

  SlabField
  CoarserSeals::gap(const int                    halvings,
                    Control                      control,
                    const std::optional<double> &reduced_load)
  {
    CoarserSeal &seal = seals[halvings - 1];
    if (const Transition *own = threshold_of(seal.thresholds, control.slip_length);
        own != nullptr && reduced_load)
      control.target = (1. - *reduced_load) * own->middle();
    SealState state =
      seal.model(control, seal.state ? &*seal.state : nullptr, Aim::leak_rate);
    // What is counted from a critical load begins in the windows that it was found with.
    if (!seal.thresholds.empty())
      return state.gap();
    seal.state = std::move(state);
    return seal.state->gap();
  }

  void
  CoarserSeals::transfer(StateArchive &archive)
  {
    for (CoarserSeal &seal : seals)
      {
        archive.value(seal.thresholds);
        if (transfer_presence(archive, seal.state))
          strait::transfer(archive, *seal.state, seal.layout);
      }
  }
} // namespace strait
