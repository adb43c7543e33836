// SPDX-License-Identifier: GPL-2.0-or-later
// Laws of adhesion: closed forms, and the law that a scene means.
#include <strait/base/exceptions.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/contact/adhesive_contact_solver.h>

#include <gtest/gtest.h>

#include "adhesion_tools.h"

namespace
{
  using namespace contact_tests;

  TEST(Adhesion, TheTaborNumberSetsTheRange)
  {
    ContactParameters parameters       = adhesive_parameters(1e-8);
    parameters.adhesion.surface_energy = .1;
    parameters.adhesion.tabor_number   = .5;
    const SlabField     heights        = saddle_heights(64);
    const AdhesionScale scale(parameters, heights);
    const AdhesionLaw   law = adhesion_of_scene(parameters, heights);
    EXPECT_NEAR(law.range, saddle_law(.5).range, 1e-5 * law.range);
    EXPECT_NEAR(scale.tabor_number(law), .5, 1e-12);
    EXPECT_NEAR(scale.resolution(law), 64 * law.range * law.range / .1, 1e-9);

    parameters.adhesion.shape  = AdhesionShape::van_der_waals;
    const AdhesionLaw   longer = adhesion_of_scene(parameters, heights);
    const AdhesionScale of_longer(parameters, heights);
    EXPECT_EQ(longer.range, law.range);
    EXPECT_NEAR(of_longer.resolution(longer), scale.resolution(law) / 6, 1e-9);
  }

  TEST(Adhesion, RefusesARangeThatTheGridDoesNotResolve)
  {
    ContactParameters parameters       = adhesive_parameters(1e-8);
    parameters.adhesion.surface_energy = .1;
    parameters.adhesion.tabor_number   = 3;
    const SlabField heights            = saddle_heights(64);
    EXPECT_THROW(adhesion_of_scene(parameters, heights), InputError);
    parameters.adhesion.accept_unresolved = true;
    EXPECT_GT(adhesion_of_scene(parameters, heights).range, 0);
  }

  TEST(Adhesion, MatchesTheContactArea)
  {
    ContactParameters parameters         = adhesive_parameters(1e-7);
    parameters.adhesion.matched_pressure = .02;
    parameters.adhesion.tabor_number     = .5;
    const SlabField       heights        = rough_heights({128, 128, 1., 1.}, 8);
    const AdhesionLaw     law            = adhesion_of_scene(parameters, heights);
    AdhesiveContactSolver solver(parameters,
                                 law,
                                 AdhesiveStart::without_adhesion,
                                 heights);
    const double without = ContactSolver(parameters, heights).solve(.02).contact_area;
    EXPECT_NEAR(solver.solve(.02).contact_area / without, 2, .005);
    EXPECT_NEAR(AdhesionScale(parameters, heights).tabor_number(law), .5, 1e-12);

    parameters.adhesion.matched_pressure = 2.; // all but in full contact already
    EXPECT_THROW(adhesion_of_scene(parameters, heights), InputError);
  }

  TEST(AdhesionLaw, FollowsItsClosedForm)
  {
    const double energy = .7, range = .3;
    for (const ClosedForm &form : closed_forms)
      {
        const AdhesionLaw         law{energy, range, form.shape};
        const std::vector<double> gaps = {0., 1e-9, .1, .3, 2., 11.};
        std::vector<double>       tractions(gaps.size()), curvatures(gaps.size());
        double                    total = 0;
        for (const double gap : gaps)
          total -= energy * form.value(gap / range);
        EXPECT_NEAR(
          law.evaluate(gaps.size(), gaps.data(), tractions.data(), curvatures.data()),
          total,
          1e-14);
        for (std::size_t i = 0; i < gaps.size(); ++i)
          {
            const double s = gaps[i] / range;
            EXPECT_NEAR(tractions[i], -energy / range * form.slope(s), 1e-14);
            EXPECT_NEAR(curvatures[i],
                        -energy / (range * range) * form.curvature(s),
                        1e-13);
            EXPECT_EQ(law.at(gaps[i]).traction, tractions[i]);
          }
      }
    EXPECT_EQ((AdhesionLaw{0., 1.}.at(0.).energy), 0.);
  }

  TEST(AdhesionLaw, TractionAndCurvatureAreDerivatives)
  {
    const double step = 1e-5;
    for (const ClosedForm &form : closed_forms)
      for (const double gap : {.01, .2, 1.5})
        {
          const AdhesionLaw         law{.7, .3, form.shape};
          const AdhesionLaw::Values before = law.at(gap - step),
                                    after  = law.at(gap + step);
          EXPECT_NEAR((after.energy - before.energy) / (2 * step),
                      law.at(gap).traction,
                      1e-7);
          EXPECT_NEAR((after.traction - before.traction) / (2 * step),
                      law.at(gap).curvature,
                      1e-6);
        }
  }
} // namespace
