// SPDX-License-Identifier: GPL-2.0-or-later
// Contact with adhesion: the conditions that define a solution, and the agreement of the
// three methods.
#include <strait/base/exceptions.h>
#include <strait/base/scene.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/surface/make_surface.h>

#include <gtest/gtest.h>

#include "adhesion_tools.h"

namespace
{
  using namespace contact_tests;

  /** The law for the square saddle with γ0 = 0.1 E*Δ and the range that follows from the
   *  Tabor number @p tabor, with the curvature radius λ²/(2√2 π² Δ) = 0.035823. */
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
    return {parameters, saddle_law(tabor, shape), LoadPath::loading, saddle_heights(n)};
  }

  TEST(Adhesion, TheTaborNumberSetsTheRange)
  {
    ContactParameters parameters       = adhesive_parameters(1e-8);
    parameters.adhesion.surface_energy = .1;
    parameters.adhesion.tabor_number   = .5;
    const SlabField     heights        = saddle_heights(64);
    const SceneAdhesion adhesion       = adhesion_of_scene(parameters, heights);
    const double        range          = adhesion.law.range;
    EXPECT_NEAR(range, saddle_law(.5).range, 1e-5 * range);
    EXPECT_NEAR(adhesion.tabor_number, .5, 1e-12);
    EXPECT_NEAR(adhesion.resolution, 64 * range * range / .1, 1e-9);

    parameters.adhesion.shape  = AdhesionShape::van_der_waals;
    const SceneAdhesion longer = adhesion_of_scene(parameters, heights);
    EXPECT_EQ(longer.law.range, range);
    EXPECT_NEAR(longer.resolution, adhesion.resolution / 6, 1e-9);
  }

  // The edge where the periods of a sphere meet, whose curvature grows with the number of
  // grid points, does not count.
  TEST(Adhesion, TheTaborNumberOfASphereIsThatOfItsRadius)
  {
    for (const int n : {32, 64})
      {
        Scene scene = make_scene({lex_override("Surface/Kind=sphere", "."),
                                  lex_override("Surface/Amplitude=2", ".")});
        scene.contact.adhesion.surface_energy = .1;
        scene.contact.adhesion.tabor_number   = .5;
        const SlabField heights =
          make_surface(scene.surface, make_layout({n, n, 1., 1.}, MPI_COMM_WORLD));
        EXPECT_NEAR(adhesion_of_scene(scene.contact, heights).law.range,
                    2. * std::cbrt(2. * .1 * .1),
                    1e-12);
      }
  }

  TEST(Adhesion, RefusesARangeThatTheGridDoesNotResolve)
  {
    ContactParameters parameters       = adhesive_parameters(1e-8);
    parameters.adhesion.surface_energy = .1;
    parameters.adhesion.tabor_number   = 3;
    const SlabField heights            = saddle_heights(64);
    EXPECT_THROW(adhesion_of_scene(parameters, heights), InputError);
    parameters.adhesion.accept_unresolved = true;
    EXPECT_GT(adhesion_of_scene(parameters, heights).law.range, 0);
  }

  TEST(Adhesion, MatchesTheContactArea)
  {
    ContactParameters parameters         = adhesive_parameters(1e-7);
    parameters.adhesion.matched_pressure = .02;
    parameters.adhesion.tabor_number     = .5;
    const SlabField       heights        = rough_heights({128, 128, 1., 1.}, 8);
    const SceneAdhesion   adhesion       = adhesion_of_scene(parameters, heights);
    AdhesiveContactSolver solver(parameters, adhesion.law, LoadPath::loading, heights);
    const double without = ContactSolver(parameters, heights).solve(.02).contact_area;
    EXPECT_NEAR(solver.solve(.02).contact_area / without, 2, .005);
    EXPECT_NEAR(adhesion.tabor_number, .5, 1e-12);

    parameters.adhesion.matched_pressure = 2.; // almost full contact without adhesion
    EXPECT_THROW(adhesion_of_scene(parameters, heights), InputError);
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

  /** Without adhesion the three methods, which seek the gap, find the state of
   *  ContactSolver, which seeks the pressure. */
  TEST(Adhesion, WithoutAttractionTheMethodsFindTheHardWall)
  {
    const SlabField    heights = rough_heights({64, 48, 1., 1.}, 8);
    const ContactState expected =
      ContactSolver(contact_parameters(1e-10), heights).solve(.02);
    for (const AdhesionMethod method : all_methods)
      {
        AdhesiveContactSolver solver(adhesive_parameters(1e-8, method),
                                     {0., 1.},
                                     LoadPath::unloading,
                                     heights);
        const ContactState    state = solver.solve(.02);
        EXPECT_TRUE(state.converged);
        EXPECT_NEAR(state.contact_area, expected.contact_area, 1e-12);
        EXPECT_LT(largest_difference(state.gap, expected.gap), 1e-6 * rms(heights));
        EXPECT_LT(violation(state, heights, 1.), 1e-6);
      }
  }

  /** The reaction of the wall minus the attraction deforms the half-space. */
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
    HalfSpaceProblem(heights, 1.).apply(pressure.data(), rigid.data());
    for (std::size_t i = 0; i < rigid.size(); ++i)
      {
        rigid[i] -= state.gap[i] + heights[i];
        EXPECT_TRUE((state.gap[i] > 0) == (state.pressure[i] == 0));
      }
    EXPECT_LT(max_value(rigid) - min_value(rigid), 1e-6);
  }

  /** It falls in each iteration, also in the jump from the open to the closed branch. */
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
