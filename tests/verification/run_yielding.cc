// SPDX-License-Identifier: GPL-2.0-or-later
// Loads, searches and theory of a contact that flows at the hardness.
#include <gtest/gtest.h>

#include "run_fixture.h"

namespace strait
{
  namespace
  {
    Scene
    yielding_scene(const double hardness)
    {
      Scene scene;
      scene.surface.short_cut_off_wavelength = 1. / 32;
      scene.contact.grid_points              = {{256, 256}};
      scene.contact.hardness                 = hardness;
      scene.contact.yielding                 = Yielding::cut_off;
      scene.fluid.target_accuracy            = .05;
      return scene;
    }

    TEST(YieldingSeal, TrialsOfASearchLeaveNoIndentation)
    {
      Scene scene                     = yielding_scene(.3);
      scene.programme.pressures       = {.03, .06};
      const std::vector<Row> alone    = sweep(scene);
      scene.programme.find_threshold  = true;
      scene.programme.reduced_loads   = {.05};
      const Sweep      after_a_search = run_sweep(scene);
      const Transition found          = after_a_search.thresholds.front();
      ASSERT_EQ(after_a_search.rows.size(), 3U);
      for (int k = 0; k < 2; ++k)
        {
          EXPECT_EQ(after_a_search.rows[k].contact_area, alone[k].contact_area);
          EXPECT_NEAR(after_a_search.rows[k].mean_gap / alone[k].mean_gap, 1., 1e-6);
        }
      // A path that comes from below in other steps opens and closes at the same loads.
      scene.programme.find_threshold = false;
      scene.programme.reduced_loads  = {};
      scene.programme.pressures      = {.5 * found.lower,
                                        found.lower * (1 - 1e-3),
                                        found.upper * (1 + 1e-3)};
      const std::vector<Row> around  = sweep(scene);
      EXPECT_GT(around[1].leak_rate, 0.);
      EXPECT_EQ(around[2].leak_rate, 0.);
    }

    TEST(YieldingSeal, StaysTightWhenUnloaded)
    {
      Scene scene                 = yielding_scene(.3);
      scene.programme.pressures   = {.05, .1, .15};
      scene.programme.path        = LoadPath::cycle;
      const std::vector<Row> rows = sweep(scene);
      ASSERT_EQ(rows.size(), 5U);
      EXPECT_EQ(rows[2].leak_rate, 0.);
      EXPECT_LT(rows[3].leak_rate, .5 * rows[1].leak_rate);
      EXPECT_LT(rows[4].leak_rate, .5 * rows[0].leak_rate);
    }

    // The theory takes the surface for its spectrum and contact patches for points: of
    // the elastic contact as well it finds less area.
    TEST(YieldingSeal, AreasNearThoseOfPerssonsTheory)
    {
      for (const double hardness : {1., .5})
        {
          Scene scene               = yielding_scene(hardness);
          scene.programme.pressures = {.05, .1, .2};
          scene.theory.enabled      = true;
          scene.fluid.enabled       = false;
          SilentSweep silent(scene);
          silent.loads.run([&](const Step &step) {
            const YieldingAreas &theory    = *step.theory->yielding;
            const ContactState  &contact   = *step.state.contact;
            const double         simulated = contact.contact_area_corrected;
            RecordProperty("area_" + std::to_string(step.number) + "_" +
                             std::to_string(hardness),
                           std::to_string(simulated) + " plastic " +
                             std::to_string(contact.plasticity->area) + " theory " +
                             std::to_string(theory.elastic + theory.plastic) +
                             " plastic " + std::to_string(theory.plastic));
            EXPECT_NEAR(simulated / (theory.elastic + theory.plastic), 1.15, .12);
            EXPECT_LT(contact.plasticity->area, theory.plastic);
            EXPECT_GT(contact.plasticity->area, .4 * theory.plastic);
            return true;
          });
        }
    }
  } // namespace
} // namespace strait
