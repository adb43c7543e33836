// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/fluid_on_wall.h>

#include <gtest/gtest.h>

using namespace strait;

TEST(UnsettledRegions, AreThoseThatComeAndGo)
{
  const std::vector<NodeState> wet  = {NodeState::trapped,
                                       NodeState::closed,
                                       NodeState::percolating,
                                       NodeState::inlet_side};
  const std::vector<NodeState> trap = {NodeState::trapped,
                                       NodeState::trapped,
                                       NodeState::trapped,
                                       NodeState::percolating};
  UnsettledRegions             regions;
  for (int round = 0; round < 3; ++round)
    {
      regions.note(trap);
      // To be trapped once does not count: it may happen on the way to a state.
      for (std::size_t k = 0; k < trap.size(); ++k)
        {
          const bool comes_and_goes = k == 1 || k == 2;
          const auto before         = regions.state_before(k);
          EXPECT_EQ(before.has_value(), round > 0 && comes_and_goes) << round << " " << k;
          EXPECT_EQ(before.value_or(wet[k]), wet[k]);
        }
      regions.note(wet);
      for (std::size_t k = 0; k < wet.size(); ++k)
        EXPECT_FALSE(regions.state_before(k)); // not trapped now
    }
}
