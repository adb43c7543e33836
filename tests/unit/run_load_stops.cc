// SPDX-License-Identifier: GPL-2.0-or-later
// The order of the steps of a scene, and which of them belong to its first way.
#include <strait/run/load_sweep.h>

#include <gtest/gtest.h>

namespace
{
  using namespace strait;

  /** For each of @p stops, whether it goes further than those before it. */
  std::vector<bool>
  first_way(const std::vector<LoadStop> &stops)
  {
    std::vector<bool> result;
    for (const LoadStop &stop : stops)
      result.push_back(stop.goes_further);
    return result;
  }

  // A contact that yields remembers the largest load, so only such states are of the
  // branch of the critical load.
  TEST(LoadStops, GoFurtherUntilThePathTurnsBack)
  {
    Scene scene;
    scene.contact.yields      = true;
    scene.programme.pressures = {.1, .3, .2, .25, .3, .4};
    const auto loading        = plan_stops(scene, {});
    EXPECT_EQ(first_way(loading),
              (std::vector<bool>{true, true, false, false, true, true}));
    EXPECT_EQ(loading[2].branch, "unloading");
    EXPECT_EQ(loading[3].branch, "loading");

    scene.programme.path      = LoadPath::unloading;
    scene.programme.pressures = {.3, .1, .2, .05};
    EXPECT_EQ(first_way(plan_stops(scene, {})),
              (std::vector<bool>{true, true, false, true}));

    scene.programme.path      = LoadPath::cycle;
    scene.programme.pressures = {.1, .2};
    EXPECT_EQ(first_way(plan_stops(scene, {})), (std::vector<bool>{true, true, false}));

    // The mean gap falls on loading.
    scene.programme.path      = LoadPath::loading;
    scene.contact.control     = ContactControl::mean_gap;
    scene.programme.pressures = {2., 1., 1.5, .5};
    EXPECT_EQ(first_way(plan_stops(scene, {})),
              (std::vector<bool>{true, true, false, true}));
  }

  TEST(LoadStops, ReducedLoadsBeginAPathOfTheirOwn)
  {
    Scene scene;
    scene.contact.yields          = true;
    scene.programme.pressures     = {.3, .1};
    scene.programme.reduced_loads = {.1, .5};
    Transition threshold;
    threshold.lower = threshold.upper = .2;
    const auto stops                  = plan_stops(scene, {threshold});
    ASSERT_EQ(stops.size(), 4U);
    EXPECT_DOUBLE_EQ(stops[2].target, .1);
    EXPECT_DOUBLE_EQ(stops[3].target, .18);
    EXPECT_EQ(first_way(stops), (std::vector<bool>{true, false, true, true}));
    for (const std::size_t k : {0, 1, 2, 3})
      EXPECT_EQ(stops[k].starts_new_path, k == 0 || k == 2);
  }
} // namespace
