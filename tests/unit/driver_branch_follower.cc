// SPDX-License-Identifier: GPL-2.0-or-later
// Paths on a contact whose branches are known.
#include <strait/driver/branch_follower.h>

#include <gtest/gtest.h>

#include <sstream>

namespace
{
  using namespace strait;

  /**
   * A contact that closes at the load 1 and opens again at 0.6: the mean gap is
   * 2 − p on the open branch and less by 0.4 on the closed one, with the energies that
   * belong to it and are equal at the load 0.8; below −0.5 the surfaces part.
   */
  class TwoBranches : public ContactModel
  {
  public:
    ContactState
    solve(const double load) override
    {
      ++n_solves;
      is_closed = is_closed ? load > .6 : load >= 1.;
      ContactState state;
      state.nominal_pressure = load;
      state.mean_gap         = 2 - load - (is_closed ? .4 : 0.);
      state.contact_area     = .2 + .1 * load + (is_closed ? .1 : 0.);
      state.converged        = load > -.5;
      state.fft_pairs        = 10;
      state.adhesion.emplace();
      state.adhesion->detached = load <= -.5;
      state.adhesion->total_energy =
        2 * load - .5 * load * load - (is_closed ? .4 * (load - .8) : 0.);
      return state;
    }

    void
    forget() override
    {
      is_closed = false;
    }

    ContactMemory
    memory() const override
    {
      return {{}, is_closed ? 1. : 0.};
    }

    void
    recall(const ContactMemory &memory) override
    {
      is_closed = memory.target == 1.;
    }

    std::size_t
    memory_consumption() const override
    {
      return 0;
    }

    bool is_closed = false;
    int  n_solves  = 0;
  };

  struct Path
  {
    explicit Path(const double tolerance)
      : log(MPI_COMM_WORLD, screen, Log::Screen::silent)
      , follower(model, ContactControl::load, tolerance, log)
    {
    }

    TwoBranches        model;
    std::ostringstream screen;
    Log                log;
    BranchFollower     follower;
  };

  TEST(BranchFollower, EnclosesJumpsAndSaysWhatTheyDissipate)
  {
    Path   path(1e-3);
    double dissipated = 0;
    for (const double load : {.2, .3, .7, 1.5, 1.3, .9, .3})
      dissipated += path.follower.go_to(load).dissipated;
    const std::vector<Jump> &jumps = path.follower.jumps();
    ASSERT_EQ(jumps.size(), 2u);
    EXPECT_LT(jumps[0].before.target, 1.);
    EXPECT_GE(jumps[0].after.target, 1.);
    EXPECT_LT(jumps[0].after.target - jumps[0].before.target, 1e-3);
    EXPECT_GT(jumps[1].before.target, .6);
    EXPECT_LE(jumps[1].after.target, .6);
    // At either jump the energies differ by 0.4 × 0.2; within the tolerance.
    EXPECT_NEAR(jumps[0].dissipated, .08, 4e-4);
    EXPECT_NEAR(jumps[1].dissipated, .08, 4e-4);
    EXPECT_DOUBLE_EQ(dissipated, jumps[0].dissipated + jumps[1].dissipated);
  }

  TEST(BranchFollower, LeavesSmoothPathsAlone)
  {
    Path path(1e-3);
    long pairs = 0;
    for (const double load : {.1, .2, .4, .8})
      pairs += path.follower.go_to(load).state->fft_pairs;
    EXPECT_EQ(path.model.n_solves, 4);
    EXPECT_EQ(pairs, 40);
    EXPECT_TRUE(path.follower.jumps().empty());
  }

  TEST(BranchFollower, TakesStepsAsTheyAreWithoutATolerance)
  {
    Path path(0);
    for (const double load : {.2, 1.5, .3})
      path.follower.go_to(load);
    EXPECT_EQ(path.model.n_solves, 3);
    EXPECT_TRUE(path.follower.jumps().empty());
  }

  TEST(BranchFollower, EndsWhereTheSurfacesPart)
  {
    Path path(1e-3);
    path.follower.go_to(.2);
    const BranchFollower::Arrival arrival = path.follower.go_to(-2.);
    EXPECT_FALSE(arrival.state);
    ASSERT_EQ(path.follower.jumps().size(), 1u);
    EXPECT_TRUE(path.follower.jumps()[0].is_pull_off);
    EXPECT_NEAR(path.follower.jumps()[0].before.target, -.5, 1e-3);
    EXPECT_TRUE(path.follower.go_to(-.4).state);
  }
} // namespace
