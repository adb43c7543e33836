// SPDX-License-Identifier: GPL-2.0-or-later
// Adhesion against known results: the sphere between the limits of Bradley and of
// Johnson, Kendall and Roberts (JKR), and the critical loads of the square saddle.
#include <strait/seal/make_seal.h>
#include <strait/seal/path.h>

#include "run_fixture.h"

namespace
{
  using namespace strait;

  /** R = E* = 1; the contact radius without load would be 0.1 in the JKR limit. */
  constexpr double box = 1., jkr_radius = .1;
  const double     surface_energy = 2. / (9 * pi) * std::pow(jkr_radius, 3);

  struct Sphere
  {
    double pull_off; // in units of π γ0 R: 2 in Bradley's limit, 1.5 in the JKR limit
    double radius;   // without load, in units of that in the JKR limit
  };

  Sphere
  pulled_sphere(const double tabor, const int n, const AdhesionMethod method)
  {
    Scene scene;
    scene.surface.kind                    = SurfaceKind::sphere;
    scene.surface.size                    = {{box, box}};
    scene.surface.amplitude               = 1.;
    scene.contact.grid_points             = {{n, n}};
    scene.contact.tolerance               = 1e-5;
    scene.contact.maximum_iterations      = 5000;
    scene.contact.adhesion.enabled        = true;
    scene.contact.adhesion.method         = method;
    scene.contact.adhesion.surface_energy = surface_energy;
    scene.contact.adhesion.range = std::cbrt(surface_energy * surface_energy) / tabor;
    scene.contact.adhesion.accept_unresolved = true;
    Log        log(MPI_COMM_WORLD, true);
    const auto seal = make_seal(scene, scene.contact, heights_of(scene), nullptr, log);

    const double unit = pi * surface_energy / (box * box);
    const auto   go   = [&](const double load, const SealState *from) {
      return follow(
        seal, {load, 0., 0.}, from, Aim::verdict, {ContactControl::load, 4e-3 * unit});
    };
    const SealState pressed  = *go(unit, nullptr).state;
    const SealState unloaded = *go(0., &pressed).state;
    const Arrival   parted   = go(-2.2 * unit, &unloaded);
    const double    area     = unloaded.contact->contact_area_corrected;
    EXPECT_FALSE(parted.state);
    EXPECT_TRUE(parted.jumps.back().is_pull_off());
    return {-parted.jumps.back().before.pressure / unit,
            std::sqrt(area / pi) * box / jkr_radius};
  }

  TEST(AdhesiveSphere, LiesBetweenBradleyAndJohnsonKendallRoberts)
  {
    const auto   cg   = AdhesionMethod::nonlinear_cg;
    const Sphere soft = pulled_sphere(.3, 128, cg);
    const Sphere mean = pulled_sphere(1., 128, cg);
    const Sphere hard = pulled_sphere(2., 256, cg);
    for (const Sphere &sphere : {soft, mean, hard})
      {
        EXPECT_LT(sphere.pull_off, 2.);
        EXPECT_GT(sphere.pull_off, 1.5);
        EXPECT_LT(sphere.radius, 1.);
        EXPECT_GT(sphere.radius, 0.);
      }
    EXPECT_GT(soft.pull_off, mean.pull_off + .05);
    EXPECT_GT(mean.pull_off, hard.pull_off + .05);
    EXPECT_LT(soft.radius, mean.radius - .05);
    EXPECT_LT(mean.radius, hard.radius - .02);
  }

  /** A square saddle with γ0 = 0.1 E*Δ whose critical load is sought. */
  Scene
  adhesive_saddle(const int n, const double tabor, const LoadPath path)
  {
    Scene scene                           = saddle_scene(n);
    scene.contact.tolerance               = 1e-6;
    scene.contact.adhesion.enabled        = true;
    scene.contact.adhesion.surface_energy = .1;
    scene.contact.adhesion.tabor_number   = tabor;
    scene.programme.pressures             = {};
    scene.programme.path                  = path;
    scene.programme.find_threshold        = true;
    scene.programme.threshold_tolerance   = 1e-3;
    return scene;
  }

  /** The load at which this saddle closes on loading, or opens on unloading. */
  double
  critical_load(const double tabor, const LoadPath path)
  {
    return run_sweep(adhesive_saddle(256, tabor, path)).thresholds.at(0).middle();
  }

  // The states that one search meets lie on its own path and must not serve the next.
  TEST(AdhesiveSaddle, EachSlipLengthHasItsOwnWay)
  {
    Scene scene                         = adhesive_saddle(64, 2., LoadPath::loading);
    scene.programme.threshold_tolerance = 1e-4;
    scene.fluid.slip_lengths            = {-.03, 0.};
    const Transition in_a_list          = run_sweep(scene).thresholds.at(1);
    scene.fluid.slip_lengths            = {0.};
    const Transition alone              = run_sweep(scene).thresholds.at(0);
    EXPECT_EQ(in_a_list.lower, alone.lower);
    EXPECT_EQ(in_a_list.upper, alone.upper);
    EXPECT_EQ(in_a_list.contact_area, alone.contact_area);
  }

  TEST(AdhesiveSaddle, ClosesAndOpensAtTheKnownLoads)
  {
    EXPECT_NEAR(critical_load(.25, LoadPath::loading), 1.26, .01);
    EXPECT_NEAR(critical_load(.25, LoadPath::unloading), 1.26, .01);
    EXPECT_NEAR(critical_load(1., LoadPath::loading), 1.06, .01);
    EXPECT_NEAR(critical_load(2., LoadPath::loading), 1.04, .01);
    EXPECT_NEAR(critical_load(2., LoadPath::unloading), .99, .01);
  }
} // namespace
