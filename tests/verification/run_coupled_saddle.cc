// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid presses the walls apart: the saddle whose throat lies in the middle of the
// box, near the load at which it seals.
#include <strait/base/scene.h>
#include <strait/contact/contact_solver.h>
#include <strait/seal/make_seal.h>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "run_fixture.h"

namespace strait
{
  namespace
  {
    /** Whose critical load is to be found. */
    Scene
    sealing_saddle(const int n)
    {
      Scene scene                    = coupled_saddle(n);
      scene.programme.find_threshold = true;
      scene.programme.pressures      = {};
      return scene;
    }

    /** The local exponent of the leak rate where the reduced load falls by @p factor. */
    double
    exponent_between(const Row &larger, const Row &smaller, const double factor)
    {
      return std::log(larger.leak_rate / smaller.leak_rate) / std::log(factor);
    }

    /** A contact under a fluid whose pressure does not change with the gap. */
    class FixedFluid : public SealModel
    {
    public:
      FixedFluid(const ContactParameters &parameters,
                 const SlabField         &heights,
                 SlabField                pressure_)
        : contact(parameters, heights)
        , pressure(std::move(pressure_))
      {
      }

      SealState
      solve(const Control &control, const SealState *from, Aim) override
      {
        SealState state;
        state.control = control;
        state.contact =
          contact.solve(control.target, from ? &*from->contact : nullptr, &pressure);
        return state;
      }

      bool
      are_alike(const Control &a, const Control &b) const override
      {
        return a.target == b.target;
      }

      bool
      depends_on_path() const override
      {
        return false;
      }

      std::size_t
      memory_consumption() const override
      {
        return contact.memory_consumption();
      }

    private:
      ContactSolver   contact;
      const SlabField pressure;
    };

    TEST(CoupledSaddle, ExponentUnderAFixedFluidPressure)
    {
      // A pressure that does not move with the throat is only another surface: the
      // saddle keeps its exponents, about its own critical load. The window is what
      // 256² resolves; corrections to scaling are part of the number.
      Scene scene                         = sealing_saddle(256);
      scene.programme.threshold_tolerance = 1e-6;
      Log               log(MPI_COMM_WORLD, true);
      Timers            timers;
      ContactParameters parameters = scene.contact;
      parameters.tolerance         = 1e-9;
      const SlabField heights      = heights_of(scene);
      FlowStage       flow(scene.fluid, heights.layout_pointer(), log, timers);
      const auto      pressed = make_seal(scene, parameters, heights, &flow, log)
                             ->solve({1.45, .15, 0.}, nullptr, Aim::verdict);
      EXPECT_TRUE(pressed.fluid->converged);

      FixedFluid   seal(parameters, heights, pressed.fluid->pressure);
      SealSearch   search(scene, seal, heights.layout_pointer(), flow.domain(), log);
      const double critical = search.find_critical_loads(1.5).front().middle();
      EXPECT_GT(critical, 1.5); // the fluid carries 5 % of it
      std::vector<double> leak_rates;
      for (const double reduced : {.04, .02})
        {
          const SealState state =
            seal.solve({(1 - reduced) * critical, .15, 0.}, nullptr, Aim::leak_rate);
          leak_rates.push_back(flow.solve(state.gap(), 0.).leakage.rate);
        }
      const double exponent = std::log2(leak_rates[0] / leak_rates[1]);
      EXPECT_GT(exponent, 3.4);
      EXPECT_LT(exponent, 3.6);
    }

    TEST(CoupledSaddle, SaddleSealsAtALargerLoad)
    {
      // Independent values, of a grid of the same fineness: 1.057 and 0.010, 1.2 and
      // 0.04.
      Scene scene                   = sealing_saddle(128);
      scene.programme.reduced_loads = {.3, .01};
      struct Expected
      {
        double inlet_pressure, ratio, shift, tolerance;
      };
      for (const Expected &expected :
           {Expected{.1519, 1.057, .010, .01}, Expected{.512, 1.21, .04, .02}})
        {
          scene.fluid.inlet_pressure = expected.inlet_pressure;
          std::vector<int> rounds;
          SilentSweep      silent(scene);
          const Transition threshold = silent.loads.find_thresholds().front();
          EXPECT_NEAR(threshold.middle() / 1.436526, expected.ratio, expected.tolerance);
          EXPECT_NEAR(threshold.bottleneck[0] - .5, expected.shift, 1. / 128);
          EXPECT_TRUE(silent.loads.run([&rounds](const Step &step) {
            rounds.push_back(step.state.fluid->rounds);
            return true;
          }));
          EXPECT_LE(rounds[0], 8);
          // The stronger pressure takes more.
          EXPECT_LE(rounds[1], expected.inlet_pressure < .2 ? 15 : 40);
        }
    }

    TEST(CoupledSaddle, TwoWaysToALoadMeetWithinTheirBrackets)
    {
      // Near the threshold the gap amplifies what a mesh gets wrong of the fluid's
      // pressure, and each way to a load makes meshes of its own: the bracket must allow
      // for it.
      Scene scene                    = sealing_saddle(128);
      scene.fluid.inlet_pressure     = .53;
      scene.programme.find_threshold = false;
      std::vector<Row> arrivals;
      for (const double start : {1.2, 1.7})
        {
          scene.programme.pressures = {start, 1.746}; // 1 % below the threshold
          arrivals.push_back(sweep(scene).back());
        }
      for (const Row &row : arrivals)
        EXPECT_LE(row.upper - row.lower, scene.fluid.target_accuracy * row.upper);
      EXPECT_LE(arrivals[0].lower, arrivals[1].upper);
      EXPECT_LE(arrivals[1].lower, arrivals[0].upper);
    }

    TEST(CoupledSaddle, TheExponentStaysUnderAWeakPressure)
    {
      // At 3.4 % of the load the throat moves by no more than a grid spacing.
      Scene scene                         = sealing_saddle(256);
      scene.fluid.inlet_pressure          = .05;
      scene.programme.reduced_loads       = {.05, .02, .01};
      scene.programme.threshold_tolerance = 2e-5;
      const std::vector<Row> rows         = run_sweep(scene).rows;
      for (const double exponent : {exponent_between(rows[0], rows[1], 2.5),
                                    exponent_between(rows[1], rows[2], 2.)})
        {
          EXPECT_GT(exponent, 3.4);
          EXPECT_LT(exponent, 3.6);
        }
    }

    TEST(CoupledSaddle, TheExponentGrowsWithTheGrid)
    {
      // The finer the grid, the sharper the pressure step can become, and the further it
      // moves the throat (doc/feedback.md). Under a step that stays it is 69/20.
      std::vector<double> exponents;
      for (const int n : {128, 256})
        {
          Scene scene                   = sealing_saddle(n);
          scene.fluid.inlet_pressure    = .1519;
          scene.programme.reduced_loads = {.05, .02};
          const std::vector<Row> rows   = run_sweep(scene).rows;
          exponents.push_back(exponent_between(rows[0], rows[1], .05 / .02));
        }
      EXPECT_NEAR(exponents[0], 3.67, .04);
      EXPECT_NEAR(exponents[1], 3.79, .04);
    }
  } // namespace
} // namespace strait
