// SPDX-License-Identifier: GPL-2.0-or-later
// A state is a value: models remember nothing of the states that they computed before.
#include <strait/seal/make_seal.h>
#include <strait/seal/path.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "run_fixture.h"

namespace strait
{
  namespace
  {
    void
    expect_same_bits(const SlabField &a, const SlabField &b)
    {
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }

    /** Solve for one state twice, with others in between. */
    void
    expect_no_memory(const Scene &scene)
    {
      Log                     log(MPI_COMM_WORLD, true);
      Timers                  timers;
      const SlabField         heights = heights_of(scene);
      const ContactParameters contact = complete_contact(scene, heights, 0., log);
      FlowStage               flow(scene.fluid, heights.layout_pointer(), log, timers);
      const auto              seal  = make_seal(scene, contact, heights, &flow, log);
      const auto              solve = [&](const double load, const SealState *from) {
        return seal({load, scene.fluid.inlet_pressure, 0.}, from, Aim::leak_rate);
      };
      const SealState start = solve(1., nullptr);
      const SealState once  = solve(1.04, &start);
      const SealState far   = solve(.3, &once);
      const SealState back  = solve(1.05, &far);
      const SealState again = solve(1.04, &start);
      expect_same_bits(once.gap(), again.gap());
      expect_same_bits(once.contact->pressure, again.contact->pressure);
      EXPECT_EQ(once.costs.fft_pairs, again.costs.fft_pairs);
      EXPECT_EQ(once.fluid.has_value(), again.fluid.has_value());
      if (once.fluid)
        expect_same_bits(once.fluid->pressure, again.fluid->pressure);
    }

    TEST(Values, DrySealsRememberNothing)
    {
      expect_no_memory(saddle_scene(64));
    }

    TEST(Values, AdhesiveSealsRememberNothing)
    {
      Scene scene                           = saddle_scene(64);
      scene.contact.adhesion.enabled        = true;
      scene.contact.adhesion.surface_energy = .1;
      scene.contact.adhesion.tabor_number   = 1.;
      expect_no_memory(scene);
      scene.fluid.feedback.enabled = true;
      scene.fluid.inlet_pressure   = .1;
      scene.fluid.target_accuracy  = .02;
      expect_no_memory(scene);
    }

    TEST(Values, CoupledSealsRememberNothing)
    {
      Scene scene                  = saddle_scene(64);
      scene.fluid.feedback.enabled = true;
      scene.fluid.inlet_pressure   = .15;
      scene.fluid.target_accuracy  = .02;
      expect_no_memory(scene);
    }
  } // namespace
} // namespace strait
