// SPDX-License-Identifier: GPL-2.0-or-later
// The cheap stand-ins for stiffness and compliance by which contact is preconditioned.
#include <strait/contact/two_scale_operator.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  constexpr double modulus = 3., uniform = .7;

  SlabField
  applied(TwoScaleOperator to_field, SlabField field)
  {
    to_field.apply(
      field.data(), [](int) {}, [](int) {});
    return field;
  }

  SlabField
  stiffened(const SlabField &field)
  {
    return applied(TwoScaleOperator::stiffness(field.layout_pointer(), modulus), field);
  }

  SlabField
  displaced(const SlabField &field)
  {
    return applied(TwoScaleOperator::compliance(field.layout_pointer(), modulus, uniform),
                   field);
  }

  /** The Rayleigh quotients of plane waves from long to short, times |q|^@p power: the
   *  smallest and the largest. */
  template <class Operator>
  std::pair<double, double>
  range_over(const PeriodicGrid &grid, const Operator &to_field, const double power)
  {
    double smallest = INFINITY, largest = 0;
    for (const auto &[x, y] : std::vector<std::pair<double, double>>{{0.06, 0.},
                                                                     {0., 0.06},
                                                                     {0.12, 0.06},
                                                                     {0.2, 0.},
                                                                     {0.25, 0.25},
                                                                     {0.4, 0.3},
                                                                     {0.5, 0.2},
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
        const double ratio = dot(wave, to_field(wave)) / dot(wave, wave) *
                             std::pow(std::hypot(qx, qy), power);
        smallest = std::min(smallest, ratio);
        largest  = std::max(largest, ratio);
      }
    return {smallest, largest};
  }

  class TwoScaleOperatorOn : public testing::TestWithParam<PeriodicGrid>
  {
  };

  TEST_P(TwoScaleOperatorOn, IsSymmetric)
  {
    const SlabField a = any_field(GetParam(), 1.), b = any_field(GetParam(), 1.7);
    const double    bound = 1e-11 * std::sqrt(dot(a, a) * dot(b, b));
    EXPECT_NEAR(dot(a, stiffened(b)), dot(stiffened(a), b), bound);
    EXPECT_NEAR(dot(a, displaced(b)), dot(displaced(a), b), bound);
  }

  TEST_P(TwoScaleOperatorOn, IsCloseToTheWaveNumber)
  {
    const PeriodicGrid grid        = GetParam();
    const auto [smallest, largest] = range_over(grid, stiffened, -1);
    EXPECT_GT(smallest, 0.);
    // The stencil alone is too stiff for the longest waves.
    const bool two_scales = grid.nx % 4 == 0 && grid.ny % 4 == 0;
    EXPECT_LT(largest / smallest, two_scales ? 1.6 : 2.5);
  }

  TEST_P(TwoScaleOperatorOn, IsCloseToTheComplianceOfTheHalfSpace)
  {
    const PeriodicGrid grid = GetParam();
    if (!TwoScaleOperator::suits_compliance(grid))
      return;
    const auto [smallest, largest] = range_over(grid, displaced, 1);
    EXPECT_GT(smallest * modulus / 2, .7);
    EXPECT_LT(largest * modulus / 2, 1.15);
    const SlabField result = displaced(SlabField(make_layout(grid, MPI_COMM_WORLD), 1.));
    EXPECT_NEAR(min_value(result), uniform, 1e-12);
    EXPECT_NEAR(max_value(result), uniform, 1e-12);
  }

  INSTANTIATE_TEST_SUITE_P(
    Grids,
    TwoScaleOperatorOn,
    testing::Values(PeriodicGrid{128, 128, 1., 1.}, // on 3 ranks boxes are shared
                    PeriodicGrid{64, 96, 2., 2.5},
                    PeriodicGrid{64, 96, 2., 2.},
                    PeriodicGrid{67, 71, 1., 1.}));

  TEST(TwoScaleOperator, IsTheSameOnAnyNumberOfRanks)
  {
    const PeriodicGrid grid  = {128, 132, 1., 1.};
    const SlabField    field = any_field(grid, 1.), weight = any_field(grid, 0.6);
    const SlabField    stiff = stiffened(field), soft = displaced(field);
    EXPECT_NEAR(dot(stiff, weight), 4826.5356594051809, 1e-6);
    EXPECT_NEAR(dot(stiff, stiff), 151684144.48091412, 1e-3);
    EXPECT_NEAR(dot(soft, weight), 269.41066781912889, 1e-9);
    EXPECT_NEAR(dot(soft, soft), 183.95984182057583, 1e-9);
  }

  TEST(TwoScaleOperator, SuitsAComplianceOnGridsThatCanBeCoarsened)
  {
    EXPECT_TRUE(TwoScaleOperator::suits_compliance({32, 64, 1., 2.}));
    EXPECT_FALSE(
      TwoScaleOperator::suits_compliance({32, 64, 1., 1.})); // spaced unequally
    EXPECT_FALSE(TwoScaleOperator::suits_compliance({66, 64, 1., 1.}));
    EXPECT_FALSE(TwoScaleOperator::suits_compliance({16, 16, 1., 1.}));
  }
} // namespace
