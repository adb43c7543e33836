// SPDX-License-Identifier: GPL-2.0-or-later
// How a search asks for one state, and what it takes from the answer.
#include <strait/base/text.h>
#include <strait/percolation/bottleneck.h>
#include <strait/seal/seal_search.h>

#include <algorithm>
#include <utility>

namespace strait
{
  std::optional<SealState> &
  SealSearch::place_of(const Side side)
  {
    return side == Side::open || !model.depends_on_path() ? open_state : sealed_state;
  }

  Probe
  SealSearch::probe(const Control &control, const Side path_comes_from)
  {
    const std::optional<SealState> &near = place_of(path_comes_from);
    // A path leads on from where it was, not back.
    const bool is_ahead =
      near &&
      (!model.depends_on_path() || control.target == near->control.target ||
       (path_comes_from == Side::open) == (near->control.target < control.target));
    SealState state = model.solve(control, is_ahead ? &*near : nullptr, Aim::verdict);

    Probe result;
    result.openness     = openness(state, result.bottleneck);
    result.contact_area = state.contact->contact_area;
    result.fft_pairs    = state.contact->fft_pairs;
    const bool leaks    = result.openness > -2. * control.slip_length;
    report(state, leaks);
    const bool is_sound = state.contact->converged &&
                          !(state.contact->adhesion && state.contact->adhesion->detached);
    if (is_sound || !model.depends_on_path())
      place_of(leaks ? Side::open : Side::sealed) = std::move(state);
    return result;
  }

  double
  SealSearch::openness(const SealState &state, std::array<double, 2> &place) const
  {
    // Under pressure a point is closed the more firmly the more its own spacing is
    // indented: a length, like the gap, and of one slope with it.
    const PeriodicGrid &grid = layout->grid();
    const double        softness =
      std::max(grid.dx(), grid.dy()) / scene.contact.effective_modulus;
    SlabField signed_gap = state.gap();
    for (std::size_t k = 0; k < signed_gap.size(); ++k)
      if (state.contact->pressure[k] > 0)
        signed_gap[k] = -softness * state.contact->pressure[k];
    const Bottleneck bottleneck = find_bottleneck(signed_gap, domain);
    place                       = position_of(signed_gap.layout(), bottleneck.point);
    return bottleneck.value;
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
} // namespace strait
