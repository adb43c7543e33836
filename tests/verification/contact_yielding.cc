// SPDX-License-Identifier: GPL-2.0-or-later
// Contact that yields at the hardness: a sphere, a rough surface, and their indentation.
#include <strait/base/exceptions.h>
#include <strait/surface/self_affine_surface.h>

#include <gtest/gtest.h>

#include "../unit/contact_tools.h"
#include "reference/hertz.h"

namespace
{
  using namespace contact_tests;

  ContactParameters
  yielding(const double hardness, const double tolerance = 1e-8)
  {
    ContactParameters parameters = contact_parameters(tolerance);
    parameters.hardness          = hardness;
    parameters.yields            = true;
    return parameters;
  }

  /** Return by how much @p state violates the contact conditions, over the rms height,
   *  with the gap Gp − h computed anew on the surface as @p from left it: it must be the
   *  same wherever 0 < p < H, no smaller where p = 0, and no larger where p = H. */
  double
  violation(const ContactState &state,
            const SlabField    &heights,
            const ContactState *from,
            const double        hardness)
  {
    SlabField gap(heights.layout_pointer());
    HalfSpaceProblem(heights, 1.).apply(state.pressure.data(), gap.data());
    double least_free = INFINITY, most_free = -INFINITY;
    for (std::size_t i = 0; i < gap.size(); ++i)
      {
        gap[i] -= heights[i];
        if (from != nullptr)
          gap[i] += from->plasticity->indentation[i];
        const double p = state.pressure[i];
        EXPECT_TRUE(p >= 0 && p <= hardness);
        if (p > 0)
          most_free = std::max(most_free, p < hardness ? gap[i] : -INFINITY);
        if (p > 0 && p < hardness)
          least_free = std::min(least_free, gap[i]);
      }
    least_free   = minimum(MPI_COMM_WORLD, least_free);
    most_free    = maximum(MPI_COMM_WORLD, most_free);
    double worst = most_free - least_free;
    for (std::size_t i = 0; i < gap.size(); ++i)
      if (state.pressure[i] == 0)
        worst = std::max(worst, least_free - gap[i]);
      else if (state.pressure[i] == hardness)
        worst = std::max(worst, gap[i] - most_free);
    return maximum(MPI_COMM_WORLD, worst) / rms(heights);
  }

  /** A sphere of radius 1 under a force of 0.01, with E* = 1, in a box whose side is 16
   *  radii of the elastic contact. */
  struct Sphere
  {
    const reference::Hertz hertz = {.01, 1., 1.};
    const double           side  = 16 * hertz.contact_radius();

    ContactState
    solve(const double hardness, const int n = 1024) const
    {
      const SlabField heights =
        sampled({n, n, side, side}, [&](const double x, const double y) {
          return -.5 * (std::pow(x - side / 2, 2) + std::pow(y - side / 2, 2));
        });
      ContactState state =
        ContactSolver(yielding(hardness), heights).solve(hertz.force / (side * side));
      EXPECT_TRUE(state.converged);
      return state;
    }

    double
    area(const double fraction) const
    {
      return fraction * side * side;
    }
  };

  // The areas and depths are from an independent program, accurate to about 1 %.
  TEST(PlasticSphere, AreasAndDepth)
  {
    struct Row
    {
      double hardness, area, plastic, depth;
    };
    const Sphere sphere;
    for (const Row &row : {Row{.1, .1235, .0645, .0032}, Row{.05, .2012, .198, .0227}})
      {
        const ContactState state = sphere.solve(row.hardness);
        EXPECT_NEAR(sphere.area(state.contact_area) / row.area, 1., .01);
        EXPECT_NEAR(sphere.area(state.plasticity->area) / row.plastic, 1., .01);
        EXPECT_NEAR(max_value(state.plasticity->indentation) / row.depth, 1., .02);
        EXPECT_GE(sphere.area(state.contact_area), sphere.hertz.force / row.hardness);
        EXPECT_EQ(max_value(state.pressure), row.hardness);
      }
  }

  // Yield begins at F_y = π³R²H³/(6E*²), where the largest Hertzian pressure is H.
  TEST(PlasticSphere, FirstYield)
  {
    const Sphere sphere;
    const double first = std::cbrt(6 * sphere.hertz.force / std::pow(pi, 3));
    EXPECT_EQ(sphere.solve(1.002 * first, 512).plasticity->area, 0.);
    const ContactState yields = sphere.solve(.99 * first, 512);
    EXPECT_GT(yields.plasticity->area, 0.);
    EXPECT_LT(yields.plasticity->area, .05 * yields.contact_area);
  }

  /** Its rms slope is 1, so that hardnesses are in units of E* times the rms slope. */
  SlabField
  rough_surface(const int n = 256)
  {
    SurfaceParameters parameters;
    parameters.short_cut_off_wavelength = 8. / n;
    return SelfAffineSurface(parameters, MPI_COMM_WORLD)
      .heights(make_layout({n, n, 1., 1.}, MPI_COMM_WORLD));
  }

  TEST(YieldingContact, SolvesTheConditionsAtTheCostOfTheElasticParallel)
  {
    const SlabField heights = rough_surface();
    ContactSolver   elastic(contact_parameters(1e-8), heights);
    for (const double load : {.03, .15})
      {
        const long pairs = elastic.solve(load).fft_pairs;
        for (const double hardness : {2., 1., .5, .2})
          {
            ContactSolver      solver(yielding(hardness), heights);
            const ContactState state = solver.solve(load);
            EXPECT_TRUE(state.converged);
            EXPECT_LT(violation(state, heights, nullptr, hardness), 3e-8);
            EXPECT_NEAR(mean(state.pressure) / load, 1., 1e-12);
            EXPECT_LE(state.fft_pairs, 2 * pairs) << load << ' ' << hardness;
            RecordProperty("pairs_" + std::to_string(load) + "_" +
                             std::to_string(hardness),
                           std::to_string(state.fft_pairs) + " of " +
                             std::to_string(pairs));
          }
      }
  }

