// SPDX-License-Identifier: GPL-2.0-or-later
// The bracket of the leak rate: the shares of the cells in its width, the unknowns that
// it takes, and rigorous bounds.
#include <strait/contact/contact_solver.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/surface/make_surface.h>

#include <gtest/gtest.h>

#include "flow_fixture.h"

namespace strait
{
  namespace
  {
    double
    channels(const double x, const double y)
    {
      return .2 + .3 * std::cos(2 * pi * x) +
             .3 * std::cos(2 * pi * y) * std::cos(4 * pi * (x + y));
    }

    /** A gap with contact on 64 × 64 points, moved by a @p shift along y, and both
     *  problems solved on a mesh of cells of 4 spacings, refined twice more in x < 0.6
     *  from @p first to @p last along y, likewise moved. */
    struct Solved
    {
      Solved(const FluidParameters &fluid,
             const double           first,
             const double           last,
             const double           shift = 0.)
        : given(sample([shift](const double x,
                               const double y) { return channels(x, y - shift); },
                       64,
                       64),
                fluid)
        , mesh(given.field, fluid.direction)
        , pressure(mesh, given.field.moment_set(), GapField::Coefficient::conductivity)
        , stream(mesh, given.field.moment_set(), GapField::Coefficient::resistivity)
      {
        mesh.triangulation().refine_global(3);
        for (int round = 0; round < 2; ++round)
          {
            for (const auto &cell : mesh.triangulation().active_cell_iterators())
              if (cell->is_locally_owned() && cell->center()[0] < .6)
                {
                  const double y = cell->center()[1] - shift - first;
                  if (y - std::floor(y) < last - first)
                    cell->set_refine_flag();
                }
            mesh.triangulation().execute_coarsening_and_refinement();
          }
        solve();
      }

      void
      solve()
      {
        for (PotentialProblem *problem : {&pressure, &stream})
          {
            problem->take_coefficient(given.field);
            EXPECT_TRUE(problem->solve({FlowPreconditioner::boomeramg, 1e-14}).converged);
          }
      }

      GivenGap         given;
      FlowMesh         mesh;
      PotentialProblem pressure, stream;
    };

    // The tolerance allows for shares in single precision. If the corrected functions did
    // not conform at hanging nodes and across the periodic boundary, their energy could
    // be less than that of the solution on the refined mesh, to which their nodes belong.
    TEST(FlowBracket, SharesSumToTheWidthAndCorrectionConformsParallel)
    {
      const FluidParameters  fluid = plain_fluid();
      Solved                 solved(fluid, .9, 1.3);
      const Bracket          plain = plain_bracket(solved.pressure, solved.stream);
      HierarchicalCorrection correction(solved.mesh);
      const double upper = correction.relax(solved.pressure, solved.given.field);
      const double lower = 1. / correction.relax(solved.stream, solved.given.field);
      const double sum =
        dealii::Utilities::MPI::sum(plain.contributions.l1_norm(), MPI_COMM_WORLD);
      EXPECT_NEAR(sum, 1. - plain.lower / plain.upper, 1e-6);
      // On cells of two spacings or more, the correction has the same coefficient.
      EXPECT_LT(upper, plain.upper);
      EXPECT_GT(lower, plain.lower);
      solved.pressure.prepare_for_refinement();
      solved.stream.prepare_for_refinement();
      solved.mesh.triangulation().refine_global(1);
      solved.solve();
      const Bracket refined = plain_bracket(solved.pressure, solved.stream);
      EXPECT_GT(upper, refined.upper);
      EXPECT_LT(lower, refined.lower);
      EXPECT_GT(refined.upper, refined.lower);
    }

    // Cells of different size meet at the periodic boundary, or only within the box.
    TEST(FlowBracket, CorrectionIsTheSameWhereverTheBoxEndsParallel)
    {
      const FluidParameters fluid  = plain_fluid();
      const auto            bounds = [&fluid](const double first, const double shift) {
        Solved                       solved(fluid, first, first + .25, shift);
        const HierarchicalCorrection correction(solved.mesh);
        return std::make_pair(correction.relax(solved.pressure, solved.given.field),
                              1. / correction.relax(solved.stream, solved.given.field));
      };
      for (const double first : {.0, .75})
        {
          const auto at_the_end = bounds(first, 0.), inside = bounds(first, .5);
          EXPECT_NEAR(at_the_end.first / inside.first, 1., 1e-9);
          EXPECT_NEAR(at_the_end.second / inside.second, 1., 1e-9);
        }
    }

    SlabField
    contact_gap(const SurfaceParameters &surface,
                const PeriodicGrid      &grid,
                const double             pressure)
    {
      ContactParameters contact;
      contact.grid_points  = {{grid.nx, grid.ny}};
      const auto    layout = make_layout(grid, MPI_COMM_WORLD);
      ContactSolver solver(contact, make_surface(surface, layout));
      return solver.solve(pressure).gap;
    }

