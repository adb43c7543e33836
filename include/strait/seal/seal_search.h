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
   * Finds where a seal begins or ceases to leak: critical loads, blow-out pressures and
   * re-sealing pressures. All of them are transitions along a path of states, and each
   * state is reached from the nearest one on the side that the path comes from. A search
   * can be stopped after any state and resumed: it begins anew with the stored answers,
   * asks the same questions again, and so returns at once to where it was.
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

    /** Find the critical load of every slip length: the largest at which a channel
     *  percolates, sought from @p first on. Collective. Throws ComputationError if there
     *  is none. */
    std::vector<Transition> find_critical_loads(const SearchStart &first);

    /** Find the blow-out pressure of every load of the programme, and the re-sealing
     *  pressure if the scene asks for it. Collective. */
    std::vector<BlowOut> find_blow_outs();

    /** Give away the state from which a path in load must begin to meet the critical
     *  load: the nearest one on the side that the scene's path comes from. */
    std::optional<SealState>
    take_state()
    {
      return std::exchange(place_of(side_of_path), std::nullopt);
    }

    /** Put the answers so far, and the states that the next ones start from, in an
     *  archive, or take them out. Collective. */
    void transfer(StateArchive &archive);

    /** Whether stored answers of an earlier search are left to repeat. */
    bool
    is_replaying() const
    {
      return next < answers.size();
    }

    /** The number of states that were asked for. */
    std::size_t
    n_probes() const
    {
      return answers.size();
    }

  private:
    /** The side of a transition that states are reached from. */
    enum class Side
    {
      open,
      sealed
    };

    EnclosingPair             enclose(TransitionSearch  &search,
                                      const SearchStart &first,
                                      double             level,
                                      Side               side) const;
    BlowOut                   blow_out(double load);
    Transition                between(const TransitionSearch &search,
                                      const EnclosingPair    &passage,
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
    const Side          side_of_path; // of a path in load

    // The nearest state on either side; where no path matters, only the last one.
    std::optional<SealState> open_state, sealed_state;
    std::vector<Probe>       answers; // in the order of the questions
    std::size_t              next = 0;
  };
} // namespace strait
