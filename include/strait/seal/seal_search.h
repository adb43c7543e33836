// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_seal_search_h
#define strait_seal_seal_search_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/percolation/flow_region.h>
#include <strait/seal/seal_model.h>
#include <strait/seal/transition_search.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace strait
{
  /** A load or an inlet pressure at which a seal begins or ceases to leak, enclosed. */
  struct Transition
  {
    double slip_length = 0.;
    // With hysteresis these are on the path that the search follows.
    double                lower        = 0.;
    double                upper        = 0.;
    double                contact_area = 0.;         // at lower
    std::array<double, 2> bottleneck   = {{0., 0.}}; // place in the open state [length]
    int                   n_solves     = 0;          // states that were asked for
    long                  fft_pairs    = 0;          // of those

    double
    middle() const
    {
      return .5 * (lower + upper);
    }

    double
    relative_width() const
    {
      return (upper - lower) / upper;
    }
  };

  /** The critical load of a slip length; null if there is none. */
  const Transition *threshold_of(const std::vector<Transition> &thresholds,
                                 double                         slip_length);

  /** All of them, in either direction. Collective. */
  void transfer(StateArchive &archive, std::vector<Transition> &transitions);

  /** The inlet pressures at which a seal under a load opens and closes again. */
  struct BlowOut
  {
    double                    load = 0.;
    Transition                opening; // 0 where it leaks without any pressure
    std::optional<Transition> closing; // if it was sought; 0 where it never closes
  };

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
    /** Called after every new answer, when the state may be saved; may throw to stop. */
    using AfterProbe = std::function<void()>;

    /** @p scene, @p model and @p log must outlive this object; @p layout is the grid's,
     *  and @p domain where the fluid flows. */
    SealSearch(const Scene         &scene,
               SealModel           &model,
               const SlabLayoutPtr &layout,
               FlowDomain           domain,
               Log                 &log);

    /** From now on. */
    void
    after_probe(AfterProbe action)
    {
      look_up = std::move(action);
    }

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

    Transition
    critical_load(TransitionSearch &search, const SearchStart &first, double slip_length);
    BlowOut                   blow_out(double load);
    Transition                between(const TransitionSearch &search,
                                      const Passage          &passage,
                                      double                  open,
                                      std::size_t             begin) const;
    Probe                     ask(const Control &control, Side path_comes_from);
    Probe                     probe(const Control &control, Side path_comes_from);
    std::optional<SealState> &place_of(Side side);
    void                      report(const SealState &state, bool leaks) const;

    const Scene        &scene;
    SealModel          &model;
    const SlabLayoutPtr layout;
    const FlowDomain    domain;
    Log                &log;
    const Side          side_of_path; // in load
    AfterProbe          look_up = []() {};

    // The nearest states on either side; where no path matters, one, the last.
    std::optional<SealState> open_state, sealed_state;
    std::vector<Probe>       answers; // in their order
    std::size_t              next = 0;
  };
} // namespace strait

#endif
