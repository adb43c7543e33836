// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/map_processing.h>

#include <gtest/gtest.h>

#include <cmath>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;

  /** height(x, y) at the points of a map on the unit square. */
  template <class Height>
  HeightMap
  sampled(const int nx, const int ny, const Height &height)
  {
    HeightMap map;
    map.nx   = nx;
    map.ny   = ny;
    map.size = {{1., 1.}};
    for (int iy = 0; iy < ny; ++iy)
      for (int ix = 0; ix < nx; ++ix)
        map.values.push_back(height(double(ix) / nx, double(iy) / ny));
    return map;
  }

  double
  largest(const std::vector<double> &values)
  {
    double result = 0;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  }

  TEST(MapUnits, ConvertedToTheScenes)
  {
    const auto convert =
      [](const LengthUnit &lateral, const LengthUnit &height, auto set) {
        HeightMap     map = sampled(2, 2, [](double, double) { return 3.; });
        MapParameters parameters;
        map.size         = {{2., 4.}};
        map.lateral_unit = lateral;
        map.height_unit  = height;
        set(parameters);
        convert_to_scene_units(map, parameters);
        return map;
      };
    const LengthUnit nothing, um{"um", 1e-6}, nm{"nm", 1e-9}, rad{"rad", {}};
    const auto       as_is = [](MapParameters &) {};
    const auto       in_mm = [](MapParameters &p) { p.length_in_metres = 1e-3; };

    EXPECT_DOUBLE_EQ(convert(um, nm, as_is).values[0], 3e-9);
    EXPECT_DOUBLE_EQ((*convert(um, nm, as_is).size)[1], 4e-6);
    EXPECT_DOUBLE_EQ(convert(um, nm, in_mm).values[0], 3e-6);
    EXPECT_DOUBLE_EQ((*convert(um, nm, in_mm).size)[1], 4e-3);
    EXPECT_DOUBLE_EQ(convert(nothing, nothing, in_mm).values[0], 3.);

    const auto refuse = [&](const LengthUnit &lateral, const LengthUnit &height) {
      return input_error([&]() { convert(lateral, height, as_is); });
    };
    EXPECT_TRUE(mentions(refuse(um, nothing), "set Surface/Height unit"));
    EXPECT_TRUE(mentions(refuse(nothing, nm), "set Surface/Lateral unit"));
    EXPECT_TRUE(mentions(refuse(um, rad), "'rad'"));
    EXPECT_DOUBLE_EQ(
      convert(um, rad, [](MapParameters &p) { p.height_unit = "63.1 nm"; }).values[0],
      3 * 63.1e-9);
    EXPECT_DOUBLE_EQ(convert(nothing,
                             nm,
                             [](MapParameters &p) {
                               p.lateral_unit     = "scene";
                               p.length_in_metres = 1e-3;
                             })
                       .size->at(0),
                     2.);
    // Which unit the scene's is must be known for heights that have one.
    EXPECT_TRUE(
      mentions(input_error([&]() {
                 convert(nothing, nm, [](MapParameters &p) { p.lateral_unit = "scene"; });
               }),
               "set Units/Length"));
    // A lateral unit is refused for a map without a size, unless there is a second map.
    const auto sizeless = [&](const std::string &second_file) {
      HeightMap     map = sampled(2, 2, [](double, double) { return 3.; });
      MapParameters parameters;
      map.size.reset();
      parameters.lateral_unit = "nm";
      parameters.second_file  = second_file;
      convert_to_scene_units(map, parameters);
    };
    EXPECT_TRUE(mentions(input_error([&]() { sizeless(""); }),
                         "states no size that Surface/Lateral unit"));
    EXPECT_NO_THROW(sizeless("other.nc"));
  }

  TEST(MapDetrend, RemovesWhatItSays)
  {
    const auto wave = [](double x, double) { return std::cos(2 * M_PI * x); };
    const auto bowl = [](double x, double y) {
      return 3 + 2 * x - y + x * y - 4 * y * y;
    };
    const auto tilt = [](double x, double y) { return 3 + 2 * x - y; };

    HeightMap curved = sampled(20, 30, bowl);
    detrend(curved, Detrend::tilt);
    EXPECT_GT(largest(curved.values), 0.1);
    detrend(curved, Detrend::curvature);
    EXPECT_LT(largest(curved.values), 1e-12);

    HeightMap tilted = sampled(20, 30, tilt);
    tilted.values[7] = NAN; // does not count
    detrend(tilted, Detrend::tilt);
    tilted.values[7] = 0;
    EXPECT_LT(largest(tilted.values), 1e-12);

    HeightMap level = sampled(20, 30, wave);
    for (double &value : level.values)
      value += 5;
    detrend(level, Detrend::mean);
    EXPECT_NEAR(level.values[0], 1., 1e-12);

    HeightMap row = sampled(20, 1, tilt); // y² and the like are not determined
    detrend(row, Detrend::curvature);
    EXPECT_LT(largest(row.values), 1e-12);
  }

  TEST(MapFill, IsHarmonic)
  {
    const auto harmonic = [](double x, double y) { return x * x - y * y + x - 100; };
    HeightMap  map      = sampled(40, 40, harmonic);
    const auto exact    = map.values;
    for (int iy = 5; iy < 25; ++iy)
      for (int ix = 10; ix < 30; ++ix)
        map.values[iy * 40 + ix] = NAN;
    Remarks remarks;
    EXPECT_TRUE(mentions(input_error([&]() { fill_missing_points(map, 0.2, remarks); }),
                         "lacks 400 of its points, a share of 0.25"));
    fill_missing_points(map, 0.25, remarks);
    ASSERT_EQ(remarks.notes.size(), 1U);
    for (std::size_t k = 0; k < exact.size(); ++k)
      EXPECT_NEAR(map.values[k], exact[k], 1e-8);
  }

  TEST(MapFill, IsHarmonicWhereSpacingsDiffer)
  {
    const auto harmonic = [](double x, double y) { return x * x - 4 * y * y + x; };
    HeightMap  map      = sampled(20, 20, harmonic);
    map.size            = {{20., 40.}};
    const auto exact    = map.values;
    for (int iy = 5; iy < 12; ++iy)
      for (int ix = 6; ix < 15; ++ix)
        map.values[iy * 20 + ix] = NAN;
    Remarks remarks;
    fill_missing_points(map, 0.25, remarks);
    for (std::size_t k = 0; k < exact.size(); ++k)
      EXPECT_NEAR(map.values[k], exact[k], 1e-7);
  }

  TEST(MapFill, WithoutFluxThroughTheEdges)
  {
    HeightMap map = sampled(8, 4, [](double, double y) { return y; });
    for (int iy = 0; iy < 4; ++iy)
      for (int ix = 4; ix < 8; ++ix)
        map.values[iy * 8 + ix] = NAN;
    for (int iy = 0; iy < 4; ++iy)
      map.values[iy * 8 + 3] = 7.;
    Remarks remarks;
    fill_missing_points(map, 0.5, remarks);
    for (int iy = 0; iy < 4; ++iy)
      EXPECT_NEAR(map.values[iy * 8 + 7], 7., 1e-8);
  }

  TEST(MapPeriodic, WindowMirrorAndWarning)
  {
    const auto    slope = [](double x, double y) { return x + 2 * y; };
    MapParameters parameters;
    Remarks       remarks;
    HeightMap     as_is = sampled(32, 32, slope);
    make_periodic(as_is, parameters, remarks);
    ASSERT_EQ(remarks.warnings.size(), 1U);
    EXPECT_TRUE(mentions(remarks.warnings[0], "steps at its seams"));

    HeightMap periodic   = sampled(32, 32, slope);
    periodic.is_periodic = true;
    make_periodic(periodic, parameters, remarks);
    EXPECT_EQ(remarks.warnings.size(), 1U);

    // A step at either seam counts, however short that seam is.
    HeightMap wall =
      sampled(256, 8, [](double x, double y) { return .1 * x + std::cos(2 * M_PI * y); });
    make_periodic(wall, parameters, remarks);
    ASSERT_EQ(remarks.warnings.size(), 2U);
    EXPECT_TRUE(mentions(remarks.warnings[1], "are 255 times"));
    remarks.warnings.pop_back();

    parameters.make_periodic = MakePeriodic::mirror;
    HeightMap mirrored       = sampled(3, 2, slope);
    mirrored.size            = {{1., 1.}};
    make_periodic(mirrored, parameters, remarks);
    EXPECT_EQ(mirrored.nx, 6);
    EXPECT_EQ(mirrored.ny, 4);
    EXPECT_EQ((*mirrored.size)[0], 2.);
    EXPECT_EQ(mirrored.values[0], mirrored.values[5]);
    EXPECT_TRUE(mentions(remarks.warnings[1], "as before"));
    EXPECT_EQ(mirrored.values[1], mirrored.values[3 * 6 + 4]);

    parameters.make_periodic = MakePeriodic::window;
    HeightMap windowed       = sampled(40, 40, slope);
    make_periodic(windowed, parameters, remarks);
    // At the edge, the mean of all samples is left.
    EXPECT_NEAR(windowed.values[20 * 40], 2 * 0.75 - 1.5 / 40, 0.05);
    EXPECT_EQ(windowed.values[20 * 40 + 20], slope(0.5, 0.5));
    ASSERT_EQ(remarks.warnings.size(), 3U);
    EXPECT_TRUE(mentions(remarks.warnings[2], "rms height"));
  }

  TEST(MapResample, ExactForResolvedWaves)
  {
    const auto wave = [](double x, double y) {
      return 2 + std::cos(2 * M_PI * (2 * x - 3 * y) + 0.3) + std::sin(2 * M_PI * x);
    };
    const PeriodicGrid coarse{10, 9, 2., 3.};
    const auto         map = sampled(10, 9, wave).values;
    for (const auto &n : {std::array<int, 2>{{16, 27}}, std::array<int, 2>{{7, 8}}})
      {
        const auto fine  = fourier_resample(map, coarse, {n[0], n[1], 2., 3.});
        const auto exact = sampled(n[0], n[1], wave).values;
        for (std::size_t k = 0; k < exact.size(); ++k)
          EXPECT_NEAR(fine.values[k], exact[k], 1e-12);
        EXPECT_NEAR(fine.kept_height, 1., 1e-12);
        EXPECT_NEAR(fine.kept_slope, 1., 1e-12);
      }
  }

  TEST(MapResample, PassesThroughThePointsOfAnEvenGrid)
  {
    // Alternating heights are the shortest wave that the grid can carry.
    const auto map =
      sampled(4, 6, [](double x, double y) { return std::lround(4 * x + 6 * y) % 2; });
    const auto fine = fourier_resample(map.values, {4, 6, 1., 1.}, {8, 12, 1., 1.});
    for (int iy = 0; iy < 6; ++iy)
      for (int ix = 0; ix < 4; ++ix)
        EXPECT_NEAR(fine.values[2 * iy * 8 + 2 * ix], map.values[iy * 4 + ix], 1e-12);
  }

  TEST(MapResample, BandsAndLosses)
  {
    const auto wave = [](double x, double y) {
      return 1 + 3 * std::cos(2 * M_PI * x) + 4 * std::cos(2 * M_PI * 6 * y);
    };
    const PeriodicGrid grid{16, 16, 1., 1.};
    const auto         map        = sampled(16, 16, wave).values;
    const auto         long_waves = fourier_resample(map, grid, grid, 0.5);
    EXPECT_NEAR(long_waves.values[0], 4., 1e-12);
    EXPECT_NEAR(long_waves.kept_height, 0.6, 1e-12);
    const auto short_waves = fourier_resample(map, grid, grid, 0., 0.5);
    EXPECT_NEAR(short_waves.values[0], 5., 1e-12);
    const auto on_coarse = fourier_resample(map, grid, {8, 8, 1., 1.});
    EXPECT_NEAR(on_coarse.values[0], 4., 1e-12);
    EXPECT_NEAR(on_coarse.kept_slope, 3 / std::hypot(3, 24), 1e-12);
  }
} // namespace
