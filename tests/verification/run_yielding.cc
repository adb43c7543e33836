// SPDX-License-Identifier: GPL-2.0-or-later
// Loads, searches and theory of a contact that yields at the hardness.
#include <strait/base/exceptions.h>

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
      scene.contact.yields                   = true;
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
      // A path that comes from below in other steps is open and sealed at the same loads.
      scene.programme.find_threshold = false;
      scene.programme.reduced_loads  = {};
      scene.programme.pressures      = {.5 * found.lower,
                                        found.lower * (1 - 1e-3),
                                        found.upper * (1 + 1e-3)};
      const std::vector<Row> around  = sweep(scene);
      EXPECT_GT(around[1].leak_rate, 0.);
      EXPECT_EQ(around[2].leak_rate, 0.);
    }

    // On the way back, the critical load is another one, which is not known.
    TEST(YieldingSeal, TheWayBackHasNoReducedLoad)
    {
      Scene scene                    = yielding_scene(.3);
      scene.contact.grid_points      = {{64, 64}};
      scene.programme.find_threshold = true;
      scene.programme.path           = LoadPath::cycle;
      scene.programme.pressures      = {.03, .06};
      SilentSweep silent(scene);
      silent.loads.find_thresholds();
      int n_on_the_way_back = 0;
      EXPECT_TRUE(silent.loads.run([&](const Step &step) {
        const bool is_back = step.branch == "unloading";
        n_on_the_way_back += is_back ? 1 : 0;
        EXPECT_NE(step.reduced_load.has_value(), is_back);
      }));
      EXPECT_EQ(n_on_the_way_back, 1);
    }

    // On unloading, the seal opens at a lower load than it closed at: the larger the
    // largest load was, the lower.
    TEST(YieldingSeal, OpensWhereTheLargestLoadSays)
    {
      Scene scene                    = yielding_scene(.3);
      scene.programme.find_threshold = true;
      scene.programme.pressures      = {.05};
      const double closes            = run_sweep(scene).thresholds.front().middle();
      scene.programme.path           = LoadPath::unloading;
      EXPECT_THROW(run_sweep(scene), ComputationError);
      double opens = closes;
      for (const double largest : {1.05 * closes, 1.4 * closes})
        {
          scene.programme.pressures     = {largest, .5 * closes};
          scene.programme.reduced_loads = {.05, .1};
          const Sweep      searched     = run_sweep(scene);
          const Transition found        = searched.thresholds.front();
          EXPECT_LT(found.relative_width(), 1e-4);
          EXPECT_LT(found.upper, .95 * opens);
          opens = found.lower;

          // The same loads one after the other on the way back, without a search.
          ASSERT_EQ(searched.rows.size(), 4U);
          Scene without                    = scene;
          without.programme.find_threshold = false;
          without.programme.reduced_loads  = {};
          without.programme.pressures      = {largest,
                                              found.upper * (1 + 1e-3),
                                              found.lower * (1 - 1e-3),
                                              .95 * found.middle(),
                                              .9 * found.middle(),
                                              .5 * closes};
          const std::vector<Row> rows      = sweep(without);
          EXPECT_EQ(rows[1].leak_rate, 0.);
          EXPECT_GT(rows[2].leak_rate, 0.);
          EXPECT_NEAR(searched.rows[2].mean_gap / rows[3].mean_gap, 1., 1e-6);
          EXPECT_NEAR(searched.rows[3].mean_gap / rows[4].mean_gap, 1., 1e-6);
          EXPECT_NEAR(searched.rows[1].mean_gap / rows[5].mean_gap, 1., 1e-6);
        }
    }

    // No contact bears the hardness as its nominal pressure, however small it is.
    TEST(YieldingSeal, SearchStaysBelowTheHardness)
    {
      const double hardness          = .02;
      Scene        scene             = yielding_scene(hardness);
      scene.programme.find_threshold = true;
      scene.programme.pressures      = {.1 * hardness};
      const Transition found         = run_sweep(scene).thresholds.front();
      EXPECT_LT(found.upper, .7 * hardness);
      EXPECT_GT(found.lower, .3 * hardness);
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

    // The theory knows only the spectrum of the surface and takes contact patches for
    // points. In elastic contact, too, its area is smaller than the simulated one.
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
          });
        }
    }
  } // namespace
} // namespace strait
