// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/percolation/bottleneck.h>
#include <strait/seal/seal_search.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace strait
{
  void
  transfer(StateArchive &archive, std::vector<Transition> &transitions)
  {
    transfer_all(archive, transitions, [&](Transition &transition) {
      archive.values(transition.slip_length,
                     transition.lower,
                     transition.upper,
                     transition.contact_area,
                     transition.bottleneck[0],
                     transition.bottleneck[1],
                     transition.n_solves,
                     transition.fft_pairs);
    });
  }

  const Transition *
  threshold_of(const std::vector<Transition> &thresholds, const double slip_length)
  {
    for (const Transition &threshold : thresholds)
      if (threshold.slip_length == slip_length)
        return &threshold;
    return nullptr;
  }

  SealSearch::SealSearch(const Scene         &scene_,
                         SealModel           &model_,
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
    std::vector<Transition> result;
    double                  slip_length = 0.;
    const auto              ask_load    = [&](const double load) {
      return ask({load, scene.fluid.inlet_pressure, slip_length}, side_of_path);
    };
    const double                    tolerance = scene.programme.threshold_tolerance;
    std::optional<TransitionSearch> search;
    for (const double next_length : scene.fluid.slip_lengths)
      {
        slip_length = next_length;
        // A contact, once probed, serves all slip lengths, unless it remembers the way.
        if (!search || scene.depends_on_path())
          {
            search.emplace(ask_load, tolerance);
            // Each path comes from nowhere, unless a search goes on that had begun so.
            if (!repeats())
              open_state = sealed_state = std::nullopt;
          }
        result.push_back(critical_load(*search, first, slip_length));
        const Transition &found = result.back();
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

  Transition
  SealSearch::critical_load(TransitionSearch  &search,
                            const SearchStart &first,
                            const double       slip_length)
  {
    const std::size_t begin = next;
    const double      level = -2. * slip_length;
    Passage found = scene.contact.zoom.enabled ? search.enclose_surely(first, level)
                                               : search.enclose(first, level);
    if (scene.depends_on_path())
      {
        const bool from_open = side_of_path == Side::open;
        if (!from_open)
          std::swap(found.before, found.beyond);
        const auto is_kept = [&](const Probe &probe) {
          return (probe.openness > level) == from_open;
        };
        const auto passage =
          search.leave(found.before, found.beyond - found.before, is_kept, found.beyond);
        if (!passage)
          throw ComputationError(
            std::string("The threshold was not found: the contact stays ") +
            (from_open ? "open" : "sealed") + " however far the load goes.");
        found = *passage;
      }
    Transition result =
      between(search, found, std::min(found.before, found.beyond), begin);
    result.slip_length = slip_length;
    return result;
  }

  std::vector<BlowOut>
  SealSearch::find_blow_outs()
  {
    std::vector<BlowOut> result;
    for (const double load : scene.programme.pressures)
      {
        // The pressure rises from nothing, unless a search goes on that had begun so.
        if (!repeats())
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
    Side              side   = Side::sealed;
    // The difference of pressure is what varies.
    TransitionSearch search(
      [&](const double difference) {
        return ask({load, outlet + difference, slip}, side);
      },
      scene.programme.threshold_tolerance);
    const auto leaks = [slip](const Probe &probe) { return probe.openness > -2. * slip; };
    const auto holds = [&](const Probe &probe) { return !leaks(probe); };

    BlowOut result;
    result.load                 = load;
    const double least          = TransitionSearch::negligible * load;
    const Probe  at_least       = search.ask_at(least);
    const bool   leaks_anyway   = leaks(at_least);
    result.opening.contact_area = at_least.contact_area;
    result.opening.bottleneck   = at_least.bottleneck;
    if (!leaks_anyway)
      {
        const auto passage = holds(search.ask_at(load))
                               ? search.leave(load, load, holds)
                               : search.leave(least, load, holds, load);
        if (!passage)
          throw ComputationError("An inlet pressure of " + to_text(outlet + load) +
                                 " and much more is held; no blow-out pressure was "
                                 "found.");
        result.opening = between(search, *passage, passage->beyond, begin);
      }
    if (scene.programme.find_resealing)
      result.closing.emplace();
    if (result.closing && !leaks_anyway)
      {
        side = Side::open;
        // Where there is no hysteresis it closes at once.
        const double leaking = result.opening.upper;
        const double step    = -scene.programme.threshold_tolerance * leaking;
        // What opened there is known roughly only.
        if (!leaks(search.ask_at(leaking)))
          result.closing = result.opening;
        else if (const auto passage = search.leave(leaking, step, leaks))
          result.closing = between(search, *passage, passage->before, begin);
      }
    result.opening.n_solves = static_cast<int>(next - begin);
    const auto add_outlet   = [outlet](Transition &difference) {
      difference.lower += outlet;
      difference.upper += outlet;
    };
    add_outlet(result.opening);
    if (result.closing)
      add_outlet(*result.closing);
    return result;
  }

  /** That of the answers from @p begin on, at whose end @p open the seal leaks. */
  Transition
  SealSearch::between(const TransitionSearch &search,
                      const Passage          &passage,
                      const double            open,
                      const std::size_t       begin) const
  {
    Transition result;
    std::tie(result.lower, result.upper) = std::minmax(passage.before, passage.beyond);
    result.contact_area                  = search.at(result.lower).contact_area;
    result.bottleneck                    = search.at(open).bottleneck;
    result.n_solves                      = static_cast<int>(next - begin);
    for (std::size_t k = begin; k < next; ++k)
      result.fft_pairs += answers[k].fft_pairs;
    return result;
  }

  Probe
  SealSearch::ask(const Control &control, const Side path_comes_from)
  {
    if (!repeats())
      {
        answers.push_back(probe(control, path_comes_from));
        look_up();
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
    // A path leads on from where it was, not back, unless it is the way back from a load
    // that left its indentations, along which none are added.
    const bool is_ahead =
      near &&
      (!scene.depends_on_path() || control.target == near->control.target ||
       (path_comes_from == Side::open) == (near->control.target < control.target) ||
       (path_comes_from == Side::sealed && scene.contact.yields));
    const Aim aim   = scene.depends_on_path() && path_comes_from == Side::sealed
                        ? Aim::seal
                        : Aim::verdict;
    SealState state = model.solve(control, is_ahead ? &*near : nullptr, aim);
    if (!scene.depends_on_path())
      open_state.reset(); // this one takes its place

    // Under pressure a point is closed the more firmly the more its own spacing is
    // indented: a length, like the gap, and of one slope with it.
    const PeriodicGrid &grid = layout->grid();
    const double        softness =
      std::max(grid.dx(), grid.dy()) / scene.contact.effective_modulus;
    const Bottleneck bottleneck = find_bottleneck(signed_gap(state, softness), domain);

    const Probe result = {bottleneck.value,
                          state.contact->contact_area,
                          position_of(state.gap().layout(), bottleneck.point),
                          state.costs.fft_pairs};
    const bool  leaks  = result.openness > -2. * control.slip_length;
    report(state, leaks);
    const bool is_sound = state.contact->converged &&
                          !(state.contact->adhesion && state.contact->adhesion->detached);
    if (is_sound || !scene.depends_on_path())
      place_of(leaks ? Side::open : Side::sealed) = std::move(state);
    return result;
  }

  void
  SealSearch::report(const SealState &state, const bool leaks) const
  {
    const Control &control = state.control;
    log.progress(format("  load %.8g, inlet pressure %.6g: %s",
                        control.target,
                        control.inlet_pressure,
                        leaks ? "leaks" : "seals"));
    if (!state.contact->converged)
      log.warn(format("the contact did not converge at a load of %.6g, residual %.1e",
                      control.target,
                      state.contact->residual));
    if (state.fluid && !state.fluid->converged && !state.fluid->undecided &&
        !state.fluid->lifted_off)
      log.warn(
        format("contact and flow did not agree at a load of %.6g and an inlet "
               "pressure of %.6g",
               control.target,
               control.inlet_pressure));
  }

  void
  SealSearch::transfer(StateArchive &archive)
  {
    transfer_all(archive, answers, [&](Probe &probe) {
      archive.values(probe.openness,
                     probe.contact_area,
                     probe.bottleneck[0],
                     probe.bottleneck[1],
                     probe.fft_pairs);
    });
    if (archive.is_reading())
      next = 0;
    for (std::optional<SealState> *state : {&open_state, &sealed_state})
      if (transfer_presence(archive, *state))
        strait::transfer(archive, **state, layout);
  }
} // namespace strait
