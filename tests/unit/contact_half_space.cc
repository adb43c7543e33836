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
        const double     work = problem.apply(p.data(), u.data());

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

  /** A half-space in contact at patches of points, which are marked. */
  class OnContact
  {
  public:
    explicit OnContact(const PeriodicGrid &grid)
      : heights(make_layout(grid, MPI_COMM_WORLD))
      , problem(heights, 2.)
      , marks(heights.size())
    {
      const SlabField pattern = sampled(grid, [&](const double x, const double y) {
        const double a = 2 * pi * x / grid.lx, b = 2 * pi * y / grid.ly;
        return std::cos(3 * a + b) + std::cos(2 * b - a) + .7 * std::sin(7 * a - 5 * b);
      });
      for (std::size_t i = 0; i < marks.size(); ++i)
        marks[i] = pattern[i] > .3;
    }

    SlabField
    marked(SlabField field) const
    {
      for (std::size_t i = 0; i < field.size(); ++i)
        field[i] *= marks[i];
      return field;
    }

    SlabField
    preconditioned(const SlabField &field)
    {
      std::vector<float> values(field.begin(), field.end());
      problem.precondition(values.data(), marks.data());
      SlabField result(heights.layout_pointer());
      std::copy(values.begin(), values.end(), result.begin());
      return marked(result);
    }

    SlabField                 heights;
    HalfSpaceProblem          problem;
    std::vector<std::uint8_t> marks;
  };

  class PreconditionerOn : public testing::TestWithParam<PeriodicGrid>
  {
  };

  TEST_P(PreconditionerOn, ResemblesTheInverseOnTheContact)
  {
    const PeriodicGrid grid = GetParam();
    OnContact          contact(grid);
    const SlabField    a  = contact.marked(any_field(grid, 1.));
    const SlabField    b  = contact.marked(any_field(grid, 2.3));
    const SlabField    Ma = contact.preconditioned(a), Mb = contact.preconditioned(b);
    const double       aMa = dot(a, Ma), bMb = dot(b, Mb);
    EXPECT_GT(aMa, 0.);
    EXPECT_NEAR(dot(a, Mb), dot(b, Ma), 1e-6 * std::sqrt(aMa * bMb)); // single precision

    // M is close to the inverse of G for pressures of long and of short waves.
    for (const double waves : {.05, .3, 1., 4., 11.})
      {
        const SlabField p = contact.marked(any_field(grid, waves));
        SlabField       y(p.layout_pointer());
        contact.problem.apply(p.data(), y.data());
        y                  = contact.marked(y);
        const double ratio = dot(y, contact.preconditioned(y)) / dot(y, p);
        EXPECT_GT(ratio, .8);
        EXPECT_LT(ratio, 1.2);
      }
  }

  TEST_P(PreconditionerOn, ResemblesTheInverseOnTheOpenPoints)
  {
    const PeriodicGrid grid = GetParam();
    OnContact          contact(grid);
    GapProblem         problem(contact.heights, 2., {});
    const auto         open = [&](SlabField field) {
      for (std::size_t i = 0; i < field.size(); ++i)
        field[i] *= 1 - contact.marks[i];
      return field;
    };
    const auto preconditioned = [&](SlabField field) {
      problem.precondition(field.data(), contact.marks.data());
      return field;
    };
    const SlabField a = open(any_field(grid, 1.)), b = open(any_field(grid, 2.3));
    const SlabField Ma = preconditioned(a), Mb = preconditioned(b);
    const double    aMa = dot(a, Ma), bMb = dot(b, Mb);
    EXPECT_GT(aMa, 0.);
    EXPECT_NEAR(dot(a, Mb), dot(b, Ma), 1e-6 * std::sqrt(aMa * bMb));
    EXPECT_EQ(max_value(Ma), max_value(open(Ma)));

    // M is close to the inverse of K for gaps of long and of short waves.
    for (const double waves : {.05, .3, 1., 4., 11.})
      {
        const SlabField w = open(any_field(grid, waves));
        SlabField       r(w.layout_pointer());
        problem.apply(w.data(), r.data());
        r                  = open(r);
        const double ratio = dot(r, preconditioned(r)) / dot(r, w);
        EXPECT_GT(ratio, .8);
        EXPECT_LT(ratio, 1.2);
      }
  }

  INSTANTIATE_TEST_SUITE_P(Grids,
                           PreconditionerOn,
                           testing::Values(PeriodicGrid{64, 64, 1., 1.},
                                           PeriodicGrid{96, 40, 2., 1.},
                                           PeriodicGrid{81, 75, 1., 1.},
                                           PeriodicGrid{84, 76, 1., 1.},
                                           PeriodicGrid{128, 32, 2., 1.}));
} // namespace
