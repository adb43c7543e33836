// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
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
    // Most points along the shorter side of the grid on which a search begins. Half of
    // them tell less of the critical load than the slope of the surface does, double of
    // them cost four times as much.
    constexpr int fewest_points = 256;

    double
    change(const Transition &coarse, const Transition &fine)
    {
      return std::abs((coarse.middle() - fine.middle()) / fine.middle());
    }

    /** Return how far, relative, the transition @p found may lie from that on finer
     *  grids, estimated from that on every @p second point and, if not null, on every
     *  @p fourth one. Not a number if there is no transition, because the seal leaks by
     *  itself or stays open. */
    double
    grid_error_from(const Transition &second,
                    const Transition *fourth,
                    const Transition &found)
    {
      if (!(found.lower < found.upper))
        return std::nan("");
      const double error = CoarserSeals::safety_factor * change(second, found);
      if (fourth == nullptr || !(second.middle() > 0.))
        return error;
      // The last two may agree by chance: assume at least half of the change before.
      return std::max(error, .5 * change(*fourth, second));
    }

    /** Whether the search for critical loads begins on coarser grids. */
    bool
    searches_from_coarser_grids(const Scene &scene)
    {
      return scene.programme.find_threshold && scene.fluid.mesh_file.empty() &&
             !scene.depends_on_path();
    }

    /** Return how many coarser grids results are compared with. */
    int
    n_wanted_grids(const Scene &scene)
    {
      // On a path the transitions on two grids may agree by chance: there is a third one.
      if (scene.output.error_budget && scene.depends_on_path() &&
          (scene.programme.find_threshold || scene.programme.find_blow_out))
        return 2;
      // A formula or a map may have unknown creases, for which a coarser grid is a test.
      const bool may_have_creases = scene.surface.kind == SurfaceKind::expression ||
                                    scene.surface.kind == SurfaceKind::file;
      return std::max(n_compared_grids(scene),
                      may_have_creases && searches_from_coarser_grids(scene) ? 1 : 0);
    }

    /** Warn if @p scene wants the error of the contact grid, and it is not known. */
    void
    warn_of_unknown_error(const Scene &scene, const char *why, Log &log)
    {
      if (n_compared_grids(scene) > 0)
        log.warn(std::string("leak_rate_error is nan, as that of the contact grid is "
                             "not known: ") +
                 why);
    }
  } // namespace

  int
  n_compared_grids(const Scene &scene)
  {
    if (!scene.contact.zoom.enabled && !scene.output.error_budget)
      return 0;
    // Every fourth point tells no order if it may have other windows around throats or
    // have followed another path.
    return scene.contact.zoom.enabled || scene.depends_on_path() ? 1 : 2;
  }

  void
  warn_of_unknown_grid_error(const Scene &scene, const PeriodicGrid &grid, Log &log)
  {
    if (scene.fluid.enabled && !can_be_coarsened(grid))
      warn_of_unknown_error(
        scene, "Contact/Grid points must be even and 64 or more to be halved", log);
  }

  CoarserSeals::CoarserSeals(const Scene             &scene_,
                             const ContactParameters &contact,
                             const SlabField         &heights,
                             Log                     &log_)
    : scene(scene_)
    , log(log_)
    , progress_only(&log_)
  {
    if (!scene.fluid.enabled)
      return;
    warn_of_unknown_grid_error(scene, heights.grid(), log);
    const int n_wanted = n_wanted_grids(scene);
    // Leave out the last level of windows, to compare their points as well.
    ContactParameters coarser = contact;
    coarser.zoom.points_along_throat /= 3.;
    SlabField coarse = heights;
    try
      {
        while (can_be_coarsened(coarse.grid()) &&
               (size() < n_wanted ||
                (searches_from_coarser_grids(scene) &&
                 std::min(coarse.grid().nx, coarse.grid().ny) > fewest_points)))
          {
            coarse = restrict_by_injection(coarse);
            seals.push_back(make(coarser, coarse));
          }
      }
    catch (const InputError &)
      {
        if (size() == 0)
          warn_of_unknown_error(
            scene, "the range of the adhesion is too short for every second point", log);
      }
  }

  CoarserSeals::CoarserSeal
  CoarserSeals::make(const ContactParameters &contact, const SlabField &heights)
  {
    const SlabLayoutPtr       &layout = heights.layout_pointer();
    std::unique_ptr<FlowStage> flow;
    if (scene.fluid.feedback.enabled)
      flow = std::make_unique<FlowStage>(scene.fluid, layout, progress_only, timers);
    SealModel model = make_seal(scene, contact, heights, flow.get(), progress_only);
    return {layout, std::move(flow), {scene, std::move(model)}, {}, {}};
  }

  template <typename Find>
  auto
  CoarserSeals::search(const CoarserSeal &seal, const Find &find)
  {
    SealSearch search(
      scene, seal.path.model, seal.layout, scene.fluid.direction, progress_only);
    try
      {
        return find(search);
      }
    catch (const ComputationError &error)
      {
        log.warn(format("on %d × %d points, with which the contact grid is compared: %s",
                        seal.layout->grid().nx,
                        seal.layout->grid().ny,
                        error.what()));
        return decltype(find(search))();
      }
  }

  SearchStart
  CoarserSeals::find_critical_loads(SearchStart first)
  {
    for (auto seal = seals.rbegin(); seal != seals.rend(); ++seal)
      {
        log.stage(format("critical load on %d × %d points",
                         seal->layout->grid().nx,
                         seal->layout->grid().ny));
        if (seal->thresholds.empty())
          seal->thresholds = search(*seal, [&](SealSearch &own) {
            auto found = own.find_critical_loads(first);
            if (scene.depends_on_path())
              seal->path.begin_after(own);
            else
              seal->state = own.take_state();
            return found;
          });
        if (seal->thresholds.empty())
          continue;
        const double load = seal->thresholds.front().middle();
        log.progress(format(": %.8g", load));
        if (scene.depends_on_path()) // each search begins like that of the grid itself
          continue;
        // The first step goes as far as finer points may shift the critical load.
        const double away = seal->thresholds.front().grid_error;
        const double step = std::max(std::isfinite(away) ? away : 0.,
                                     2. * scene.programme.threshold_tolerance);
        first = {load, step};
      }
    return first;
  }

  void
  CoarserSeals::complete_grid_error(Transition &critical_load) const
  {
    const auto on_points = [&](const int halvings) {
      return size() < halvings
               ? nullptr
               : threshold_of(seals[halvings - 1].thresholds, critical_load.slip_length);
    };
    const Transition *second = on_points(1);
    double           &error  = critical_load.grid_error;
    if (scene.depends_on_path() || scene.contact.zoom.enabled)
      error += second == nullptr ? std::nan("")
                                 : grid_error_from(*second, on_points(2), critical_load);
    // Every fourth point may be too coarse for the surface, and refutes no estimate.
    else if (second != nullptr &&
             change(*second, critical_load) > safety_factor * second->grid_error)
      error = std::max(error, grid_error_from(*second, nullptr, critical_load));
  }

  void
  CoarserSeals::estimate_grid_errors(std::vector<BlowOut> &blow_outs)
  {
    if (!scene.output.error_budget || size() == 0)
      return;
    std::vector<std::vector<BlowOut>> coarse;
    for (const CoarserSeal &seal : seals)
      coarse.push_back(
        search(seal, [](SealSearch &own) { return own.find_blow_outs(); }));
    const auto compare = [&](const auto &pressure_of) {
      for (std::size_t k = 0; k < coarse.front().size(); ++k)
        if (Transition *found = pressure_of(blow_outs[k]))
          {
            const bool has_fourth = coarse.size() > 1 && !coarse[1].empty();
            found->grid_error =
              grid_error_from(*pressure_of(coarse[0][k]),
                              has_fourth ? pressure_of(coarse[1][k]) : nullptr,
                              *found);
          }
    };
    compare([](BlowOut &found) { return &found.opening; });
    compare([](BlowOut &found) { return found.closing ? &*found.closing : nullptr; });
  }

  void
  CoarserSeals::end_searches()
  {
    while (size() > n_compared_grids(scene))
      seals.pop_back();
  }

  void
  CoarserSeals::advance_to(const LoadStop   &stop,
                           const Transition *reference_critical_load)
  {
    for (CoarserSeal &seal : seals)
      {
        if (!seal.state && !stop.starts_new_path) // the surfaces have parted
          continue;
        Control control{stop.target, scene.fluid.inlet_pressure, stop.slip_length};
        if (const Transition *own = threshold_of(seal.thresholds, stop.slip_length);
            own != nullptr && reference_critical_load != nullptr && stop.is_reduced)
          control.target *= own->middle() / reference_critical_load->middle();
        seal.state =
          seal.path.advance_to(stop, control, std::move(seal.state), Aim::leak_rate)
            .state;
      }
  }

  std::optional<SlabField>
  CoarserSeals::gap(const int                    halvings,
                    Control                      control,
                    const std::optional<double> &reduced_load)
  {
    CoarserSeal &seal = seals[halvings - 1];
    if (scene.depends_on_path())
      return seal.state && seal.state->converged()
               ? std::optional<SlabField>(seal.state->gap())
               : std::nullopt;
    if (const Transition *own = threshold_of(seal.thresholds, control.slip_length);
        own != nullptr && reduced_load)
      control.target = (1. - *reduced_load) * own->middle();
    SealState state =
      seal.path.model(control, seal.state ? &*seal.state : nullptr, Aim::leak_rate);
    // Reduced loads begin in the windows in which the critical load was found.
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
        seal.path.transfer(archive, seal.layout);
      }
  }
} // namespace strait
