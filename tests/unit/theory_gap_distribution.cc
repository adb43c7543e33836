// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/spectral/slab_field.h>
#include <strait/theory/gap_distribution.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace strait;

  SlabField
  ramp(const int nx, const int ny)
  {
    // A quarter in contact, the rest uniform between 0 and 3.
    return sample(make_layout({nx, ny, 4., 1.}, MPI_COMM_WORLD),
                  [](const double x, double) { return x < 1 ? 0. : x - 1; });
  }

  TEST(GapHistogram, OfAUniformDistribution)
  {
    const GapDistribution gaps = gap_histogram(ramp(4000, 5), {0., .5, 1., 2., 4.});
    EXPECT_NEAR(gaps.contact_area, .25, 1e-3);
    EXPECT_NEAR(gaps.fractions[0], .125, 5e-4);
    EXPECT_NEAR(gaps.fractions[1], .125, 5e-4);
    EXPECT_NEAR(gaps.fractions[2], .25, 1e-3);
    EXPECT_NEAR(gaps.fractions[3], .25, 2e-3);
    EXPECT_NEAR(gaps.gaps[2], 1.5, 1e-3);
    EXPECT_NEAR(gaps.gaps[3], 2.5, 1e-3);
  }

  TEST(GapHistogram, CountsEveryPointOnce)
  {
    const SlabField gap = ramp(37, 4);
    for (const std::vector<double> &edges :
         {std::vector<double>{0., .7, 1.}, gap_bins(1e-3, 3., 10)})
      {
        const GapDistribution gaps = gap_histogram(gap, edges);
        double                sum = gaps.contact_area, mean_gap = 0;
        for (std::size_t k = 0; k < gaps.gaps.size(); ++k)
          {
            sum += gaps.fractions[k];
            mean_gap += gaps.fractions[k] * gaps.gaps[k];
          }
        EXPECT_NEAR(sum, 1., 1e-14);
        EXPECT_NEAR(mean_gap, mean(gap), 1e-13);
      }
  }

  TEST(GapHistogram, OfTwoFlatPlates)
  {
    const SlabField       gap(make_layout({8, 4, 1., 1.}, MPI_COMM_WORLD), .3);
    const GapDistribution gaps = gap_histogram(gap, 6, 10);
    EXPECT_EQ(gaps.contact_area, 0.);
    EXPECT_NEAR(gaps.fractions.back(), 1., 1e-15);
    EXPECT_NEAR(gaps.gaps.back(), .3, 1e-15);
    const SlabField closed(make_layout({8, 4, 1., 1.}, MPI_COMM_WORLD), 0.);
    EXPECT_EQ(gap_histogram(closed, 6, 10).contact_area, 1.);
  }

  TEST(GapHistogram, BinsReachTheLargest)
  {
    const std::vector<double> edges = gap_bins(1e-3, .25, 7);
    EXPECT_EQ(edges[0], 0.);
    EXPECT_EQ(edges[1], 1e-3);
    EXPECT_GE(edges.back(), .25);
    EXPECT_LT(edges[edges.size() - 2], .25);
    EXPECT_NEAR(edges[9] / edges[2], 10., 1e-12);
  }

  TEST(GapHistogram, ClosedGapsAreContact)
  {
    const SlabField       gap  = ramp(4000, 5);
    const GapDistribution gaps = gap_histogram(gap, {0., .5, 1., 2.}, 1.);
    EXPECT_NEAR(gaps.contact_area, .5, 1e-3);
    EXPECT_NEAR(gaps.fractions[0], .125, 5e-4);
    EXPECT_NEAR(gaps.fractions[1], .125, 5e-4);
    EXPECT_NEAR(gaps.fractions[2], .25, 1e-3);
    EXPECT_NEAR(gaps.gaps[0], .25, 1e-3);
    EXPECT_NEAR(gaps.gaps[2], 1.5, 1e-3);
    EXPECT_EQ(gap_histogram(gap, 6, 10, 3.).contact_area, 1.);
  }
} // namespace
