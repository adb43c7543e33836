// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/two_scale_preconditioner.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  SlabField
  preconditioned(SlabField field)
  {
    TwoScalePreconditioner preconditioner(field.layout_pointer());
    preconditioner.apply(field.data());
    return field;
  }

  class TwoScalePreconditionerOn : public testing::TestWithParam<PeriodicGrid>
  {
  };

  TEST_P(TwoScalePreconditionerOn, IsSymmetric)
  {
    const SlabField a = any_field(GetParam(), 1.), b = any_field(GetParam(), 1.7);
    const double    a_Mb = dot(a, preconditioned(b)), Ma_b = dot(preconditioned(a), b);
    EXPECT_NEAR(a_Mb, Ma_b, 1e-11 * std::sqrt(dot(a, a) * dot(b, b)));
  }

  TEST_P(TwoScalePreconditionerOn, IsCloseToTheWaveNumber)
  {
    // The Rayleigh quotient of a plane wave, over |q|, up to one common factor.
    const PeriodicGrid grid     = GetParam();
    double             smallest = INFINITY, largest = 0;
    for (const auto &[x, y] : std::vector<std::pair<double, double>>{{0.06, 0.},
                                                                     {0., 0.06},
                                                                     {0.12, 0.06},
                                                                     {0.25, 0.25},
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
        const double ratio =
          dot(wave, preconditioned(wave)) / dot(wave, wave) / std::hypot(qx, qy);
        smallest = std::min(smallest, ratio);
        largest  = std::max(largest, ratio);
      }
    EXPECT_GT(smallest, 0.);
    // The stencil alone is too stiff for the longest waves.
    const bool two_scales = grid.nx % 4 == 0 && grid.ny % 4 == 0;
    EXPECT_LT(largest / smallest, two_scales ? 1.6 : 2.5);
  }

  INSTANTIATE_TEST_SUITE_P(
    Grids,
    TwoScalePreconditionerOn,
    testing::Values(PeriodicGrid{128, 128, 1., 1.}, // on 3 ranks boxes are shared
                    PeriodicGrid{64, 96, 2., 2.},
                    PeriodicGrid{67, 71, 1., 1.}));

  TEST(TwoScalePreconditioner, IsTheSameOnAnyNumberOfRanks)
  {
    const PeriodicGrid grid   = {128, 132, 1., 1.};
    const SlabField    result = preconditioned(any_field(grid, 1.));
    const SlabField    weight = any_field(grid, 0.6);
    EXPECT_NEAR(dot(result, weight), 2.1733026008622525, 1e-9);
    EXPECT_NEAR(dot(result, result), 404.18404567616165, 1e-9);
  }
} // namespace
