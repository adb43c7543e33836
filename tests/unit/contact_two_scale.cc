// SPDX-License-Identifier: GPL-2.0-or-later
// The cheap approximations of stiffness and compliance that precondition the contact.
#include <strait/contact/pyramid_extension.h>
#include <strait/contact/two_scale_operator.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  constexpr double modulus = 3.;

  /** Apply the stiffness, the sum of both scales, with all points marked. The boxes get
   *  means of the points and give back by the adjoint. */
  SlabField
  stiffened(const SlabField &field)
  {
    PyramidExtension   extension(field.layout_pointer());
    TwoScaleOperator   stiffness = TwoScaleOperator::stiffness(field.layout_pointer(),
                                                             extension.finest().layout,
                                                             modulus);
    std::vector<float> values(field.begin(), field.end());
    std::vector<std::uint8_t> marks(values.size(), 1);
    extension.gather(values.data(), marks.data());
    extension.spread(values.data(), marks.data());
    stiffness.on_boxes(extension.finest().values.own.data());
    stiffness.on_points(values.data());
    extension.extend_adjoint(values.data(), marks.data());
    SlabField result(field.layout_pointer());
    std::copy(values.begin(), values.end(), result.begin());
    return result;
  }

  /** Apply M of GapProblem with no point closed, which is the compliance alone. */
  SlabField
  displaced(const SlabField &field)
  {
    GapProblem                problem(field, modulus, {});
    SlabField                 result = field;
    std::vector<std::uint8_t> closed(field.size());
    problem.precondition(result.data(), closed.data());
    return result;
  }

  /** Return the smallest and the largest of <w, A w>/(<w, w> @p expected(q)) for plane
   *  waves w from long to short, with the operator A = @p act and the wave number q. */
  template <class Act, class Expected>
  std::pair<double, double>
  range_over_waves(const PeriodicGrid &grid, const Act &act, const Expected &expected)
  {
    double smallest = INFINITY, largest = 0;
    for (const auto &[x, y] : std::vector<std::pair<double, double>>{{0., 0.},
                                                                     {0.06, 0.},
                                                                     {0., 0.06},
                                                                     {0.12, 0.06},
                                                                     {0.2, 0.},
                                                                     {0.25, 0.25},
                                                                     {0.4, 0.3},
                                                                     {0.5, 0.2},
                                                                     {0.5, 0.5},
                                                                     {0.7, 0.4},
                                                                     {1., 0.},
                                                                     {0., 1.},
                                                                     {1., 1.}})
      {
        const int       kx = static_cast<int>(x * grid.nx / 2);
        const int       ky = static_cast<int>(y * grid.ny / 2);
        const double    qx = 2 * pi * kx / grid.lx, qy = 2 * pi * ky / grid.ly;
        const SlabField wave =
          sampled(grid, [qx = qx, qy = qy](const double px, const double py) {
            return std::cos(qx * px + qy * py);
          });
        const double q     = kx + ky > 0 ? std::hypot(qx, qy) : // or the longest wave
                           2 * pi / std::max(grid.lx, grid.ly);
        const double ratio = dot(wave, act(wave)) / dot(wave, wave) / expected(q);
        smallest           = std::min(smallest, ratio);
        largest            = std::max(largest, ratio);
      }
    return {smallest, largest};
  }

  class TwoScaleOperatorOn : public testing::TestWithParam<PeriodicGrid>
  {
  };

  TEST_P(TwoScaleOperatorOn, IsSymmetric)
  {
    const SlabField a = any_field(GetParam(), 1.), b = any_field(GetParam(), 1.7);
    const SlabField Ka = stiffened(a), Kb = stiffened(b);
    EXPECT_NEAR(dot(a, Kb), dot(Ka, b), 1e-5 * std::sqrt(dot(a, Ka) * dot(b, Kb)));
  }

  TEST_P(TwoScaleOperatorOn, IsCloseToThatOfTheHalfSpaceForAllWaves)
  {
    const auto [smallest, largest] =
      range_over_waves(GetParam(), stiffened, [](const double q) {
        return modulus * q / 2;
      });
    EXPECT_GT(smallest, .8);
    EXPECT_LT(largest, 1.6);
  }

  TEST_P(TwoScaleOperatorOn, HasAComplianceThatIsCloseToThatOfTheHalfSpace)
  {
    const PeriodicGrid grid = GetParam();
    const SlabField    a = any_field(grid, 1.), b = any_field(grid, 1.7);
    const SlabField    Ma = displaced(a), Mb = displaced(b);
    EXPECT_NEAR(dot(a, Mb), dot(Ma, b), 1e-5 * std::sqrt(dot(a, Ma) * dot(b, Mb)));
    const auto [smallest, largest] =
      range_over_waves(grid, displaced, [](const double q) { return 2 / (modulus * q); });
    EXPECT_GT(smallest, .8);
    EXPECT_LT(largest, 1.25);
  }

  INSTANTIATE_TEST_SUITE_P(
    Grids,
    TwoScaleOperatorOn,
    testing::Values(PeriodicGrid{128, 128, 1., 1.}, // 3 ranks share some boxes
                    PeriodicGrid{64, 96, 2., 2.5},
                    PeriodicGrid{64, 96, 2., 2.},
                    PeriodicGrid{66, 70, 1., 1.},
                    PeriodicGrid{67, 71, 1., 1.}));

  TEST(TwoScaleOperator, IsTheSameOnAnyNumberOfRanks)
  {
    const PeriodicGrid grid  = {128, 132, 1., 1.};
    const SlabField    stiff = stiffened(any_field(grid, 1.));
    EXPECT_NEAR(dot(stiff, any_field(grid, 0.6)), 5131.967, 1e-2);
    EXPECT_NEAR(dot(stiff, stiff), 186292387., 2e2);
  }
} // namespace