    // The stream function has coefficients that differ by many orders of magnitude
    // between cells of different ranks. On three ranks a smoother that ignores how their
    // unknowns are coupled fails for the last three of these surfaces.
    TEST(FlowBracket, PreconditionersAreDefiniteOnManyRanksParallel)
    {
      SurfaceParameters surface;
      surface.short_cut_off_wavelength = .15;
      surface.roll_off_wavelength      = .4;
      surface.size                     = {{1., .8}};
      const FluidParameters fluid      = plain_fluid();
      for (const unsigned int seed : {1, 2, 45, 375})
        {
          surface.seed        = seed;
          const SlabField gap = contact_gap(surface, {48, 34, 1., .8}, .1);
          const GivenGap  given(gap, fluid);
          FlowMesh        mesh(given.field, fluid.direction);
          for (const auto kind :
               {GapField::Coefficient::conductivity, GapField::Coefficient::resistivity})
            {
              PotentialProblem problem(mesh, given.field.moment_set(), kind);
              problem.take_coefficient(given.field);
              const LinearSolve solve =
                problem.solve({FlowPreconditioner::boomeramg, 1e-12});
              EXPECT_TRUE(solve.converged) << seed;
              EXPECT_LT(solve.iterations, 20U) << seed;
            }
        }
    }

    TEST(FlowBracket, SaddleNearClosingNeedsFewUnknowns)
    {
      SurfaceParameters surface;
      surface.kind        = SurfaceKind::square_saddle;
      const SlabField gap = contact_gap(surface, {1024, 1024, 1., 1.}, .226 * 2 * pi);

      const Leakage coarse = leak(gap, plain_fluid(1e-2));
      const Leakage fine   = leak(gap, plain_fluid(1e-3));
      EXPECT_EQ(coarse.status, "ok");
      EXPECT_EQ(fine.status, "ok");
      EXPECT_LE(coarse.unknowns, 2500U);
      EXPECT_LE(fine.unknowns, 12000U);
      EXPECT_LE(coarse.lower, fine.upper);
      EXPECT_GE(coarse.upper, fine.lower);
    }

    // At 0.9 of its critical load of 0.2422 E*, with eight points per shortest wave.
    TEST(FlowBracket, RoughGapNearItsThresholdNeedsFewUnknowns)
    {
      SurfaceParameters surface;
      surface.short_cut_off_wavelength = 8. / 1024;
      const SlabField gap              = contact_gap(surface, {1024, 1024, 1., 1.}, .218);
      const Leakage   flow             = leak(gap, plain_fluid(1e-2));
      EXPECT_EQ(flow.status, "ok");
      EXPECT_LE(flow.unknowns, 60000U);
    }

    // With eight roll-off wavelengths in the box, side channels have scores of
    // constrictions, too. Each coarse cell that blocks one of them takes only a small
    // part of the pressure drop.
    TEST(FlowBracket, LongChannelsNeedFewUnknowns)
    {
      SurfaceParameters surface;
      surface.seed                     = 2;
      surface.roll_off_wavelength      = 1. / 8;
      surface.short_cut_off_wavelength = 8. / 512;
      const SlabField gap              = contact_gap(surface, {512, 512, 1., 1.}, .17);
      const Leakage   flow             = leak(gap, plain_fluid(3e-2));
      EXPECT_EQ(flow.status, "ok");
      EXPECT_LE(flow.unknowns, 120000U);
    }

    // Rigorous bounds take extremes of K instead of quadrature, so that their bracket
    // contains the asymptotic one.
    TEST(FlowBracket, RigorousBoundsEncloseTheOthers)
    {
      for (const GapInterpolation kind :
           {GapInterpolation::monotone_cubic, GapInterpolation::bilinear})
        {
          FluidParameters fluid      = plain_fluid(1e-2);
          fluid.interpolation        = kind;
          const SlabField gap        = sample(channels, 128, 128);
          const Leakage   asymptotic = leak(gap, fluid);
          fluid.rigorous_bounds      = true;
          fluid.target_accuracy      = .15;
          const Leakage rigorous     = leak(gap, fluid);
          EXPECT_EQ(rigorous.status, "ok");
          EXPECT_LT(rigorous.mesh_lower, asymptotic.lower);
          EXPECT_GT(rigorous.mesh_upper, asymptotic.upper);
        }
    }

    // In a constant gap, the extremes of K are equal, so that the bounds are exact.
    TEST(FlowBracket, RigorousBoundsOfParallelPlatesAreExact)
    {
      FluidParameters fluid = plain_fluid();
      fluid.rigorous_bounds = true;
      const Leakage flow = leak(sample([](double, double) { return .3; }, 32, 32), fluid);
      EXPECT_NEAR(flow.lower, .027, 1e-9);
      EXPECT_NEAR(flow.upper, .027, 1e-9);
    }
  } // namespace
} // namespace strait