  // In a soft solid, as many of the highest points yield as the load needs: the bearing
  // area.
  TEST(YieldingContact, BearingAreaWhereElasticityIsNothing)
  {
    const SlabField heights = rough_surface();
    for (const double part : {.1, .5, .9})
      {
        constexpr double   hardness = 1e-3;
        const ContactState state =
          ContactSolver(yielding(hardness), heights).solve(part * hardness);
        EXPECT_TRUE(state.converged);
        EXPECT_NEAR(state.contact_area, part, 1e-3);
        EXPECT_NEAR(state.plasticity->area, part, 1e-3);
        // The remaining surface is cut off at the level that separates the points in
        // contact from the others.
        double lowest = INFINITY, highest = -INFINITY, top = -INFINITY;
        for (std::size_t i = 0; i < heights.size(); ++i)
          {
            if (state.pressure[i] > 0)
              lowest = std::min(lowest, heights[i]);
            else
              highest = std::max(highest, heights[i]);
            top = std::max(top, heights[i] - state.plasticity->indentation[i]);
          }
        const double h_rms = rms(heights), level = .5 * (lowest + highest);
        EXPECT_NEAR(lowest / h_rms, highest / h_rms, .02);
        EXPECT_NEAR(top / h_rms, level / h_rms, .02);
        for (std::size_t i = 0; i < heights.size(); ++i)
          {
            const double exact = std::max(level - heights[i], 0.);
            ASSERT_NEAR(state.gap[i] / h_rms, exact / h_rms, .02);
          }
      }
  }

  TEST(YieldingContact, ReloadedFlowsNoFurther)
  {
    constexpr double   hardness = .5;
    const SlabField    heights  = rough_surface();
    const double       h_rms    = rms(heights);
    ContactSolver      solver(yielding(hardness), heights);
    const ContactState loaded = solver.solve(.1);
    const ContactState again  = solver.solve(.1, &loaded);
    EXPECT_EQ(again.iterations, 0);
    EXPECT_LT(largest_difference(again.pressure, loaded.pressure), 1e-12);
    EXPECT_LT(largest_difference(again.plasticity->indentation,
                                 loaded.plasticity->indentation),
              1e-12 * h_rms);

    const ContactState unloaded = solver.solve(.05, &again);
    EXPECT_TRUE(unloaded.converged);
    EXPECT_LT(violation(unloaded, heights, &again, hardness), 3e-8);
    EXPECT_EQ(largest_difference(unloaded.plasticity->indentation,
                                 again.plasticity->indentation),
              0.);
    EXPECT_GT(unloaded.contact_area, 1.2 * solver.solve(.05).contact_area);
    const ContactState reloaded = solver.solve(.1, &unloaded);
    EXPECT_LT(largest_difference(reloaded.plasticity->indentation,
                                 loaded.plasticity->indentation),
              1e-6 * h_rms);
    EXPECT_NEAR(reloaded.contact_area / loaded.contact_area, 1., 1e-3);

    const ContactState further = solver.solve(.12, &reloaded);
    EXPECT_LT(violation(further, heights, &reloaded, hardness), 3e-8);
    EXPECT_GT(further.plasticity->mean_indentation,
              1.1 * loaded.plasticity->mean_indentation);
  }

  // While the load rises, no pressure falls below the hardness again, so that one step
  // indents the surface as much as many do.
  TEST(YieldingContact, OneAgainstTenSteps)
  {
    const SlabField    heights = rough_surface();
    ContactSolver      solver(yielding(.5), heights);
    const ContactState one = solver.solve(.1);
    ContactState       ten = solver.solve(.01);
    for (int k = 2; k <= 10; ++k)
      ten = solver.solve(.01 * k, &ten);
    const auto compare = [&](const char *name, const double a, const double b) {
      EXPECT_NEAR(a / b, 1., 1e-5) << name;
    };
    compare("contact_area", ten.contact_area, one.contact_area);
    compare("mean_gap", ten.mean_gap, one.mean_gap);
    compare("mean_indentation",
            ten.plasticity->mean_indentation,
            one.plasticity->mean_indentation);
  }

  TEST(YieldingContact, WithoutSolutionNothingIsIndented)
  {
    const SlabField   heights     = rough_surface(64);
    ContactParameters parameters  = yielding(.3);
    const auto        before      = ContactSolver(parameters, heights).solve(.02);
    parameters.maximum_iterations = 1;
    const auto after              = ContactSolver(parameters, heights).solve(.1, &before);
    EXPECT_FALSE(after.converged);
    EXPECT_EQ(largest_difference(after.plasticity->indentation,
                                 before.plasticity->indentation),
              0.);
    EXPECT_EQ(ContactSolver(parameters, heights).solve(.1).plasticity->mean_indentation,
              0.);
  }

  TEST(YieldingContact, RefusesALoadThatNothingBears)
  {
    ContactSolver solver(yielding(.1), rough_surface(64));
    EXPECT_THROW(solver.solve(.1), InputError);
    EXPECT_TRUE(solver.solve(.0999).converged);
  }
} // namespace
