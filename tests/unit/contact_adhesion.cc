// SPDX-License-Identifier: GPL-2.0-or-later
// The adhesive contact: closed forms, the conditions that define a solution, and
// three methods against each other.
#include <strait/base/exceptions.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/contact/adhesive_contact_solver.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  constexpr AdhesionMethod all_methods[] = {AdhesionMethod::nonlinear_cg,
                                            AdhesionMethod::newton_cg,
                                            AdhesionMethod::gfmd};

  ContactParameters
  adhesive_parameters(const double         tolerance,
                      const AdhesionMethod method  = AdhesionMethod::nonlinear_cg,
                      const ContactControl control = ContactControl::load)
  {
    ContactParameters parameters  = contact_parameters(tolerance, control);
    parameters.maximum_iterations = 5000;
    parameters.adhesion.enabled   = true;
    parameters.adhesion.method    = method;
    return parameters;
  }

  /** γ0 = 0.1 E*Δ and the range of a Tabor number, for the square saddle. */
  AdhesionLaw
  saddle_law(const double tabor, const AdhesionShape shape = AdhesionShape::exponential)
  {
    return {.1, std::cbrt(.035823 * .01) / tabor, shape};
  }

  AdhesiveContactSolver
  saddle_solver(const ContactParameters &parameters,
                const double             tabor,
                const int                n     = 64,
                const AdhesionShape      shape = AdhesionShape::exponential)
  {
    return {parameters,
            saddle_law(tabor, shape),
            AdhesiveStart::without_adhesion,
            saddle_heights(n)};
  }

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

  /** The shapes f(g/z0), with their derivatives worked out by hand. */
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

  /** A ripple under a uniform gap ḡ answers with −h1/(1 − 2k/(qE*)), k = −γ''(ḡ). */
  TEST(Adhesion, AUniformGapRespondsLinearly)
  {
    const double ripple = 1e-6, mean_gap = .15, energy = .02, range = .1;
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
                                         AdhesiveStart::without_adhesion,
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

  /** The flat state at a mean gap ends where 2k = qE* for the longest wave. */
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
                                       AdhesiveStart::without_adhesion,
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
              EXPECT_GT(spread, .1); // it fell into another state, which is a minimum
              EXPECT_GT(state.adhesion->smallest_curvature, 0);
            }
        }
  }

  /** All but rigid: the pull on a sphere of R = 1 at the distance d is 2πRγ0 f(d/z0)
   *  (Derjaguin), which for d → 0 is Bradley's pull-off force. Of it the box cuts off
   * less than f on its edge. Deformations are 1e-5 here, small against each d. */
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
                                       AdhesiveStart::without_adhesion,
                                       sphere);
          const ContactState    state = solver.solve(distance - mean(sphere));
          EXPECT_TRUE(state.converged);
          const double whole  = 2 * pi * energy * form.value(distance / range);
          const double beyond = 2 * pi * energy * form.value(edge / range);
          EXPECT_LT(-state.nominal_pressure, 1.001 * whole);
          EXPECT_GT(-state.nominal_pressure, .998 * whole - beyond);
        }
  }

  TEST(Adhesion, TheMethodsAgreeOnEnergyAndGap)
  {
    for (const auto &[tabor, shape] : {std::pair(.25, AdhesionShape::exponential),
                                       std::pair(1., AdhesionShape::exponential),
                                       std::pair(.5, AdhesionShape::van_der_waals)})
      {
        const ContactState reference =
          saddle_solver(adhesive_parameters(1e-9), tabor, 64, shape).solve(.9);
        EXPECT_TRUE(reference.converged);
        for (const AdhesionMethod method :
             {AdhesionMethod::newton_cg, AdhesionMethod::gfmd})
          {
            const ContactState state =
              saddle_solver(adhesive_parameters(1e-9, method), tabor, 64, shape)
                .solve(.9);
            EXPECT_TRUE(state.converged);
            EXPECT_NEAR(state.adhesion->total_energy / reference.adhesion->total_energy,
                        1,
                        1e-10);
            EXPECT_EQ(state.contact_area, reference.contact_area);
            EXPECT_LT(largest_difference(state.gap, reference.gap), 1e-6);
          }
      }
  }

  /** Without adhesion all three solve the hard-wall problem, another way round. */
  TEST(Adhesion, WithoutAttractionTheMethodsFindTheHardWall)
  {
    const SlabField    heights = rough_heights({64, 48, 1., 1.}, 8);
    const ContactState expected =
      ContactSolver(contact_parameters(1e-10), heights).solve(.02);
    for (const AdhesionMethod method : all_methods)
      {
        AdhesiveContactSolver solver(adhesive_parameters(1e-8, method),
                                     {0., 1.},
                                     AdhesiveStart::full_contact,
                                     heights);
        const ContactState    state = solver.solve(.02);
        EXPECT_TRUE(state.converged);
        EXPECT_NEAR(state.contact_area, expected.contact_area, 1e-12);
        EXPECT_LT(largest_difference(state.gap, expected.gap), 1e-6 * rms(heights));
        EXPECT_LT(violation(state, heights, 1.), 1e-6);
      }
  }

  /** Reaction less attraction is the pressure that deforms the half-space. */
  TEST(Adhesion, ForcesBalanceAtEveryPoint)
  {
    const SlabField    heights  = saddle_heights(64);
    const AdhesionLaw  law      = saddle_law(1.);
    const ContactState state    = saddle_solver(adhesive_parameters(1e-9), 1.).solve(.9);
    SlabField          pressure = state.pressure;
    for (std::size_t i = 0; i < pressure.size(); ++i)
      pressure[i] -= law.at(state.gap[i]).traction;
    EXPECT_NEAR(mean(pressure), .9, 1e-8);
    SlabField rigid(heights.layout_pointer());
    HalfSpaceProblem(heights, 1.).apply(pressure.data(), rigid.data(), no_work_pass);
    for (std::size_t i = 0; i < rigid.size(); ++i)
      {
        rigid[i] -= state.gap[i] + heights[i];
        EXPECT_TRUE((state.gap[i] > 0) == (state.pressure[i] == 0));
      }
    EXPECT_LT(max_value(rigid) - min_value(rigid), 1e-6);
  }

  /** Also during the jump from the open to the closed branch. */
  TEST(Adhesion, TheEnergyFallsMonotonically)
  {
    for (const AdhesionMethod method :
         {AdhesionMethod::nonlinear_cg, AdhesionMethod::newton_cg})
      {
        ContactParameters parameters         = adhesive_parameters(1e-8, method);
        parameters.adhesion.write_relaxation = true;
        AdhesiveContactSolver solver         = saddle_solver(parameters, 2., 128);
        const ContactState    open           = solver.solve(1.);
        const ContactState    closed         = solver.solve(1.06, &open);
        EXPECT_GT(closed.contact_area, open.contact_area + .04);
        const auto &steps = closed.adhesion->relaxation;
        ASSERT_GT(steps.size(), 5u);
        for (std::size_t k = 1; k < steps.size(); ++k)
          EXPECT_LE(steps[k].energy, steps[k - 1].energy + 1e-12);
        EXPECT_LT(steps.back().energy, steps.front().energy - 1e-4);
        EXPECT_NEAR(steps.back().energy, closed.adhesion->total_energy, 1e-12);
      }
  }

  TEST(Adhesion, LoadAndGapControlMeet)
  {
    const ContactState by_load = saddle_solver(adhesive_parameters(1e-9), 1.).solve(.9);
    ContactParameters  parameters = adhesive_parameters(1e-9);
    parameters.control            = ContactControl::mean_gap;
    const ContactState by_gap     = saddle_solver(parameters, 1.).solve(by_load.mean_gap);
    EXPECT_TRUE(by_gap.converged);
    EXPECT_NEAR(by_gap.nominal_pressure, .9, 1e-6);
    EXPECT_EQ(by_gap.contact_area, by_load.contact_area);
    EXPECT_NEAR(by_gap.adhesion->total_energy + .9 * by_load.mean_gap,
                by_load.adhesion->total_energy,
                1e-8);
  }

  TEST(Adhesion, TooMuchTensionDetaches)
  {
    AdhesiveContactSolver solver = saddle_solver(adhesive_parameters(1e-8), 1.);
    EXPECT_THROW(solver.solve(-.1), InputError);
    const ContactState pressed = solver.solve(.1);
    EXPECT_TRUE(pressed.converged);
    const ContactState pulled = solver.solve(-.005, &pressed);
    EXPECT_TRUE(pulled.converged);
    EXPECT_FALSE(pulled.adhesion->detached);
    EXPECT_GT(pulled.contact_area, 0);
    for (const AdhesionMethod method : all_methods)
      {
        AdhesiveContactSolver other =
          saddle_solver(adhesive_parameters(1e-8, method), 1.);
        const ContactState parted = other.solve(-.1, &pulled);
        EXPECT_TRUE(parted.adhesion->detached);
        EXPECT_FALSE(parted.converged);
        EXPECT_LT(parted.iterations, 1000);
      }
    EXPECT_NEAR(solver.solve(-.005, &pressed).contact_area, pulled.contact_area, 1e-12);
  }
} // namespace
