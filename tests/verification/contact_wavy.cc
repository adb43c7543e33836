// SPDX-License-Identifier: GPL-2.0-or-later
// The wave h = cos 2πx cos 2πy, whose contact area is known for low and high load.
#include <gtest/gtest.h>

#include "../unit/contact_tools.h"
#include "reference/wavy_contact.h"

namespace
{
  using namespace contact_tests;
  namespace wave = reference::product_wave;

  /** Return the corrected contact fractions at @p loads, which are in units of p*. */
  std::vector<double>
  contact_fractions(const int n, const std::vector<double> &loads)
  {
    const SlabField heights = sampled({n, n, 1., 1.}, [](const double x, const double y) {
      return std::cos(2 * pi * x) * std::cos(2 * pi * y);
    });
    ContactSolver   solver(contact_parameters(1e-8), heights);
    std::vector<double> fractions;
    for (const double load : loads)
      fractions.push_back(
        solver.solve(load * wave::full_pressure(1., 1., 1.)).contact_area_corrected);
    return fractions;
  }

  TEST(ProductWave, TendsToItsLimitAtLowLoad)
  {
    // The peaks interact in proportion to the load, so that the ratio tends to 1.
    const std::vector<double> loads = {0.003, 0.006, 0.012},
                              areas = contact_fractions(512, loads);
    std::vector<double> ratios;
    for (std::size_t k = 0; k < loads.size(); ++k)
      ratios.push_back(areas[k] / wave::contact_fraction_at_low_load(loads[k]));
    EXPECT_NEAR(ratios[0], 1., 0.01);
    EXPECT_LT(ratios[1], ratios[2]);
    EXPECT_LT(ratios[2], 1.05);
  }

  TEST(ProductWave, TendsToItsLimitAtHighLoad)
  {
    const std::vector<double> loads = {0.9, 0.95, 0.98},
                              areas = contact_fractions(512, loads);
    std::vector<double> ratios;
    for (std::size_t k = 0; k < loads.size(); ++k)
      ratios.push_back((1 - areas[k]) /
                       (1 - wave::contact_fraction_at_high_load(loads[k])));
    EXPECT_GT(ratios[0], ratios[1]);
    EXPECT_GT(ratios[1], ratios[2]);
    EXPECT_NEAR(ratios[2], 1., 0.01);
  }

  TEST(ProductWave, ContactAreaConverges)
  {
    // In between, there is no closed form: take errors from a fine grid, and their root
    // mean square over several loads.
    const std::vector<double>        loads = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
    std::vector<std::vector<double>> areas;
    for (const int n : {64, 128, 256, 1024})
      areas.push_back(contact_fractions(n, loads));
    std::vector<double> errors;
    for (int grid = 0; grid < 3; ++grid)
      {
        double total = 0;
        for (std::size_t k = 0; k < loads.size(); ++k)
          total += std::pow(areas[grid][k] - areas[3][k], 2);
        errors.push_back(std::sqrt(total / static_cast<double>(loads.size())));
      }
    const double order = std::log2(errors[0] / errors[2]) / 2;
    RecordProperty("order", std::to_string(order));
    EXPECT_GT(order, 0.7);
    EXPECT_LT(errors[2], 1e-3);
  }
} // namespace
