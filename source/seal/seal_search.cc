// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/channel.h>
#include <strait/seal/seal_search.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace strait
{
  SealSearch::SealSearch(const Scene         &scene_,
                         const SealModel     &model_,
                         const SlabLayoutPtr &layout_,
                         FlowDomain           domain_,
                         Log                 &log_)
    : scene(scene_)
    , model(model_)
    , layout(layout_)
    , domain(std::move(domain_))
    , log(log_)
    , side_of_path(scene.programme.path == LoadPath::unloading ? Side::sealed
                                                               : Side::open)
  {
  }

  std::vector<Transition>
  SealSearch::find_critical_loads(const SearchStart &first)
  {
    if (scene.fluid.feedback.keeps_trapped_fluid())
      log.warn(
        "the search for the critical load takes long steps, in which less fluid is "
        "trapped than in short ones: the load may be a few per cent too low, and so "
        "are those of Reduced loads; compare with short steps of Load "
        "programme/Pressures");
    std::vector<Transition> result;
    double                  slip_length = 0.;
    const auto              ask_load    = [&](const double load) {
      return ask({load, scene.fluid.inlet_pressure, slip_length}, side_of_path);
    };
    const auto name_of = [&](const double load) {
      return "a load of " + to_text(load) +
             (scene.fluid.has_slip() ? " with a slip length of " + to_text(slip_length)
                                     : "");
    };
    const double                    tolerance = scene.programme.threshold_tolerance;
    std::optional<TransitionSearch> search;
    for (const double next_length : scene.fluid.slip_lengths)
      {
        slip_length = next_length;
        // A contact, once probed, serves all slip lengths, unless it depends on its path.
        if (!search || scene.depends_on_path())
          {
            search.emplace(ask_load, tolerance, name_of);
            // Each path begins without a past. A search that is resumed had begun so.
            if (!is_replaying())
              open_state = sealed_state = std::nullopt;
          }
        const std::size_t   begin = next;
        const EnclosingPair passage =
          enclose(*search, first, -2. * slip_length, side_of_path);
        const double by_throat   = search->unresolved_distance(passage,
                                                             -2. * slip_length,
                                                             !scene.depends_on_path());
        Transition  &found       = result.emplace_back(between(*search, passage, begin));
        found.slip_length        = slip_length;
        found.grid_error         = by_throat;
        const PeriodicGrid &grid = layout->grid();
        if (scene.surface.has_crease_near(found.bottleneck,
                                          2. * std::max(grid.dx(), grid.dy())))
          {
            found.grid_error = std::numeric_limits<double>::infinity();
            log.warn(
              "the throat that closes last is in a crease of the surface (at the edges of "
              "the box, or of a mirrored map), which the load never closes but for the "
              "points: the finer they are, the higher is the critical load, without end");
          }
        log.line(
          format("threshold%s: critical load between %.10g and %.10g, contact "
                 "%.3f %% (%d contact solves, %ld FFT pairs)",
                 scene.fluid.has_slip()
                   ? format(" for slip length %.4g", slip_length).c_str()
                   : "",
                 found.lower,
                 found.upper,
                 100. * found.contact_area,
                 found.n_solves,
                 found.fft_pairs));
      }
    return result;
  }

  /** Enclose the transition between a smaller value, where the openness is above
   *  @p level, and a larger one; on the path that comes from @p side, if paths matter. */
  EnclosingPair
  SealSearch::enclose(TransitionSearch  &search,
                      const SearchStart &first,
                      const double       level,
                      const Side         side) const
  {
    if (!scene.depends_on_path())
      return scene.contact.zoom.enabled ? search.enclose_surely(first, level)
                                        : search.enclose(first, level);
    // enclose() is enough here: the steps along the path, with all windows, tell where
    // the state is lost.
    EnclosingPair found     = search.enclose(first, level);
    const bool    from_open = side == Side::open;
    if (!from_open)
      std::swap(found.before, found.beyond);
    const auto is_kept = [&](const Probe &probe) {
      return (probe.openness > level) == from_open;
    };
    const auto passage = search.enclose_loss(found.before,
                                             found.beyond - found.before,
                                             is_kept,
                                             found.beyond);
    if (!passage)
      throw ComputationError("The transition was not found: the seal stays " +
                             std::string(from_open ? "open" : "sealed") +
                             " however far one goes.");
    return *passage;
  }

  std::vector<BlowOut>
  SealSearch::find_blow_outs()
  {
    std::vector<BlowOut> result;
    for (const double load : scene.programme.pressures)
      {
        // The pressure rises without a past. A search that is resumed had begun so.
        if (!is_replaying())
          open_state = sealed_state = std::nullopt;
        result.push_back(blow_out(load));
        const BlowOut &found = result.back();
        log.line(
          format("blow-out at a load of %.6g: inlet pressure between %.8g and "
                 "%.8g (%d solves of contact and flow)",
                 load,
                 found.opening.lower,
                 found.opening.upper,
                 found.opening.n_solves));
        if (found.closing)
          log.line(format("it closes again between %.8g and %.8g",
                          found.closing->lower,
                          found.closing->upper));
      }
    return result;
  }

  BlowOut
  SealSearch::blow_out(const double load)
  {
    const std::size_t begin  = next;
    const double      outlet = scene.fluid.outlet_pressure;
    const double      slip   = scene.fluid.slip_lengths.front();
    const double      level  = -2. * slip;
    Side              side   = Side::sealed;
    // The search varies the inverse of the difference in pressure, with which the
    // openness falls as it does with a load.
    const auto inlet_pressure = [outlet](const double value) {
      return outlet + 1. / value;
    };
    const auto ask_pressure = [&](const double value) {
      return ask({load, inlet_pressure(value), slip}, side);
    };
    const auto name_of = [&](const double value) {
      return "an inlet pressure of " + to_text(inlet_pressure(value));
    };
    TransitionSearch search(ask_pressure, scene.programme.threshold_tolerance, name_of);
    const auto leaks = [level](const Probe &probe) { return probe.openness > level; };
    // The lower pressure is at the larger value.
    const auto in_pressure = [&](const EnclosingPair &passage) {
      Transition result   = between(search, passage, begin);
      result.contact_area = search.at(result.upper).contact_area;
      result.lower        = inlet_pressure(result.upper);
      result.upper        = inlet_pressure(std::min(passage.before, passage.beyond));
      return result;
    };

    BlowOut result;
    result.load = load;
    if (scene.programme.find_resealing)
      result.closing = Transition{0., outlet, outlet};
    const double none     = 1. / (TransitionSearch::negligible * load);
    const Probe  at_least = ask_pressure(none);
    if (leaks(at_least))
      {
        result.opening = {
          0., outlet, outlet, at_least.contact_area, at_least.bottleneck, 1, 0};
        return result;
      }
    // Begin at a tenth of the load: large steps may keep a state that small ones lose.
    const EnclosingPair opening = enclose(search, {10. / load, .6, none}, level, side);
    result.opening              = in_pressure(opening);
    if (result.closing)
      {
        side = Side::open;
        // Without hysteresis the seal closes at once.
        const double leaking = std::min(opening.before, opening.beyond);
        const double step    = scene.programme.threshold_tolerance * leaking;
        // The state that opened there is known only roughly.
        if (!leaks(search.ask_at(leaking)))
          result.closing = result.opening;
        else if (search.at(leaking).is_parted)
          {
            const double unknown = std::numeric_limits<double>::quiet_NaN();
            result.closing       = Transition{slip, unknown, unknown};
            log.warn(
              format("at a load of %.6g the walls part as soon as the fluid has "
                     "opened the seal, so that there is no state from which to "
                     "lower its pressure until it closes again",
                     load));
          }
        else if (const auto passage = search.enclose_loss(leaking, step, leaks))
          result.closing = in_pressure(*passage);
        result.opening.n_solves = static_cast<int>(next - begin);
      }
    return result;
  }

  /** The transition in @p passage, with the costs of the answers from @p begin on. */
  Transition
  SealSearch::between(const TransitionSearch &search,
                      const EnclosingPair    &passage,
                      const std::size_t       begin) const
  {
    Transition result;
    std::tie(result.lower, result.upper) = std::minmax(passage.before, passage.beyond);
    result.contact_area                  = search.at(result.lower).contact_area;
    result.bottleneck                    = search.at(result.lower).bottleneck;
    result.converged =
      search.at(result.lower).converged && search.at(result.upper).converged;
    result.n_solves = static_cast<int>(next - begin);
    for (std::size_t k = begin; k < next; ++k)
      result.fft_pairs += answers[k].fft_pairs;
    return result;
  }

  Probe
  SealSearch::ask(const Control &control, const Side path_comes_from)
  {
    if (!is_replaying())
      {
        answers.push_back(probe(control, path_comes_from));
        after_probe();
      }
    return answers[next++];
  }

  std::optional<SealState> &
  SealSearch::place_of(const Side side)
  {
    return side == Side::open || !scene.depends_on_path() ? open_state : sealed_state;
  }

  Probe
  SealSearch::probe(const Control &control, const Side path_comes_from)
  {
    const std::optional<SealState> &near = place_of(path_comes_from);
    // A path leads on from where it was, not back, except on the way back from a load
    // that left its indentations, along which none are added.
    const bool is_ahead =
      near &&
      (!scene.depends_on_path() || control.target == near->control.target ||
       (path_comes_from == Side::open) == (near->control.target < control.target) ||
       (path_comes_from == Side::sealed && scene.contact.yields));
    const Aim aim   = scene.depends_on_path() && path_comes_from == Side::sealed
                        ? Aim::seal
                        : Aim::verdict;
    SealState state = model(control, is_ahead ? &*near : nullptr, aim);
    if (!scene.depends_on_path())
      open_state.reset(); // this one takes its place

    // How firmly a point is closed is the indentation of one spacing by its pressure: a
    // length, which continues the gap with the same slope.
    const PeriodicGrid &grid = layout->grid();
    const double        softness =
      std::max(grid.dx(), grid.dy()) / scene.contact.effective_modulus;
    const Bottleneck bottleneck = find_bottleneck(signed_gap(state, softness), domain);

    const bool leaks = bottleneck.value > -2. * control.slip_length;
    Throat     throat;
    if (bottleneck.value > 0)
      throat = measure_throat(state.gap(), 0., bottleneck.point);
    const Probe result   = {bottleneck.value,
                            state.contact->contact_area,
                            position_of(state.gap().layout(), bottleneck.point),
                            throat.length / throat.spacing,
                            state.costs.fft_pairs,
                            report(state, leaks),
                            state.contact->has_detached()};
    const bool  is_sound = state.contact->converged && !result.is_parted;
    if (is_sound || !scene.depends_on_path())
      place_of(leaks ? Side::open : Side::sealed) = std::move(state);
    return result;
  }

  /** Report @p state to the log. Returns whether all solvers converged. */
  bool
  SealSearch::report(const SealState &state, const bool leaks) const
  {
    const Control &control = state.control;
    const bool agrees = !state.fluid || state.fluid->converged || state.fluid->lifted_off;
    log.progress(format("  load %.8g, inlet pressure %.6g: %s",
                        control.target,
                        control.inlet_pressure,
                        leaks ? "leaks" : "seals"));
    if (!state.contact->converged)
      log.warn(format("the contact did not converge at a load of %.6g, residual %.1e",
                      control.target,
                      state.contact->residual));
    if (!agrees)
      log.warn(
        format("contact and flow did not agree at a load of %.6g and an inlet "
               "pressure of %.6g",
               control.target,
               control.inlet_pressure));
    return state.contact->converged && agrees;
  }

  void
  SealSearch::transfer(StateArchive &archive)
  {
    archive.value(answers);
    if (archive.is_reading())
      next = 0;
    for (std::optional<SealState> *state : {&open_state, &sealed_state})
      if (transfer_presence(archive, *state))
        strait::transfer(archive, **state, layout);
  }
} // namespace strait
