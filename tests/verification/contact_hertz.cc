// SPDX-License-Identifier: GPL-2.0-or-later
// Hertz's contact: a parabola in a box of 16 contact radii, where its periodic images
// change the result by about (a/L)³ = 2.4e-4.
#include <gtest/gtest.h>

#include "../unit/contact_tools.h"
#include "reference/hertz.h"

namespace
{
  using namespace contact_tests;

  struct HertzErrors
  {
    double radius;   // of the contact, from its corrected area, relative
    double peak;     // largest pressure, relative
    double pressure; // root mean square, relative
  };

  HertzErrors
  solve_hertz(const int n)
  {
    const reference::Hertz hertz   = {0.01, 1., 1.};
    const double           a       = hertz.contact_radius();
    const double           L       = 16 * a;
    const PeriodicGrid     grid    = {n, n, L, L};
    const SlabField        heights = sampled(grid, [&](const double x, const double y) {
      return -(std::pow(x - L / 2, 2) + std::pow(y - L / 2, 2)) / (2 * hertz.radius);
    });
    const SlabField        exact   = sampled(grid, [&](const double x, const double y) {
      return hertz.pressure(std::hypot(x - L / 2, y - L / 2));
    });
    ContactSolver          solver(contact_parameters(1e-9), heights);
    const ContactState     state = solver.solve(hertz.force / (L * L));
    EXPECT_TRUE(state.converged);

    double difference = 0, total = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      {
        difference += std::pow(state.pressure[i] - exact[i], 2);
        total += std::pow(exact[i], 2);
      }
    return {std::sqrt(state.contact_area_corrected * L * L / pi) / a - 1,
            max_value(state.pressure) / hertz.largest_pressure() - 1,
            std::sqrt(sum(MPI_COMM_WORLD, difference) / sum(MPI_COMM_WORLD, total))};
  }

  TEST(Hertz, PressureConvergesAtFirstOrder)
  {
    // The pressure vanishes as a square root at a contact line that is known only to a
    // grid spacing: no order much above one can be expected.
    const HertzErrors coarse = solve_hertz(128), middle = solve_hertz(256),
                      fine = solve_hertz(512);
    RecordProperty("rms_error_128", std::to_string(coarse.pressure));
    RecordProperty("rms_error_256", std::to_string(middle.pressure));
    RecordProperty("rms_error_512", std::to_string(fine.pressure));
    const double order = std::log2(coarse.pressure / fine.pressure) / 2;
    RecordProperty("order", std::to_string(order));
    EXPECT_GT(order, 0.9);
    EXPECT_LT(fine.pressure, 8e-3);

    for (const HertzErrors &errors : {coarse, middle, fine})
      EXPECT_LT(std::abs(errors.peak), 5e-4);
    // 0.16 grid spacings, which are a/8, a/16 and a/32.
    EXPECT_LT(std::abs(coarse.radius), 2e-2);
    EXPECT_LT(std::abs(middle.radius), 1e-2);
    EXPECT_LT(std::abs(fine.radius), 5e-3);
  }
} // namespace
