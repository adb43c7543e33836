// SPDX-License-Identifier: GPL-2.0-or-later
// The isolated constriction h = 2 + cos 2πx + cos 2πy.
#include <gtest/gtest.h>

#include "../unit/contact_tools.h"
#include "reference/wavy_contact.h"

namespace
{
  using namespace contact_tests;

  struct SaddleState
  {
    double load; // over p*
    double contact_area;
    double mean_gap;
    double saddle_gap;
  };

  // From an independent computation on grids up to 1024², extrapolated.
  const std::vector<SaddleState> expected = {{0.10, 0.1905, 0.7695, 0.5706},
                                             {0.15, 0.2652, 0.5532, 0.2747},
                                             {0.20, 0.3452, 0.40927, 0.071349},
                                             {0.22, 0.3820, 0.36678, 0.015868}};

  double
  saddle_gap(ContactSolver &solver, const int n, const double load)
  {
    const double       p0    = load * reference::square_saddle::full_pressure(1., 1., 1.);
    const ContactState state = solver.solve(p0);
    EXPECT_TRUE(state.converged);
    return value_at(state.gap, n / 2, 0);
  }

  TEST(SquareSaddle, ContactAreaMeanGapAndSaddleGap)
  {
    const int     n = 512;
    ContactSolver solver(contact_parameters(1e-8), saddle_heights(n));
    for (const SaddleState &exact : expected)
      {
        SCOPED_TRACE(exact.load);
        const double p0 =
          exact.load * reference::square_saddle::full_pressure(1., 1., 1.);
        const ContactState state = solver.solve(p0);
        ASSERT_TRUE(state.converged);
        EXPECT_NEAR(state.contact_area_corrected, exact.contact_area, 5e-4);
        EXPECT_NEAR(state.mean_gap, exact.mean_gap, 2e-4 * exact.mean_gap);
        EXPECT_NEAR(value_at(state.gap, n / 2, 0),
                    exact.saddle_gap,
                    1e-3 * exact.saddle_gap);
        // The two saddles of the periodic cell are equivalent.
        EXPECT_NEAR(value_at(state.gap, 0, n / 2), value_at(state.gap, n / 2, 0), 1e-6);
      }
  }

  TEST(SquareSaddle, SaddleGapConverges)
  {
    // Take the root mean square over several loads, because a single error jumps with
    // the position of the contact line between grid points.
    const std::vector<double>        loads = {0.05, 0.08, 0.11, 0.14, 0.17, 0.2};
    std::vector<std::vector<double>> gaps;
    for (const int n : {32, 64, 128, 1024})
      {
        ContactSolver       solver(contact_parameters(1e-9), saddle_heights(n));
        std::vector<double> values;
        for (const double load : loads)
          values.push_back(saddle_gap(solver, n, load));
        gaps.push_back(values);
      }
    std::vector<double> errors;
    for (int grid = 0; grid < 3; ++grid)
      {
        double total = 0;
        for (std::size_t k = 0; k < loads.size(); ++k)
          total += std::pow(gaps[grid][k] - gaps[3][k], 2);
        errors.push_back(std::sqrt(total / static_cast<double>(loads.size())));
      }
    const double order = std::log2(errors[0] / errors[2]) / 2;
    RecordProperty("order", std::to_string(order));
    EXPECT_GT(order, 1.7);
    EXPECT_LT(errors[2], 5e-5);
  }
  // Beyond the critical load, a neck joins the patches. The line load across its middle
  // grows about as the gap of the throat had vanished, with an exponent that drifts. The
  // expected exponents are those of doc/closing.md on 1024² points.
  TEST(SquareSaddle, NeckBeyondTheCriticalLoad)
  {
    const int                 n             = 512;
    const double              critical_load = 1.43636642;
    const std::vector<double> excess        = {.1, .05, .02};
    const std::vector<double> exponents     = {1.2725, 1.2632};
    ContactSolver             solver(contact_parameters(1e-10), saddle_heights(n));
    std::vector<double>       line_loads;
    for (const double e : excess)
      {
        const ContactState state = solver.solve(critical_load * (1. + e));
        ASSERT_TRUE(state.converged);
        double load = 0.;
        for (int ix = 0; ix < n; ++ix)
          load += value_at(state.pressure, ix, n / 2) / n;
        line_loads.push_back(load);
      }
    for (std::size_t k = 0; k < exponents.size(); ++k)
      EXPECT_NEAR(std::log(line_loads[k] / line_loads[k + 1]) /
                    std::log(excess[k] / excess[k + 1]),
                  exponents[k],
                  .005);
  }
} // namespace
