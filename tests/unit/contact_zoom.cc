// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/grid_transfer.h>
#include <strait/contact/zoomed_problem.h>
#include <strait/spectral/fill_windows.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  ZoomWindow
  window_at(const int parent,
            const int level,
            const int x,
            const int y,
            const int nx,
            const int ny)
  {
    ZoomWindow window;
    window.parent = parent;
    window.level  = level;
    window.x      = x;
    window.y      = y;
    window.nx     = nx;
    window.ny     = ny;
    return window;
  }

  /** A grid with two windows; the first crosses the seam and contains another one. */
  SlabLayoutPtr
  nested_layout()
  {
    return with_windows(*make_layout({64, 64, 1., 1.}, MPI_COMM_WORLD),
                        {window_at(-1, 1, -6, 20, 24, 20),
                         window_at(0, 2, 20, 17, 20, 24),
                         window_at(-1, 1, 30, 10, 20, 20)});
  }

  /** Return rough values, the same on all ranks; 0 at points that windows cover. */
  SlabField
  rough_values(const SlabLayoutPtr &layout, const double a)
  {
    SlabField values = sample(layout, [a](const double x, const double y) {
      return std::sin(a * (3571 * x + 911 * y)) * std::cos(a * (1277 * x - 2789 * y));
    });
    SlabField result(layout);
    for (const SlabLayout::Range &range : layout->ranges())
      for (std::size_t k = range.begin; k < range.end; ++k)
        result[k] = values[k];
    return result;
  }

  double
  weighted(const DualProblem &problem, const SlabField &a, const SlabField &b)
  {
    return weighted_sums<1>(problem, [&](const std::size_t k, auto &sums) {
      sums[0] += a[k] * b[k];
    })[0];
  }

  TEST(Zoom, PointsStandForTheWholeBoxOnce)
  {
    EXPECT_NEAR(mean(SlabField(nested_layout(), 3.)), 3., 1e-13);
  }

  TEST(Zoom, FourierSeriesIsExactForWhatTheGridResolves)
  {
    const SlabField expected =
      sample(nested_layout(), [](const double x, const double y) {
        return std::cos(2 * pi * (3 * x + 2 * y)) +
               .2 * std::sin(2 * pi * (5 * x - 7 * y) + .3);
      });
    SlabField field = expected;
    for (std::size_t k = field.layout().n_local_points(); k < field.size(); ++k)
      field[k] = 7.;
    fill_windows(field);
    for (std::size_t k = 0; k < field.size(); ++k)
      EXPECT_NEAR(field[k], expected[k], 1e-13);
  }

  TEST(Zoom, OperatorsAreSymmetricToRounding)
  {
    const SlabLayoutPtr layout = nested_layout();
    const SlabField     flat(layout);
    ZoomedProblem       problem(flat, 2.);
    const SlabField     a = rough_values(layout, 1.), b = rough_values(layout, 1.7);
    SlabField           Ga(layout), Gb(layout), Ma(layout), Mb(layout);
    const double        work = problem.apply(a.data(), Ga.data());
    problem.apply(b.data(), Gb.data());
    EXPECT_GT(work, 0.);
    EXPECT_NEAR(weighted(problem, a, Ga), work, 1e-14 * work);
    const double Gbb = weighted(problem, b, Gb);
    EXPECT_NEAR(weighted(problem, a, Gb),
                weighted(problem, b, Ga),
                1e-14 * std::sqrt(work * Gbb));
    std::vector<std::uint8_t> marks(a.size(), 0);
    for (const SlabLayout::Range &range : problem.ranges)
      for (std::size_t k = range.begin; k < range.end; ++k)
        marks[k] = a[k] > 0;
    const auto precondition = [&](const SlabField &field, SlabField &result) {
      std::vector<float> values(field.begin(), field.end());
      for (std::size_t k = 0; k < values.size(); ++k)
        values[k] *= marks[k];
      problem.precondition(values.data(), marks.data());
      for (std::size_t k = 0; k < values.size(); ++k)
        result[k] = marks[k] * values[k];
    };
    precondition(a, Ma);
    precondition(b, Mb);
    const double Maa = weighted(problem, a, Ma), Mbb = weighted(problem, b, Mb);
    EXPECT_GT(Maa, 0.);
    EXPECT_NEAR(weighted(problem, a, Mb),
                weighted(problem, b, Ma),
                1e-7 * std::sqrt(Maa * Mbb)); // single precision
  }

  TEST(Zoom, StepsAreAnsweredToSevenDigitsInTheirPlace)
  {
    const SlabLayoutPtr layout = nested_layout();
    const SlabField     flat(layout);
    ZoomedProblem       problem(flat, 2.);
    const SlabField     p = rough_values(layout, 1.);
    SlabField           u(layout);
    const double        work = problem.apply(p.data(), u.data());
    std::vector<float>  step(p.begin(), p.end());
    EXPECT_NEAR(problem.respond(step.data(), step.data()), work, 1e-6 * work);
    const double most = max_value(u);
    for (const SlabLayout::Range &range : problem.ranges)
      for (std::size_t i = range.begin; i < range.end; ++i)
        EXPECT_NEAR(step[i], u[i], 1e-6 * most) << i;
  }

  // A pressure within a window, too narrow for the grid itself to resolve well.
  TEST(Zoom, DisplacementIsThatOfTheFineGrid)
  {
    const int  n      = 64;
    const auto narrow = [](const double x, const double y) {
      return std::exp(-(std::pow(x - .5, 2) + std::pow(y - .4, 2)) / 4e-4);
    };
    const SlabLayoutPtr layout =
      with_windows(*make_layout({n, n, 1., 1.}, MPI_COMM_WORLD),
                   {window_at(-1, 1, 20, 14, 24, 24)});
    SlabField p = sample(layout, narrow), u(layout);
    layout->for_each_covered(
      [&](const std::size_t parent, std::size_t) { p[parent] = 0.; });
    const SlabField flat(layout);
    ZoomedProblem   problem(flat, 1.);
    problem.apply(p.data(), u.data());

    const SlabField fine_p = sampled({3 * n, 3 * n, 1., 1.}, narrow);
    SlabField       fine_u(fine_p.layout_pointer());
    HalfSpaceProblem(fine_p, 1.).apply(fine_p.data(), fine_u.data());
    const std::vector<double> line = fetch_rows(fine_u, {3 * 26});
    const double              most = max_value(fine_u);
    // Compare on row 26 of the grid, near y = 0.4, in the window and beside it.
    const ZoomWindow &window = layout->windows()[0];
    const std::size_t row =
      layout->start_of_window(0) +
      static_cast<std::size_t>(3 * (26 - window.y) + 1) * window.n_columns();
    for (int ix = 0; ix < window.n_columns(); ++ix)
      EXPECT_NEAR(u[row + ix], line[3 * window.x - 1 + ix], 1e-3 * most) << ix;
    const std::vector<double> beside = fetch_rows(u, {26});
    for (const int ix : {0, 10, 19, 44, 50, 63})
      EXPECT_NEAR(beside[ix], line[3 * ix], 1e-3 * most) << ix;
  }

  TEST(Zoom, SaddleIsThatOfTheFineGrid)
  {
    const int          n    = 128;
    const double       load = .98 * 1.43637; // of the critical load
    ContactSolver      fine(contact_parameters(1e-9), saddle_heights(3 * n));
    ContactSolver      solver(contact_parameters(1e-9), saddle_heights(n));
    const ContactState on_grid = solver.solve(load);
    ContactState       start   = on_grid;
    start.pressure = zoom_in(on_grid.pressure, {window_at(-1, 1, 24, -40, 80, 80)});
    const ContactState zoomed   = solver.solve(load, &start);
    const ContactState expected = fine.solve(load);
    const auto         saddle   = [](const SlabField &gap) {
      return fetch_rows(gap, {0})[gap.grid().nx / 2];
    };
    const double gap = saddle(expected.gap);
    EXPECT_TRUE(zoomed.converged);
    EXPECT_LE(zoomed.iterations, 30);
    EXPECT_NEAR(mean(zoomed.pressure), load, 1e-13);
    // The remaining difference is the error of the contact around the window.
    const ZoomWindow         &window = zoomed.gap.layout().windows()[0];
    const std::vector<double> line   = fetch_rows(expected.gap, {0});
    const std::size_t         row    = zoomed.gap.layout().start_of_window(0) +
                            static_cast<std::size_t>(3 * 40 + 1) * window.n_columns();
    for (int ix = 0; ix < window.n_columns(); ++ix)
      EXPECT_NEAR(zoomed.gap[row + ix], line[3 * window.x - 1 + ix], 2e-3 * gap) << ix;

    // The third load starts on the line through the last two states.
    const ContactState next = solver.solve(1.002 * load, &zoomed);
    EXPECT_TRUE(next.gap.layout().windows() == start.pressure.layout().windows());
    const ContactState third = solver.solve(1.004 * load, &next);
    EXPECT_LE(third.iterations, next.iterations);
    EXPECT_NEAR(saddle(third.gap), saddle(fine.solve(1.004 * load).gap), 2e-3 * gap);

    // Go on to a distant load, then start again without windows.
    const ContactState far = solver.solve(.5 * load, &third);
    EXPECT_NEAR(far.mean_gap, fine.solve(.5 * load).mean_gap, 1e-4 * far.mean_gap);
    const ContactState out = solver.solve(load);
    EXPECT_TRUE(out.gap.layout().windows().empty());
    EXPECT_EQ(saddle(out.gap), saddle(on_grid.gap));
  }

  TEST(Zoom, AFluidPressesAsOnAFineGridParallel)
  {
    constexpr int    n    = 128;
    constexpr double load = 1.45;
    // A step of the pressure across the throat, smooth on the fine grid.
    const auto fluid = [](const double x, const double) {
      return .1 * (1. - std::tanh(60. * std::sin(2 * M_PI * x)));
    };
    ContactSolver   fine(contact_parameters(1e-9), saddle_heights(3 * n));
    ContactSolver   solver(contact_parameters(1e-9), saddle_heights(n));
    const SlabField on_fine =
      sample(make_layout({3 * n, 3 * n, 1., 1.}, MPI_COMM_WORLD), fluid);
    ContactState start = solver.solve(load);
    start.pressure     = zoom_in(start.pressure, {window_at(-1, 1, 24, -40, 80, 80)});
    const SlabLayoutPtr layout   = start.pressure.layout_pointer();
    const SlabField     pressing = sample(layout, fluid);
    const ContactState  zoomed   = solver.solve(load, &start, &pressing);
    const ContactState  expected = fine.solve(load, nullptr, &on_fine);
    const ZoomWindow   &window   = layout->windows()[0];
    const auto          line     = fetch_rows(expected.gap, {0});
    const double        gap      = line[3 * n / 2];
    EXPECT_TRUE(zoomed.converged);
    EXPECT_NEAR(mean(zoomed.pressure) + mean(pressing), load, 1e-12);
    for (int ix = 0; ix < window.n_columns(); ++ix)
      EXPECT_NEAR(zoomed.gap[layout->index_of({ix, 3 * 40 + 1, 0})],
                  line[3 * window.x - 1 + ix],
                  2e-3 * gap)
        << ix;

    // A fluid leaves no trace in the solver, and a uniform one only carries load.
    const ContactState dry = solver.solve(load - .1, &start);
    const SlabField    uniform(layout, .1);
    const ContactState lifted = solver.solve(load, &zoomed, &uniform);
    EXPECT_LT(largest_difference(lifted.gap, dry.gap), 1e-7);
    ContactSolver other(contact_parameters(1e-9), saddle_heights(n));
    EXPECT_LT(largest_difference(other.solve(load - .1, &start).gap, dry.gap), 1e-7);
  }

  TEST(Zoom, TheTextbookMethodKnowsWindowsAsWell)
  {
    const SlabField heights = saddle_heights(64);
    ContactSolver   solver(contact_parameters(1e-8), heights);
    ContactSolver   textbook(contact_parameters(1e-8,
                                              ContactControl::load,
                                              ContactMethod::polonsky_keer),
                           heights);
    const double    load  = 1.4;
    ContactState    start = solver.solve(load);
    start.pressure        = zoom_in(start.pressure, {window_at(-1, 1, 12, -20, 40, 40)});
    const ContactState expected = solver.solve(load, &start);
    const ContactState found    = textbook.solve(load, &start);
    EXPECT_TRUE(found.converged);
    EXPECT_LT(largest_difference(found.gap, expected.gap), 1e-6);
  }
} // namespace
