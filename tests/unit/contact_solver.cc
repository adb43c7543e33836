// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>

#include <gtest/gtest.h>

#include "allocated_memory.h"
#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  struct TestCase
  {
    const char  *name;
    SlabField    heights;
    const double full_pressure; // about where contact is complete
  };

  std::vector<TestCase>
  test_cases()
  {
    const PeriodicGrid square = {64, 64, 1., 1.}, rectangle = {96, 40, 2., 1.},
                       prime = {61, 53, 1., 1.};
    return {{"saddle", saddle_heights(64), 2 * pi},
            {"sine",
             sampled(square, [](const double x, double) { return std::cos(2 * pi * x); }),
             pi},
            {"rough", rough_heights(square, 16), 2.},
            {"rough rectangle", rough_heights(rectangle, 9), 1.},
            {"rough prime", rough_heights(prime, 9), 1.}};
  }

  TEST(ContactSolver, SolvesTheContactConditions)
  {
    for (const TestCase &test : test_cases())
      for (const double load : {0.001, 0.1, 0.5, 0.97})
        {
          SCOPED_TRACE(std::string(test.name) + " at " + std::to_string(load));
          ContactSolver      solver(contact_parameters(1e-9), test.heights);
          const ContactState state = solver.solve(load * test.full_pressure);
          EXPECT_TRUE(state.converged);
          EXPECT_LE(state.residual, 1e-9);
          EXPECT_LT(violation(state, test.heights, 1.), 3e-9);
          EXPECT_NEAR(mean(state.pressure),
                      load * test.full_pressure,
                      1e-13 * test.full_pressure);
          EXPECT_EQ(state.nominal_pressure, load * test.full_pressure);
          EXPECT_DOUBLE_EQ(state.mean_gap, mean(state.gap));
          EXPECT_LE(state.iterations, 90);
        }
  }

  TEST(ContactSolver, AgreesWithPolonskyAndKeer)
  {
    const double tolerance = 1e-9;
    for (const TestCase &test : test_cases())
      for (const double load : {0.02, 0.2, 0.6})
        {
          SCOPED_TRACE(std::string(test.name) + " at " + std::to_string(load));
          const double       p0 = load * test.full_pressure;
          ContactSolver      ours(contact_parameters(tolerance), test.heights);
          ContactSolver      theirs(contact_parameters(tolerance,
                                                  ContactControl::load,
                                                  ContactMethod::polonsky_keer),
                               test.heights);
          const ContactState a = ours.solve(p0), b = theirs.solve(p0);
          ASSERT_TRUE(a.converged);
          ASSERT_TRUE(b.converged);
          EXPECT_LT(largest_difference(a.gap, b.gap), 10 * tolerance * rms(test.heights));
          EXPECT_LT(largest_difference(a.pressure, b.pressure),
                    1e-6 * max_value(a.pressure));
          EXPECT_NEAR(a.contact_area, b.contact_area, 2. / a.gap.grid().n_points());
        }
  }

  TEST(ContactSolver, MeanGapControlReachesTheStateOfLoadControl)
  {
    for (const ContactMethod method :
         {ContactMethod::dual_cg, ContactMethod::polonsky_keer})
      for (const TestCase &test : test_cases())
        for (const double load : {0.01, 0.2, 0.7})
          {
            SCOPED_TRACE(std::string(test.name) + " at " + std::to_string(load) +
                         (method == ContactMethod::dual_cg ? "" : ", Polonsky-Keer"));
            ContactSolver      by_load(contact_parameters(1e-9), test.heights);
            const ContactState a = by_load.solve(load * test.full_pressure);
            ContactSolver      by_gap(
              contact_parameters(1e-9, ContactControl::mean_gap, method), test.heights);
            const ContactState b = by_gap.solve(a.mean_gap);
            EXPECT_TRUE(b.converged);
            EXPECT_NEAR(b.mean_gap, a.mean_gap, 3e-9 * rms(test.heights));
            EXPECT_NEAR(b.nominal_pressure,
                        a.nominal_pressure,
                        1e-6 * a.nominal_pressure);
            EXPECT_LT(largest_difference(a.gap, b.gap), 1e-7 * rms(test.heights));
          }
  }

  TEST(ContactSolver, GivesTheSameStateFromEveryStart)
  {
    const SlabField heights = rough_heights({128, 128, 1., 1.}, 24);
    ContactSolver   cold(contact_parameters(1e-9), heights),
      warm                       = {contact_parameters(1e-9), heights};
    const ContactState nested    = cold.solve(0.1);
    const ContactState first     = warm.solve(0.092);
    const ContactState second    = warm.solve(0.096, &first);
    const ContactState continued = warm.solve(0.1, &second);
    EXPECT_LT(continued.fft_pairs, nested.fft_pairs);
    EXPECT_LT(largest_difference(nested.gap, continued.gap), 1e-8 * rms(heights));
    EXPECT_LT(largest_difference(nested.pressure, continued.pressure),
              1e-6 * max_value(nested.pressure));
    const ContactState again = warm.solve(0.1);
    EXPECT_EQ(largest_difference(nested.gap, again.gap), 0.);
    EXPECT_EQ(again.fft_pairs, nested.fft_pairs);
  }

  TEST(ContactSolver, StartsFromAStateOnlyIfItIsNear)
  {
    const SlabField    heights = rough_heights({256, 256, 1., 1.}, 24);
    ContactSolver      solver(contact_parameters(1e-8), heights);
    const ContactState nested = solver.solve(.1);
    const ContactState next   = solver.solve(.101, &nested);
    EXPECT_LT(solver.solve(.102, &next).fft_pairs, nested.fft_pairs);
    // A distant state is not used.
    const ContactState before = solver.solve(.08);
    const ContactState state  = solver.solve(.1, &before);
    EXPECT_EQ(state.fft_pairs, nested.fft_pairs);
    EXPECT_EQ(largest_difference(state.gap, nested.gap), 0.);
  }

  TEST(ContactSolver, HoldsAMeanGapWhereMostTouches)
  {
    // The gap is then nearly uniform, for which the half-space has no
    // stiffness; the preconditioner gives it that of the longest wave.
    const SlabField heights = rough_heights({64, 64, 1., 1.}, 12);
    ContactSolver   solver(contact_parameters(1e-8, ContactControl::mean_gap), heights);
    for (const double mean_gap : {1e-2, 3e-3, 1e-3, 1e-4})
      {
        const ContactState state = solver.solve(mean_gap);
        EXPECT_TRUE(state.converged) << mean_gap;
        EXPECT_LT(state.fft_pairs, 40) << mean_gap;
        EXPECT_NEAR(state.mean_gap / mean_gap, 1., 1e-5);
        EXPECT_GT(state.contact_area, mean_gap < 5e-3 ? .6 : .3);
      }
  }

  TEST(ContactSolver, SolvesByHalvesAsAtOnce)
  {
    const SlabField    heights = rough_heights({64, 64, 1., 1.}, 16);
    ContactSolver      solver(contact_parameters(1e-8), heights);
    const ContactState before  = solver.solve(.2);
    const ContactState at_once = solver.solve(.21, &before);
    const ContactState rough   = solver.solve(.21, &before, nullptr, Digits::half);
    EXPECT_LE(rough.residual, 1e-4);
    EXPECT_LT(rough.fft_pairs, at_once.fft_pairs);
    const ContactState state = solver.solve(.21, &rough);
    EXPECT_LE(state.residual, 1e-8);
    EXPECT_LT(violation(state, heights, 1.), 3e-8);
    EXPECT_NEAR(state.mean_gap, at_once.mean_gap, 1e-7 * at_once.mean_gap);
    // It keeps the approach of the first half, so that the next load starts alike.
    EXPECT_DOUBLE_EQ(state.approach.steps_to(.22), at_once.approach.steps_to(.22));
  }

  TEST(ContactSolver, DoesNotDependOnTheUnits)
  {
    const PeriodicGrid grid    = {64, 48, 1., 1.};
    const SlabField    heights = rough_heights(grid, 12);
    ContactSolver      reference(contact_parameters(1e-8), heights);
    const ContactState expected = reference.solve(0.05);
    for (const auto &[length, modulus] : std::vector<std::pair<double, double>>{
           {1e-12, 1e12}, {1e12, 1e-12}, {1e-12, 1e-12}, {1e-9, 1.}})
      {
        // Scale all lengths, then the heights alone.
        for (const double box : {length, 1.})
          {
            SlabField scaled(make_layout({64, 48, box, box}, MPI_COMM_WORLD));
            for (std::size_t i = 0; i < scaled.size(); ++i)
              scaled[i] = length * heights[i];
            ContactParameters parameters = contact_parameters(1e-8);
            parameters.effective_modulus = modulus;
            ContactSolver      solver(parameters, scaled);
            const ContactState state = solver.solve(0.05 * modulus * length / box);
            EXPECT_TRUE(state.converged);
            EXPECT_NEAR(state.contact_area, expected.contact_area, 1e-3);
            EXPECT_NEAR(state.mean_gap / length, expected.mean_gap, 1e-8);
          }
      }
  }

  TEST(ContactSolver, DoesNotDependOnTheOriginOfHeights)
  {
    SlabField          heights = rough_heights({64, 64, 1., 1.}, 12);
    ContactSolver      solver(contact_parameters(1e-8), heights);
    const ContactState expected = solver.solve(0.05);
    for (double &h : heights)
      h += 1e3;
    ContactSolver      shifted(contact_parameters(1e-8), heights);
    const ContactState state = shifted.solve(0.05);
    EXPECT_EQ(state.contact_area, expected.contact_area);
    EXPECT_NEAR(state.mean_gap, expected.mean_gap, 1e-9);
  }

  TEST(ContactSolver, TouchesOnePointUnderATinyLoad)
  {
    SlabField     heights = sampled({64, 64, 1., 1.}, [](const double x, const double y) {
      return std::cos(2 * pi * x) + std::cos(2 * pi * y);
    });
    ContactSolver solver(contact_parameters(1e-10), heights);
    const ContactState state = solver.solve(1e-12);
    EXPECT_TRUE(state.converged);
    EXPECT_EQ(state.contact_area, 1. / 4096);
    EXPECT_NEAR(value_at(state.pressure, 0, 0), 4096e-12, 1e-20);
  }

  TEST(ContactSolver, PressesAFlatSurfaceUniformly)
  {
    for (const PeriodicGrid &grid :
         {PeriodicGrid{64, 64, 1., 1.}, PeriodicGrid{17, 13, 2., 1.}})
      {
        const SlabField heights = sampled(grid, [](double, double) { return 0.1; });
        for (const ContactMethod method :
             {ContactMethod::dual_cg, ContactMethod::polonsky_keer})
          {
            ContactSolver solver(contact_parameters(1e-8, ContactControl::load, method),
                                 heights);
            const ContactState state = solver.solve(0.3);
            EXPECT_TRUE(state.converged);
            EXPECT_EQ(state.contact_area, 1.);
            EXPECT_EQ(state.mean_gap, 0.);
            EXPECT_NEAR(min_value(state.pressure), 0.3, 1e-12);
          }
        ContactSolver by_gap(contact_parameters(1e-8, ContactControl::mean_gap), heights);
        const ContactState apart = by_gap.solve(1e-3);
        EXPECT_EQ(apart.contact_area, 0.);
        EXPECT_NEAR(apart.mean_gap, 1e-3, 1e-15);
      }
  }

  TEST(ContactSolver, ReachesFullContact)
  {
    const SlabField heights = saddle_heights(48);
    for (const double load : {0.995, 1.001, 3.})
      {
        ContactSolver      solver(contact_parameters(1e-9), heights);
        const ContactState state = solver.solve(load * 2 * pi);
        EXPECT_TRUE(state.converged);
        EXPECT_LT(violation(state, heights, 1.), 3e-9);
        EXPECT_EQ(state.contact_area == 1., load > 1.);
      }
    // In full contact p = p0 + K h, here p0 ± 2π at the extremes.
    ContactSolver      solver(contact_parameters(1e-9), heights);
    const ContactState state = solver.solve(9.);
    EXPECT_NEAR(value_at(state.pressure, 0, 0), 9. + 2 * pi, 1e-6);
    EXPECT_NEAR(value_at(state.pressure, 24, 24), 9. - 2 * pi, 1e-6);
  }

  TEST(ContactSolver, LeavesSurfacesApartWhereTheMeanGapSaysSo)
  {
    const SlabField heights = saddle_heights(64);
    ContactSolver   solver(contact_parameters(1e-8, ContactControl::mean_gap), heights);
    const ContactState state = solver.solve(2.5); // the peak is 2 above the mean
    EXPECT_TRUE(state.converged);
    EXPECT_EQ(state.iterations, 0);
    EXPECT_EQ(state.fft_pairs, 1);
    EXPECT_EQ(state.nominal_pressure, 0.);
    EXPECT_EQ(state.contact_area, 0.);
    EXPECT_NEAR(state.mean_gap, 2.5, 1e-14);
    EXPECT_NEAR(value_at(state.gap, 0, 0), 0.5, 1e-14);
    // The same solver finds contact afterwards.
    EXPECT_GT(solver.solve(1.9).nominal_pressure, 0.);
  }

  TEST(ContactSolver, RefusesWhatCannotMakeContact)
  {
    const SlabField heights = saddle_heights(16);
    ContactSolver   by_load(contact_parameters(1e-8), heights);
    ContactSolver   by_gap(contact_parameters(1e-8, ContactControl::mean_gap), heights);
    for (const double bad : {0., -1., double(NAN), double(INFINITY)})
      {
        EXPECT_THROW(by_load.solve(bad), InputError);
        EXPECT_THROW(by_gap.solve(bad), InputError);
      }
    SlabField holes = heights;
    if (holes.size() > 0)
      holes[0] = NAN;
    EXPECT_THROW(ContactSolver(contact_parameters(1e-8), holes), InputError);
  }

  TEST(ContactSolver, LeavesAnAdmissibleStateAtTheCap)
  {
    for (const ContactMethod method :
         {ContactMethod::dual_cg, ContactMethod::polonsky_keer})
      {
        const SlabField   heights = rough_heights({128, 128, 1., 1.}, 24);
        ContactParameters parameters =
          contact_parameters(1e-12, ContactControl::load, method);
        parameters.maximum_iterations = 4;
        ContactSolver      solver(parameters, heights);
        const ContactState state = solver.solve(0.05);
        EXPECT_FALSE(state.converged);
        EXPECT_EQ(state.iterations, 4);
        EXPECT_GT(state.residual, 1e-12);
        EXPECT_NEAR(mean(state.pressure), 0.05, 1e-14);
        EXPECT_GE(min_value(state.pressure), 0.);
        EXPECT_GE(min_value(state.gap), 0.);
        EXPECT_LT(violation(state, heights, 1.), 1.);
      }
  }

  TEST(ContactSolver, ReachesRoundingIfAsked)
  {
    const SlabField    heights = rough_heights({256, 256, 1., 1.}, 32);
    ContactSolver      solver(contact_parameters(1e-13), heights);
    const ContactState state = solver.solve(0.2);
    EXPECT_TRUE(state.converged);
    EXPECT_LE(state.residual, 1e-13);
    EXPECT_LE(state.fft_pairs, 40);
  }

  TEST(ContactSolver, HoldsAtMost44BytesAPoint)
  {
    const SlabField heights = rough_heights({256, 240, 1., 1.}, 32);
    forget_most_allocated_memory();
    const std::size_t before = allocated_memory();
    ContactSolver     solver(contact_parameters(1e-6), heights);
    solver.solve(0.1);
    const auto   local = static_cast<double>(most_allocated_memory() - before);
    const double bytes = sum(MPI_COMM_WORLD, local);
    // Several ranks also hold messages, and may have different numbers of rows.
    const bool is_alone = n_ranks_in(MPI_COMM_WORLD) == 1;
    EXPECT_LE(bytes / heights.grid().n_points(), is_alone ? 44. : 52.);
    EXPECT_GE(bytes / heights.grid().n_points(), 42.);
  }

  TEST(ContactSolver, IsTheSameOnAnyNumberOfRanks)
  {
    const SlabField    heights = rough_heights({96, 100, 1., 1.}, 20);
    ContactSolver      solver(contact_parameters(1e-11), heights);
    const ContactState state = solver.solve(0.1);
    ASSERT_TRUE(state.converged);
    // Results of a run on one rank.
    EXPECT_NEAR(state.contact_area, 0.10625, 1e-9);
    EXPECT_NEAR(state.mean_gap, 0.11387842973610721, 1e-10);
    EXPECT_NEAR(value_at(state.gap, 7, 93), 0.19921783938484727, 1e-9);
    EXPECT_NEAR(rms(state.gap), 0.085890316831544147, 1e-10);
  }
} // namespace
