// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/coupling/pool_damping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace strait
{
  namespace
  {
    class Damped : public ::testing::Test
    {
    protected:
      SlabLayoutPtr layout = make_layout(PeriodicGrid{8, 8, 1., 1.}, MPI_COMM_WORLD);
      PoolDamping   pools;

      void
      note(const NodeState state)
      {
        pools.note(std::vector<NodeState>(layout->n_local_points(), state));
      }

      /** What is left of a step from 0 to 1, at open and at closed points. */
      double
      share() const
      {
        SlabField       step(layout, 1.);
        const SlabField before(layout);
        pools.limit_open(step, before);
        pools.limit_closed(step, before);
        return min_value(step);
      }
    };

    TEST_F(Damped, LeavesWhatChangesSeldom)
    {
      note(NodeState::percolating);
      note(NodeState::pocket);
      note(NodeState::closed);
      EXPECT_EQ(share(), 1.);
      // Between open states and closed ones there is no pool to come and go.
      for (int round = 0; round < 5; ++round)
        note(round % 2 == 0 ? NodeState::inlet_side : NodeState::closed);
      EXPECT_EQ(share(), 1.);
    }

    TEST_F(Damped, HalvesTheStepWithEachChangeAndForgets)
    {
      note(NodeState::closed);
      for (int change = 1; change <= 6; ++change)
        {
          note(change % 2 == 1 ? NodeState::pocket : NodeState::closed);
          EXPECT_EQ(share(), std::pow(.5, std::max(0, change - 2)));
        }
      pools.restart();
      note(NodeState::pocket);
      EXPECT_EQ(share(), 1.);
    }

    TEST_F(Damped, ComesToRestBetweenTwoPressures)
    {
      // Under more than 0.37 the pool is cut off and dry, under less it is not.
      double pressure = 0, last = 1;
      for (int round = 0; round < 80; ++round)
        {
          const bool cut_off = pressure > .37;
          note(cut_off ? NodeState::pocket : NodeState::inlet_side);
          SlabField       next(layout, cut_off ? 0. : 1.);
          const SlabField before(layout, pressure);
          pools.limit_open(next, before);
          last     = pressure;
          pressure = max_value(next);
        }
      EXPECT_NEAR(pressure, .37, 1e-3);
      EXPECT_NEAR(pressure, last, 1e-3);
    }
  } // namespace
} // namespace strait
