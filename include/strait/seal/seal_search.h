// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/percolation/flow_region.h>
#include <strait/seal/seal_state.h>
#include <strait/seal/transition_search.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * Finds where a seal begins or ceases to leak: the critical loads, and the inlet
   * pressures that blow it out. All of them are transitions along a path of states, and
   * each state is reached from the nearest one on the side that the path comes from. A
   * search can be stopped after any state and go on later: it begins anew and is given
   * the answers that it had, and as it asks the same again, it comes to where it was at
   * once.
   */
  class SealSearch
  {
  public:
    /** @p scene, @p model and @p log must outlive this object; @p layout is the grid's,
     *  and @p domain where the fluid flows. */
    SealSearch(const Scene         &scene,
               const SealModel     &model,
               const SlabLayoutPtr &layout,
               FlowDomain           domain,
               Log                 &log);

    /** Called after every new answer, when the state may be saved; may throw to stop. */
    std::function<void()> after_probe = []() {};

    /** The critical load of every slip length: the largest at which a channel percolates,
     *  sought from @p first on. Collective. Throws ComputationError if there is none. */
    std::vector<Transition> find_critical_loads(const SearchStart &first);

    /** The blow-out pressure of every load of the programme, and the re-sealing pressure
     *  if the scene asks for it. Collective. */
    std::vector<BlowOut> find_blow_outs();

    /** Where a path in load begins that is to meet the critical load: the nearest state
     *  on the side that the scene's path comes from, which is given away. */
    std::optional<SealState>
    take_state()
    {
      return std::exchange(place_of(side_of_path), std::nullopt);
    }

    /** The answers so far and the states that the next ones start from. Collective. */
    void transfer(StateArchive &archive);

    /** Whether answers are left that an earlier search had got. */
    bool
    repeats() const
    {
      return next < answers.size();
    }

    /** How many states were asked for. */
    std::size_t
    n_probes() const
    {
      return answers.size();
    }

  private:
    /** Which side of a transition states are reached from. */
    enum class Side
    {
      open,
      sealed
    };

    Passage                   enclose(TransitionSearch  &search,
                                      const SearchStart &first,
                                      double             level,
                                      Side               side) const;
    BlowOut                   blow_out(double load);
    Transition                between(const TransitionSearch &search,
                                      const Passage          &passage,
                                      std::size_t             begin) const;
    Probe                     ask(const Control &control, Side path_comes_from);
    Probe                     probe(const Control &control, Side path_comes_from);
    std::optional<SealState> &place_of(Side side);
    bool                      report(const SealState &state, bool leaks) const;

    const Scene        &scene;
    const SealModel    &model;
    const SlabLayoutPtr layout;
    const FlowDomain    domain;
    Log                &log;
    const Side          side_of_path; // in load

    // The nearest states on either side; where no path matters, one, the last.
    std::optional<SealState> open_state, sealed_state;
    std::vector<Probe>       answers; // in their order
    std::size_t              next = 0;
  };
} // namespace strait
