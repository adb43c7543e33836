// SPDX-License-Identifier: GPL-2.0-or-later
// Laws of trapped fluid, and what becomes of regions that split, merge or reach a
// reservoir.
#include <strait/base/collective.h>
#include <strait/seal/regions_in_gap.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace strait
{
  namespace
  {
    FeedbackParameters
    law(const TrappedFluidLaw name, const double modulus = 0., const double slope = 0.)
    {
      FeedbackParameters parameters;
      parameters.trapped_fluid      = name;
      parameters.bulk_modulus       = modulus;
      parameters.bulk_modulus_slope = slope;
      return parameters;
    }

    TEST(TrappedFluid, PressureAndVolumeBelongTogether)
    {
      const TrappedRegion region{2., .5, .3};
      for (const FeedbackParameters &parameters :
           {law(TrappedFluidLaw::incompressible),
            law(TrappedFluidLaw::compressible, 3.),
            law(TrappedFluidLaw::compressible, 3., 7.),
            law(TrappedFluidLaw::gas)})
        for (const double volume : {1.5, 2., 2.04})
          {
            const double p = pressure_to_hold(parameters, region, volume, .5);
            EXPECT_NEAR(volume + region.compliance * (p - .5),
                        volume_at(parameters, region, p),
                        1e-12);
            EXPECT_EQ(volume == 2., std::abs(p - .5) < 1e-12);
          }
      // dV/dp = −V/B with B = B0 + B1 p.
      const FeedbackParameters stiff = law(TrappedFluidLaw::compressible, 3., 7.);
      const double             slope =
        (volume_at(stiff, region, .5 + 1e-6) - volume_at(stiff, region, .5 - 1e-6)) /
        2e-6;
      EXPECT_NEAR(slope, -2. / 6.5, 1e-8);
      EXPECT_EQ(volume_at(law(TrappedFluidLaw::gas), region, 1.), 1.);
    }

    TEST(TrappedFluid, FormsACavityOfVapour)
    {
      FeedbackParameters parameters = law(TrappedFluidLaw::incompressible);
      parameters.vapour_pressure    = .1;
      EXPECT_EQ(pressure_to_hold(parameters, {2., .5, .3}, 3., .5), .1);
      EXPECT_EQ(pressure_to_hold(law(TrappedFluidLaw::gas), {2., 0., .3}, 1., .5), 0.);
    }

    /** '#' closed, '2' a gap of 2, anything else one of 1; the first string is row 0. */
    SlabField
    draw(const std::vector<std::string> &rows)
    {
      const auto nx = static_cast<int>(rows[0].size()),
                 ny = static_cast<int>(rows.size());
      SlabField gap(
        make_layout({nx, ny, static_cast<double>(nx), static_cast<double>(ny)},
                    MPI_COMM_WORLD));
      for (int row = 0; row < gap.layout().n_rows(); ++row)
        for (int ix = 0; ix < nx; ++ix)
          {
            const char c = rows[gap.layout().first_row() + row][ix];
            gap(ix, row) = c == '#' ? 0. : c == '2' ? 2. : 1.;
          }
      return gap;
    }

    TrappedFluid
    nothing(const SlabField &gap)
    {
      TrappedFluid fluid;
      fluid.owner.assign(gap.size(), TrappedFluid::reservoirs);
      return fluid;
    }

    /** Settle the trapped fluid @p before in the gap @p rows, at @p pressures. */
    RegionsInGap::Settled
    settle(const TrappedFluid             &before,
           const std::vector<std::string> &rows,
           const std::vector<double>      &pressures,
           const FeedbackParameters       &parameters)
    {
      const SlabField    gap      = draw(rows);
      const Clusters     clusters = find_clusters(gap, FlowDirection::x, true);
      const RegionsInGap regions(before, gap, clusters);
      EXPECT_EQ(regions.volumes.size(), pressures.size());
      return regions.settle(parameters,
                            pressures,
                            1.,
                            before.regions.empty() ? nullptr : &gap);
    }

    // The inlet is to the left, the outlet to the right.
    const std::vector<std::string> apart =
      {"########", "##..#.##", "##..#2##", "##..#.##", "########", "########"};
    const std::vector<std::string> together =
      {"########", "##..#.##", "##...2##", "##..#.##", "########", "########"};
    const std::vector<std::string> parted =
      {"########", "##..#.##", "##..####", "##..#.##", "########", "########"};
    const std::vector<std::string> drained =
      {"########", "##..#.##", ".....2##", "##..#.##", "########", "########"};

    TEST(TrappedFluid, IsFoundOnAnyNumberOfRanks)
    {
      const auto settled = settle(nothing(draw(apart)),
                                  apart,
                                  {.3, .6},
                                  law(TrappedFluidLaw::incompressible));
      ASSERT_EQ(settled.fluid.regions.size(), 2U);
      EXPECT_FALSE(settled.has_changed);
      EXPECT_EQ(settled.fluid.regions[0].volume, 6.);
      EXPECT_EQ(settled.fluid.regions[1].volume, 4.);
      EXPECT_EQ(settled.fluid.regions[0].pressure, .3);
      EXPECT_EQ(settled.fluid.regions[1].pressure, .6);
      EXPECT_TRUE(settled.fluid.regions[1].is_guess);
      EXPECT_DOUBLE_EQ(settled.fluid.area, 9. / 48);
      EXPECT_DOUBLE_EQ(settled.fluid.guessed_area, 9. / 48);
      EXPECT_DOUBLE_EQ(settled.fluid.pressure, (6 * .3 + 3 * .6) / 9);
      // A slit of three points has an area A = 3 and a perimeter S = 8: 2.5 A²/S.
      EXPECT_DOUBLE_EQ(settled.fluid.regions[1].compliance, 2.5 * 9. / 8);
    }

    TEST(TrappedFluid, KeepsItsMassWhereRegionsMeetAndPart)
    {
      for (const TrappedFluidLaw name :
           {TrappedFluidLaw::incompressible, TrappedFluidLaw::gas})
        {
          const FeedbackParameters parameters = law(name);
          const TrappedFluid       two =
            settle(nothing(draw(apart)), apart, {.3, .6}, parameters).fluid;
          const auto one = settle(two, together, {.3, .6}, parameters);
          ASSERT_EQ(one.fluid.regions.size(), 1U);
          EXPECT_TRUE(one.has_changed);
          // The mass is the volume or, for a gas, pressure times volume.
          const double mass = name == TrappedFluidLaw::gas ? 6 * .3 + 4 * .6 : 10.;
          const TrappedRegion &region = one.fluid.regions[0];
          EXPECT_NEAR(volume_at(parameters, region, 1.), mass, 1e-12);
          EXPECT_FALSE(settle(two, together, {.45, .45}, parameters).has_changed);

          const auto again = settle(one.fluid, parted, {.4}, parameters);
          ASSERT_EQ(again.fluid.regions.size(), 3U);
          EXPECT_FALSE(again.has_changed);
          for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(volume_at(parameters, again.fluid.regions[i], 1.),
                        mass * (i == 0 ? 6 : 1) / 8,
                        1e-12);
        }
    }

    TEST(TrappedFluid, TakesInWhatIsCutOffTogetherWithIt)
    {
      const std::vector<std::string> fjord = {
        "########", "....#.##", "##..#2##", "##..#.##", "########", "########"};
      const std::vector<std::string> closed = {
        "########", "##....##", "##..#2##", "##..#.##", "########", "########"};
      for (const TrappedFluidLaw name :
           {TrappedFluidLaw::incompressible, TrappedFluidLaw::gas})
        {
          const FeedbackParameters parameters = law(name);
          const TrappedFluid       before =
            settle(nothing(draw(fjord)), fjord, {.6}, parameters).fluid;
          const auto after = settle(before, closed, {.6, .3}, parameters);
          ASSERT_EQ(after.fluid.regions.size(), 1U);
          EXPECT_TRUE(after.has_changed);
          const double mass = name == TrappedFluidLaw::gas ? 4 * .6 + 6 * .3 : 10.;
          EXPECT_NEAR(volume_at(parameters, after.fluid.regions[0], 1.), mass, 1e-12);
        }
    }

    TEST(TrappedFluid, IsForgottenWhereAReservoirReachesIt)
    {
      const FeedbackParameters parameters = law(TrappedFluidLaw::incompressible);
      const TrappedFluid       two =
        settle(nothing(draw(apart)), apart, {.3, .6}, parameters).fluid;
      const auto none = settle(two, drained, {.3, .6}, parameters);
      EXPECT_TRUE(none.has_changed);
      EXPECT_TRUE(none.fluid.regions.empty());
      // On the way to that state, both regions still exist.
      const SlabField    gap      = draw(drained);
      const Clusters     clusters = find_clusters(gap, FlowDirection::x, true);
      const RegionsInGap regions(two, gap, clusters);
      EXPECT_EQ(regions.volumes[0], 6.);
      EXPECT_EQ(regions.volumes[1], 4.);
    }

    TEST(TrappedFluid, RemembersWhereItWasPressedShut)
    {
      const FeedbackParameters parameters = law(TrappedFluidLaw::incompressible);
      const TrappedFluid       two =
        settle(nothing(draw(apart)), apart, {.3, .6}, parameters).fluid;
      const SlabField    gap      = draw(std::vector<std::string>(6, "########"));
      const Clusters     clusters = find_clusters(gap, FlowDirection::x, true);
      const RegionsInGap regions(two, gap, clusters);
      EXPECT_EQ(regions.volumes[1], 0.);
      double n_points = 0;
      for (std::size_t k = 0; k < gap.size(); ++k)
        n_points += regions.region_of_point[k] == 1 ? 1. : 0.;
      EXPECT_EQ(sum(MPI_COMM_WORLD, n_points), 3.);
      const TrappedFluid still = regions.settle(parameters, {.3, .6}, 1., &gap).fluid;
      ASSERT_EQ(still.regions.size(), 2U);
      EXPECT_EQ(still.regions[1].volume, 4.);
      EXPECT_EQ(still.owner, two.owner);
      EXPECT_GT(two.area, 0.);
      EXPECT_EQ(still.area, 0.); // no point is open
      EXPECT_EQ(still.guessed_area, 0.);
      EXPECT_EQ(still.pressure, 0.);
    }
  } // namespace
} // namespace strait
