// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/grid_transfer.h>
#include <strait/seal/flow_stage.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

namespace strait
{
  namespace
  {
    struct Interpolated
    {
      double leak_rate, change;
    };

    /** Return the leak rate through a gap on 32² points, and its relative change with the
     *  other interpolation according to change_by_interpolation(). */
    Interpolated
    leak(const GapInterpolation                       interpolation,
         const std::function<double(double, double)> &gap_at)
    {
      std::ostringstream  said;
      Log                 log(MPI_COMM_WORLD, said, Log::Screen::silent);
      Timers              timers;
      const SlabLayoutPtr layout = make_layout({32, 32, 1., 1.}, MPI_COMM_WORLD);
      const SlabField     gap    = sample(layout, gap_at);
      FluidParameters     fluid;
      fluid.target_accuracy = .01;
      fluid.interpolation   = interpolation;
      FlowStage      flow(fluid, layout, log, timers);
      const StepFlow solved = flow.solve(gap, 0.);
      return {solved.leakage.rate, flow.change_by_interpolation(solved)};
    }

    TEST(Leakage, MayBeOffByAsMuchAsItsFurtherBoundIs)
    {
      Leakage leakage;
      EXPECT_EQ(leakage.relative_error(), 0.); // sealed
      leakage.lower = 1.;
      leakage.upper = 1.21;
      leakage.rate  = -1.1; // towards the inlet
      EXPECT_NEAR(leakage.relative_error(), .1, 1e-15);
      leakage.lower = .1;
      leakage.rate = leakage.upper = 1.;
      EXPECT_NEAR(leakage.relative_error(), .9, 1e-15);
      leakage.rate  = 1.;
      leakage.upper = 1.4; // a gas: its bounds are for other weights than its rate
      EXPECT_NEAR(leakage.relative_error(), .9, 1e-15);
      leakage.lower = .98;
      EXPECT_NEAR(leakage.relative_error(), .4, 1e-15);
    }

    // For an open throat, and for one that is nearly closed, where the mesh for one gap
    // does not suit the other.
    TEST(FlowStage, ChangeByInterpolationIsThatOfTwoSolutions)
    {
      for (const double narrowest : {.02, 1e-3})
        {
          const auto throat = [narrowest](const double x, const double y) {
            return narrowest +
                   .5 * (1. + std::cos(2 * M_PI * x)) * (1.2 + std::cos(2 * M_PI * y));
          };
          const Interpolated cubic  = leak(GapInterpolation::monotone_cubic, throat);
          const Interpolated linear = leak(GapInterpolation::bilinear, throat);
          const double       ratio  = linear.leak_rate / cubic.leak_rate;
          EXPECT_GT(std::abs(ratio - 1.), .01);
          EXPECT_NEAR((1. + cubic.change) / ratio, 1., .004) << narrowest;
          EXPECT_NEAR((1. + linear.change) * ratio, 1., .004) << narrowest;
        }
    }

    TEST(FlowStage, InterpolationChangesNothingOfPlates)
    {
      const auto plates = [](double, double) { return .3; };
      EXPECT_NEAR(leak(GapInterpolation::monotone_cubic, plates).change, 0., 1e-9);
      EXPECT_NEAR(leak(GapInterpolation::bilinear, plates).change, 0., 1e-9);
    }

    // The mesh of the finer grid serves for a wide throat; where every second point sees
    // another throat, the coarser grid gets its own mesh. If nothing is open there: −1.
    TEST(FlowStage, ChangeToEverySecondPointIsThatOfTwoSolutions)
    {
      std::ostringstream  said;
      Log                 log(MPI_COMM_WORLD, said, Log::Screen::silent);
      Timers              timers;
      FluidParameters     fluid;
      const SlabLayoutPtr layout = make_layout({64, 64, 1., 1.}, MPI_COMM_WORLD);
      // The gap is narrowest on the line x = 1/2 + shift.
      const auto change = [&](const double narrowest, const double shift) {
        const SlabField gap = sample(layout, [&](const double x, const double y) {
          return narrowest + .5 * (1. + std::cos(2 * M_PI * (x - shift))) *
                               (1.2 + std::cos(2 * M_PI * (y - shift)));
        });
        FlowStage       flow(fluid, layout, log, timers);
        const StepFlow  solved = flow.solve(gap, 0.);
        const SlabField coarse = restrict_by_injection(gap);
        FlowStage       other(fluid, coarse.layout_pointer(), log, timers);
        const double    said_of_it = other.change_to(coarse, 0., solved);
        const double    found =
          other.solve(coarse, 0.).leakage.rate / solved.leakage.rate - 1.;
        EXPECT_NEAR(said_of_it, found, .1 * fluid.target_accuracy + .02 * found)
          << narrowest;
        SlabField closed = coarse;
        for (double &value : closed)
          value = -1.;
        EXPECT_EQ(other.change_to(closed, 0., solved), -1.);
        return found;
      };
      fluid.target_accuracy = .02;
      EXPECT_LT(std::abs(change(.3, 0.)), .5 * fluid.target_accuracy);
      fluid.target_accuracy = .005;
      EXPECT_GT(change(2e-3, 1. / 64.), .1);
    }
  } // namespace
} // namespace strait
