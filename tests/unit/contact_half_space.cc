// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  class HalfSpaceOn : public testing::TestWithParam<PeriodicGrid>
  {
  };

  TEST_P(HalfSpaceOn, GivesAPressureWaveItsDisplacement)
  {
    const PeriodicGrid grid    = GetParam();
    const double       modulus = 3.;
    for (const auto &[kx, ky] : std::vector<std::pair<int, int>>{{1, 0}, {0, 2}, {2, -1}})
      {
        const double qx = 2 * pi * kx / grid.lx, qy = 2 * pi * ky / grid.ly;
        const auto   wave = [qx = qx, qy = qy](const double x, const double y) {
          return 5 + 2 * std::cos(qx * x + qy * y + 0.4);
        };
        const SlabField p = sampled(grid, wave);
        SlabField       u(p.layout_pointer()), expected(p.layout_pointer());
        for (std::size_t i = 0; i < u.size(); ++i)
          expected[i] = (p[i] - 5) * 2 / (std::hypot(qx, qy) * modulus);
        HalfSpaceProblem problem(p, modulus);
        const double     work = problem.apply(p.data(), u.data(), no_pass);

        double product = 0;
        for (std::size_t i = 0; i < u.size(); ++i)
          product += p[i] * u[i] / static_cast<double>(grid.n_points());
        EXPECT_LT(largest_difference(u, expected), 1e-14 * max_value(expected) * 10);
        EXPECT_NEAR(work, sum(MPI_COMM_WORLD, product), 1e-13 * work);
        EXPECT_EQ(problem.n_applications(), 1);
      }
  }

  INSTANTIATE_TEST_SUITE_P(Grids,
                           HalfSpaceOn,
                           testing::Values(PeriodicGrid{16, 16, 1., 1.},
                                           PeriodicGrid{12, 7, 3., 2.},
                                           PeriodicGrid{13, 11, 1e-6, 2e-6}));
} // namespace
