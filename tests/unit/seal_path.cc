// SPDX-License-Identifier: GPL-2.0-or-later
// Paths of a contact whose branches are known.
#include <strait/seal/path.h>

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <optional>

#include "window_tools.h"

namespace
{
  using namespace strait;

  /**
   * A contact that closes at the load 1 and opens again at 0.6. At the load p, the mean
   * gap is 2 − p on the open branch and 1.6 − p on the closed one. The energies, whose
   * derivatives these are, agree at p = 0.8. At −0.5 the surfaces part.
   */
  class TwoBranches
  {
  public:
    SealState
    operator()(const Control &control, const SealState *from, Aim)
    {
      ++n_solves;
      const double load = control.target;
      ++n_solves_at[load];
      const bool was_closed = from != nullptr && is_closed(*from);
      const bool closes     = was_closed ? load > .6 : load >= 1.;
      SealState  seal;
      seal.control           = control;
      ContactState &state    = seal.contact.emplace();
      state.nominal_pressure = load;
      state.mean_gap         = 2 - load - (closes ? .4 : 0.);
      state.contact_area     = .2 + .1 * load + (closes ? .1 : 0.);
      state.converged        = load > -.5;
      seal.costs.fft_pairs   = 10;
      state.adhesion.emplace();
      state.adhesion->detached = load <= -.5;
      state.adhesion->total_energy =
        2 * load - .5 * load * load - (closes ? .4 * (load - .8) : 0.);
      return seal;
    }

    static bool
    is_closed(const SealState &state)
    {
      return state.contact->mean_gap < 1.9 - state.control.target;
    }

    int                   n_solves = 0;
    std::map<double, int> n_solves_at; // by the load
  };

  struct Walk
  {
    /** Go on to @p load. */
    Arrival
    to(const double load)
    {
      Arrival arrival = follow(std::ref(model),
                               {load, 0., 0.},
                               here ? &*here : nullptr,
                               Aim::verdict,
                               {ContactControl::load, tolerance});
      if (arrival.state)
        here = arrival.state;
      jumps.insert(jumps.end(), arrival.jumps.begin(), arrival.jumps.end());
      return arrival;
    }

    double                   tolerance;
    TwoBranches              model = {};
    std::optional<SealState> here  = {};
    std::vector<Jump>        jumps = {};
  };

  TEST(Path, EnclosesJumpsAndSaysWhatTheyDissipate)
  {
    Walk path{1e-3};
    for (const double load : {.2, .3, .7, 1.5, 1.3, .9, .3})
      path.to(load);
    const std::vector<Jump> &jumps = path.jumps;
    ASSERT_EQ(jumps.size(), 2u);
    EXPECT_LT(jumps[0].before.target, 1.);
    EXPECT_GE(jumps[0].after.target, 1.);
    EXPECT_LT(jumps[0].after.target - jumps[0].before.target, 1e-3);
    EXPECT_GT(jumps[1].before.target, .6);
    EXPECT_LE(jumps[1].after.target, .6);
    // At either jump the energies differ by 0.4 × 0.2, to 0.4 of the tolerance.
    EXPECT_NEAR(jumps[0].dissipated, .08, 4e-4);
    EXPECT_NEAR(jumps[1].dissipated, .08, 4e-4);
  }

  TEST(Path, SolvesBeyondAJumpOnceToSeeItAndOnceToPassIt)
  {
    Walk path{1e-3};
    path.to(.9);
    path.to(1.2);
    ASSERT_EQ(path.jumps.size(), 1u);
    for (const auto &[load, n] : path.model.n_solves_at)
      EXPECT_LE(n, 2) << "at the load " << load;
    EXPECT_EQ(path.model.n_solves_at[.9], 1);
  }

  TEST(Path, LeavesSmoothPathsAlone)
  {
    Walk path{1e-3};
    long pairs = 0;
    for (const double load : {.1, .2, .4, .8})
      pairs += path.to(load).state->costs.fft_pairs;
    EXPECT_EQ(path.model.n_solves, 4);
    EXPECT_EQ(pairs, 40);
    EXPECT_TRUE(path.jumps.empty());
  }

  TEST(Path, TakesStepsAsTheyAreWithoutATolerance)
  {
    Walk path{0.};
    for (const double load : {.2, 1.5, .3})
      path.to(load);
    EXPECT_EQ(path.model.n_solves, 3);
    EXPECT_TRUE(path.jumps.empty());
  }

