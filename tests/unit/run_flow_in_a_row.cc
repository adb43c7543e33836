// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/load_sweep.h>
#include <strait/seal/flow_stage.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

namespace strait
{
  namespace
  {
    /** The leakage of one box with some gap, and of two such boxes in a row. */
    struct OneAndTwo
    {
      Leakage one, two;
    };

    OneAndTwo
    leak(const std::function<double(double, double)> &gap_at)
    {
      std::ostringstream  said;
      Log                 log(MPI_COMM_WORLD, said, Log::Screen::silent);
      Timers              timers;
      const SlabLayoutPtr layout = make_layout({32, 32, 1., 1.}, MPI_COMM_WORLD);
      const SlabField     gap    = sample(layout, gap_at);
      FluidParameters     fluid;
      fluid.target_accuracy = .01;
      const SlabField two   = two_in_a_row(gap);
      FlowStage       flow(fluid, layout, log, timers);
      FlowStage       row(fluid, two.layout_pointer(), log, timers);
      return {flow.solve(gap, 0.).leakage, row.solve(two, 0.).leakage};
    }

    TEST(FlowInARow, HalfAsMuchWhereTheEndsDoNothing)
    {
      const auto across = leak(
        [](const double, const double y) { return 1. + .5 * std::cos(2 * M_PI * y); });
      EXPECT_GT(across.one.rate, 0.);
      EXPECT_NEAR(across.two.rate / across.one.rate, .5, .01);
      const auto along = leak(
        [](const double x, const double) { return 1. + .5 * std::cos(2 * M_PI * x); });
      EXPECT_NEAR(along.two.rate / along.one.rate, .5, .01);
    }

    TEST(FlowInARow, TheFluidHasToFindTheWayInTheMiddle)
    {
      // In one box, the fluid enters through the lower half and leaves through the upper
      // one, and the gap is wide all the way. In a row, it must squeeze from the upper
      // half to the lower one where the boxes meet.
      const auto ends = leak([](const double x, const double y) {
        const bool wide = y < .5 ? x < .8 : x > .2;
        return wide ? 1. : .2;
      });
      EXPECT_LT(ends.two.upper, .45 * ends.one.lower);
    }

    TEST(FlowInARow, SealsWhereOneBoxDoes)
    {
      const auto sealed =
        leak([](const double x, const double) { return x > .4 && x < .6 ? 0. : 1.; });
      EXPECT_EQ(sealed.one.rate, 0.);
      EXPECT_EQ(sealed.two.rate, 0.);
      // A channel that enters and leaves the box at different places is blocked in a row.
      const auto jumps = leak([](const double x, const double y) {
        const bool first = x < .6 && y > .1 && y < .3;
        const bool last  = (x > .4 || x == 0.) && y > .6 && y < .8;
        const bool link  = x > .4 && x < .6 && y > .1 && y < .8;
        return first || last || link ? 1. : 0.;
      });
      EXPECT_GT(jumps.one.rate, 0.);
      EXPECT_EQ(jumps.two.rate, 0.);
    }
  } // namespace
} // namespace strait
