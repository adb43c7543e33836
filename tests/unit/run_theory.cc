// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/theory_prediction.h>
#include <strait/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cmath>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;

  Scene
  theory_scene()
  {
    Scene scene;
    scene.surface.short_cut_off_wavelength = 1. / 16;
    scene.theory.enabled                   = true;
    return scene;
  }

  /** A critical load that is known exactly. */
  Transition
  threshold_at(const double load, const double slip_length = 0.)
  {
    Transition threshold;
    threshold.lower = threshold.upper = load;
    threshold.slip_length             = slip_length;
    return threshold;
  }

  TEST(TheoryPrediction, FlatPlatesLeakAsTheyShould)
  {
    Scene scene                 = theory_scene();
    scene.surface.size          = {{2., 3.}};
    scene.fluid.viscosity       = .5;
    scene.fluid.inlet_pressure  = 4.;
    scene.theory.simulated_gaps = true;
    scene.output.fields         = FieldOutput::all;
    const SlabField gap(make_layout({8, 12, 2., 3.}, MPI_COMM_WORLD), .1);
    for (const double slip_length : {0., -.01})
      for (const auto direction : {FlowDirection::x, FlowDirection::y})
        {
          scene.fluid.direction = direction;
          const TheoryPrediction theory(scene, nullptr);
          const TheoryResult     result = theory.predict(0., slip_length, &gap, nullptr);
          const double           aspect = direction == FlowDirection::x ? 3. / 2 : 2. / 3;
          EXPECT_NEAR(result.leak_rate /
                        (std::pow(.1 + 2 * slip_length, 3) / (12 * .5) * 4 * aspect),
                      1.,
                      1e-12);
          EXPECT_TRUE(std::isnan(result.contact_area));
          EXPECT_FALSE(result.persson_gaps);
          EXPECT_TRUE(result.simulated_gaps);
        }
  }

  TEST(TheoryPrediction, SealsAtTheCriticalLoad)
  {
    Scene scene            = theory_scene();
    scene.theory.dimension = TheoryDimension::from_threshold;
    const TheoryPrediction theory(scene, nullptr);
    const double           height = std::sqrt(theory.spectrum().height_square());
    constexpr double       load   = .23;
    for (const double slip_length : {0., -.003 * height})
      {
        const Transition threshold = threshold_at(load, slip_length);
        const auto       leak      = [&](const double at) {
          return theory.predict(at, slip_length, nullptr, &threshold).leak_rate;
        };
        EXPECT_GT(leak(.5 * load), 100 * leak(.95 * load));
        EXPECT_GT(leak(.999 * load), 0.);
        EXPECT_EQ(leak(1.001 * load), 0.);
      }
  }

  TEST(TheoryPrediction, SimulatedGapsSealAtTheirOwnContactArea)
  {
    Scene scene                 = theory_scene();
    scene.theory.dimension      = TheoryDimension::from_threshold;
    scene.theory.simulated_gaps = true;
    const TheoryPrediction theory(scene, nullptr);
    SlabField              gap(make_layout({10, 10, 1., 1.}, MPI_COMM_WORLD), 1.);
    for (int row = 0; row < gap.layout().n_rows(); ++row)
      for (int ix = 0; ix < 3; ++ix)
        gap(ix, row) = 0.;
    Transition threshold   = threshold_at(.2);
    threshold.contact_area = .4;
    // A fraction of 0.3 does not conduct, and 0.4 would seal: 1 − 0.3/0.4 = 0.25.
    EXPECT_NEAR(theory.predict(.1, 0., &gap, &threshold).leak_rate, .25 / 12, 1e-13);
    threshold.contact_area = .29;
    EXPECT_EQ(theory.predict(.1, 0., &gap, &threshold).leak_rate, 0.);
  }

  TEST(TheoryPrediction, KnowsItsError)
  {
    const Scene            scene = theory_scene();
    const TheoryPrediction theory(scene, nullptr);
    for (const double load : {.01, .1, .2})
      {
        const TheoryResult result = theory.predict(load, 0., nullptr, nullptr);
        EXPECT_GT(result.error, 0.);
        EXPECT_LT(result.error, 1e-3);
      }
  }

  TEST(TheoryPrediction, OfTheSurfaceAndOfItsModelAgree)
  {
    Scene scene              = theory_scene();
    scene.surface.amplitudes = Amplitudes::fixed;
    const TheoryPrediction model(scene, nullptr);
    scene.theory.spectrum_of_surface = true;
    const SlabField heights =
      make_surface(scene.surface, make_layout({64, 64, 1., 1.}, MPI_COMM_WORLD));
    const TheoryPrediction measured(scene, &heights);
    const TheoryResult     a = model.predict(.05, 0., nullptr, nullptr);
    const TheoryResult     b = measured.predict(.05, 0., nullptr, nullptr);
    EXPECT_NEAR(b.contact_area / a.contact_area, 1., 1e-9);
    EXPECT_NEAR(b.mean_gap / a.mean_gap, 1., .2); // there are few long waves
  }
} // namespace
