// SPDX-License-Identifier: GPL-2.0-or-later
// Westergaard's contact with the wave h = cos 2πx, on a grid of four points along y.
#include <gtest/gtest.h>

#include "../unit/contact_tools.h"
#include "reference/wavy_contact.h"

namespace
{
  using namespace contact_tests;

  struct WestergaardErrors
  {
    double mean_gap; // over the amplitude
    double gap;      // largest error, over the amplitude
    double pressure; // root mean square, relative
    double width;    // of the contact, over the wavelength
  };

  WestergaardErrors
  solve_westergaard(const int n, const double load)
  {
    const reference::Westergaard exact = {1., 1., 1., load * pi};
    const SlabField    heights = sampled({n, 4, 1., 4. / n}, [](const double x, double) {
      return std::cos(2 * pi * x);
    });
    ContactSolver      solver(contact_parameters(1e-10), heights);
    const ContactState state = solver.solve(exact.nominal_pressure);
    EXPECT_TRUE(state.converged);

    WestergaardErrors         errors = {state.mean_gap - exact.mean_gap(),
                                        0,
                                        0,
                                        state.contact_area - 2 * exact.contact_half_width()};
    const std::vector<double> p      = fetch_rows(state.pressure, {0});
    const std::vector<double> g      = fetch_rows(state.gap, {0});
    double                    total  = 0;
    for (int i = 0; i < n; ++i)
      {
        const double x = 2 * i <= n ? double(i) / n : double(i) / n - 1;
        errors.gap     = std::max(errors.gap, std::abs(g[i] - exact.gap(x)));
        errors.pressure += std::pow(p[i] - exact.pressure(x), 2);
        total += std::pow(exact.pressure(x), 2);
      }
    errors.pressure = std::sqrt(errors.pressure / total);
    return errors;
  }

  TEST(Westergaard, MeanGapAndPressureAtHalfLoad)
  {
    const WestergaardErrors coarse = solve_westergaard(64, 0.5),
                            middle = solve_westergaard(256, 0.5),
                            fine   = solve_westergaard(1024, 0.5);
    const double gap_order = std::log(coarse.mean_gap / fine.mean_gap) / std::log(16.);
    const double pressure_order =
      std::log(coarse.pressure / fine.pressure) / std::log(16.);
    RecordProperty("mean_gap_order", std::to_string(gap_order));
    RecordProperty("pressure_order", std::to_string(pressure_order));
    // Contact ends on a grid point here, so that the mean gap superconverges.
    EXPECT_GT(gap_order, 1.9);
    EXPECT_GT(pressure_order, 0.95);
    // The mean gap itself is 0.153.
    EXPECT_LT(std::abs(middle.mean_gap), 1e-5);
    EXPECT_LT(middle.gap, 1e-5);
    EXPECT_LT(middle.pressure, 4e-3);
    // With its lines on grid points, the contact has one point too many.
    EXPECT_NEAR(middle.width, 1. / 256, 1e-12);
  }

  TEST(Westergaard, ContactLinesBetweenGridPoints)
  {
    // A single error jumps with the position of the contact line between grid points;
    // the root mean square over many loads has an order.
    std::vector<double> gap_errors, mean_gap_errors;
    for (const int n : {64, 256, 1024})
      {
        double gap = 0, mean_gap = 0;
        for (const double load : {0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9})
          {
            const WestergaardErrors errors = solve_westergaard(n, load);
            EXPECT_LE(std::abs(errors.width), 2. / n);
            gap += errors.gap * errors.gap / 9;
            mean_gap += errors.mean_gap * errors.mean_gap / 9;
          }
        gap_errors.push_back(std::sqrt(gap));
        mean_gap_errors.push_back(std::sqrt(mean_gap));
      }
    const double gap_order = std::log(gap_errors[0] / gap_errors[2]) / std::log(16.);
    const double mean_gap_order =
      std::log(mean_gap_errors[0] / mean_gap_errors[2]) / std::log(16.);
    RecordProperty("gap_order", std::to_string(gap_order));
    RecordProperty("mean_gap_order", std::to_string(mean_gap_order));
    EXPECT_GT(gap_order, 1.3);
    EXPECT_GT(mean_gap_order, 1.7);
    EXPECT_LT(gap_errors[1], 3e-4);
    EXPECT_LT(mean_gap_errors[1], 1e-4);
  }
} // namespace