  /** Full contact, whose energy differs from solve to solve in its last digits only. */
  class FullContact
  {
  public:
    SealState
    operator()(const Control &control, const SealState *, Aim)
    {
      SealState seal;
      seal.control                          = control;
      ContactState &state                   = seal.contact.emplace();
      state.nominal_pressure                = control.target;
      state.contact_area                    = 1.;
      state.converged                       = true;
      state.adhesion.emplace().total_energy = .25 * (1 - 1e-14 * n_solves);
      ++n_solves;
      return seal;
    }

    int n_solves = 0;
  };

  /** A fluid that holds a channel open up to the load 1, unless a step of more than 0.1
   *  closes it; a closed channel stays closed. */
  SealState
  held_open(const Control &control, const SealState *from, Aim)
  {
    const double step = from == nullptr ? 0. : control.target - from->control.target;
    SealState    seal;
    seal.control                            = control;
    seal.contact.emplace().nominal_pressure = control.target;
    seal.fluid.emplace().percolates =
      control.target <= 1. &&
      (from == nullptr || (from->fluid->percolates && std::abs(step) <= .1));
    return seal;
  }

  TEST(Path, ALongStepThatClosesAChannelIsHalved)
  {
    const auto step_to = [](const double load, const SealState *from) {
      return *follow(held_open, {load, 0., 0.}, from, Aim::leak_rate, {}).state;
    };
    const SealState first = step_to(.2, nullptr);
    const SealState open  = step_to(.9, &first);
    EXPECT_TRUE(open.fluid->percolates);
    EXPECT_EQ(open.control.target, .9);
    const SealState back = step_to(.5, &open);
    EXPECT_TRUE(back.fluid->percolates);
    EXPECT_FALSE(step_to(1.1, &open).fluid->percolates);
    // No step is shorter than a sixteenth of the one that is asked for.
    EXPECT_FALSE(step_to(-2., &open).fluid->percolates);
  }

  TEST(Path, RoundingIsNoJump)
  {
    FullContact              model;
    std::optional<SealState> here;
    for (const double load : {.1, .2, .3, .1})
      {
        const Arrival arrival = follow(std::ref(model),
                                       {load, 0., 0.},
                                       here ? &*here : nullptr,
                                       Aim::verdict,
                                       {ContactControl::load, 1e-3});
        EXPECT_TRUE(arrival.jumps.empty()) << load;
        here = arrival.state;
      }
    EXPECT_EQ(model.n_solves, 4);
  }

  TEST(Path, EndsWhereTheSurfacesPart)
  {
    Walk path{1e-3};
    path.to(.2);
    EXPECT_FALSE(path.to(-2.).state);
    ASSERT_EQ(path.jumps.size(), 1u);
    EXPECT_TRUE(path.jumps[0].is_pull_off());
    EXPECT_NEAR(path.jumps[0].before.target, -.5, 1e-3);
    EXPECT_TRUE(std::isnan(path.jumps[0].dissipated)); // no state follows
    EXPECT_TRUE(path.to(-.4).state);
  }

  TEST(Path, DependsOnTheStateThatItStartsFromAlone)
  {
    // The same step twice from one state, with another path in between.
    Walk path{1e-3};
    path.to(.9);
    const SealState start = *path.here;
    const double    once  = path.to(1.2).state->contact->mean_gap;
    path.to(.2);
    path.here = start;
    EXPECT_EQ(path.to(1.2).state->contact->mean_gap, once);
  }

  TEST(SealState, HoldsUnderWhatItDoesNotDependOn)
  {
    SealState given;
    EXPECT_TRUE(holds_under({2., 1., -1e-3}, given));

    SealState dry;
    dry.contact.emplace();
    dry.control = {1., 0., 0.};
    EXPECT_TRUE(holds_under({1., 2., -1e-3}, dry));
    EXPECT_FALSE(holds_under({2., 0., 0.}, dry));

    // Even without a pressure at the inlet, another slip length makes another state.
    SealState wet = dry;
    wet.fluid.emplace();
    EXPECT_TRUE(holds_under({1., 0., 0.}, wet));
    EXPECT_FALSE(holds_under({1., 0., -1e-3}, wet));
    EXPECT_FALSE(holds_under({1., 2., 0.}, wet));

    // Windows lie around the throats that belong to one slip length.
    for (const auto &windows :
         {std::vector<ZoomWindow>(), {window_tests::window_at(9, 9, 14, 14)}})
      {
        dry.contact->gap = SlabField(window_tests::layout_with(32, windows));
        EXPECT_TRUE(holds_under({1., 2., 0.}, dry));
        EXPECT_EQ(holds_under({1., 2., -1e-3}, dry), windows.empty());
      }
  }
} // namespace
