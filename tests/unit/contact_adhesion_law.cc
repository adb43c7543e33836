// SPDX-License-Identifier: GPL-2.0-or-later
// Laws of adhesion, and contacts under them with a solution in closed form.
#include <strait/contact/adhesive_contact_solver.h>

#include <gtest/gtest.h>

#include "adhesion_tools.h"

namespace
{
  using namespace contact_tests;

  /** The shape f(g/z0) of a law and its derivatives, worked out by hand. */
  struct ClosedForm
  {
    AdhesionShape shape;
    double (*value)(double);
    double (*slope)(double);
    double (*curvature)(double);
  };

  const ClosedForm closed_forms[] = {
    {AdhesionShape::exponential,
     [](const double s) { return std::exp(-s); },
     [](const double s) { return -std::exp(-s); },
     [](const double s) { return std::exp(-s); }},
    {AdhesionShape::van_der_waals,
     [](const double s) { return std::pow(1 + s, -2); },
     [](const double s) { return -2 * std::pow(1 + s, -3); },
     [](const double s) { return 6 * std::pow(1 + s, -4); }}};

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

  /** A ripple h1 cos qx of the heights changes a uniform gap ḡ by the amplitude
   *  −h1/(1 − 2k/(qE*)), with k = −γ''(ḡ). */
  TEST(Adhesion, AUniformGapRespondsLinearly)
  {
    // With a ripple of 1e-6 the tolerance, relative to the stress of the ripple, would be
    // within the rounding of ḡ.
    const double ripple = 1e-5, mean_gap = .15, energy = .02, range = .1;
    for (const ClosedForm &form : closed_forms)
      for (const AdhesionMethod method : all_methods)
        for (const int wave : {1, 3})
          {
            const SlabField heights =
              sampled({32, 32, 1., 1.}, [=](const double x, const double) {
                return ripple * std::cos(2 * pi * wave * x);
              });
            AdhesiveContactSolver solver(adhesive_parameters(1e-9,
                                                             method,
                                                             ContactControl::mean_gap),
                                         {energy, range, form.shape},
                                         LoadPath::loading,
                                         heights);
            const ContactState    state = solver.solve(mean_gap);
            EXPECT_TRUE(state.converged);
            const double k = energy / (range * range) * form.curvature(mean_gap / range);
            const double expected  = -ripple / (1 - 2 * k / (2 * pi * wave));
            double       projected = 0;
            for (std::size_t i = 0; i < heights.size(); ++i)
              projected += 2 * state.gap[i] * heights[i] / ripple / (32 * 32);
            EXPECT_NEAR(sum(MPI_COMM_WORLD, projected),
                        expected,
                        1e-4 * std::abs(expected));
            const double pull = -energy / range * form.slope(mean_gap / range);
            EXPECT_NEAR(state.nominal_pressure, -pull, 1e-6 * pull);
          }
  }

  /** A uniform gap is stable up to 2k = qE* for the longest wave, with k as above. */
  TEST(Adhesion, AUniformGapBecomesUnstable)
  {
    const double    range = .1, mean_gap = .2;
    const SlabField flat(make_layout({32, 32, 1., 1.}, MPI_COMM_WORLD));
    for (const ClosedForm &form : closed_forms)
      for (const double factor : {1 - 1e-4, 1 + 1e-4})
        {
          const double critical = pi * range * range / form.curvature(mean_gap / range);
          AdhesiveContactSolver solver(adhesive_parameters(1e-10,
                                                           AdhesionMethod::nonlinear_cg,
                                                           ContactControl::mean_gap),
                                       {factor * critical, range, form.shape},
                                       LoadPath::loading,
                                       flat);
          const ContactState    state  = solver.solve(mean_gap);
          const double          spread = max_value(state.gap) - min_value(state.gap);
          EXPECT_TRUE(state.converged);
          if (factor < 1)
            {
              EXPECT_LT(spread, 1e-6);
              EXPECT_NEAR(state.adhesion->smallest_curvature, 1e-4, 1e-5);
            }
          else
            {
              EXPECT_GT(spread, .1); // it went to another state, a minimum
              EXPECT_GT(state.adhesion->smallest_curvature, 0);
            }
        }
  }

  /** The pull on a rigid sphere of R = 1 at the distance d is 2πRγ0 f(d/z0) (Derjaguin),
   *  Bradley's pull-off force for d → 0. The box cuts off less than 2πRγ0 f with the gap
   *  at its edge. Deformations are 1e-5 here, small against each d. */
  TEST(Adhesion, ARigidSpherePullsAsBradleySaid)
  {
    const double    energy = 1., range = .005, edge = .5 * .25;
    const SlabField sphere =
      sampled({64, 64, 1., 1.}, [](const double x, const double y) {
        return -.5 * (std::pow(x - .5, 2) + std::pow(y - .5, 2));
      });
    ContactParameters parameters =
      adhesive_parameters(1e-9, AdhesionMethod::nonlinear_cg, ContactControl::mean_gap);
    parameters.effective_modulus = 1e7; // a Tabor number of 0.01
    for (const ClosedForm &form : closed_forms)
      for (const double distance : {1e-4, .002, .01})
        {
          AdhesiveContactSolver solver(parameters,
                                       {energy, range, form.shape},
                                       LoadPath::loading,
                                       sphere);
          const ContactState    state = solver.solve(distance - mean(sphere));
          EXPECT_TRUE(state.converged);
          const double whole  = 2 * pi * energy * form.value(distance / range);
          const double beyond = 2 * pi * energy * form.value(edge / range);
          EXPECT_LT(-state.nominal_pressure, 1.001 * whole);
          EXPECT_GT(-state.nominal_pressure, .998 * whole - beyond);
        }
  }
} // namespace
