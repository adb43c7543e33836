// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/formats.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

// Files as instruments and other programs write them. They are not part of the
// project: STRAIT_SHARED_DATA names the folder that has them.

namespace
{
  using namespace strait;

  class RealFiles : public testing::Test
  {
  protected:
    void
    SetUp() override
    {
      const char *named =
        std::getenv("STRAIT_SHARED_DATA"); // NOLINT(concurrency-mt-unsafe)
      if (named == nullptr || !std::filesystem::exists(named))
        GTEST_SKIP() << "set STRAIT_SHARED_DATA to the folder of the measured files";
      folder = named;
    }

    HeightMap
    read(const std::string &name) const
    {
      return read_height_map({folder + "/" + name});
    }

    std::string folder;
  };

  TEST_F(RealFiles, Interferometer)
  {
    const auto map = read("interferometer_650.txt");
    EXPECT_EQ(map.nx, 650);
    EXPECT_EQ(map.ny, 650);
    EXPECT_EQ(map.n_missing(), 0U);
    EXPECT_NEAR((*map.size)[0], 650 * 3.69862e-7, 1e-12);
    EXPECT_NEAR(map.height_unit.metres.value(), 6.30079e-8, 1e-14);
    EXPECT_DOUBLE_EQ(map.values[0], -3.564394);
  }

  TEST_F(RealFiles, Gwyddion)
  {
    const auto map = read("gwyddion_header.txt");
    EXPECT_EQ(map.nx, 3);
    EXPECT_EQ(map.ny, 4);
    EXPECT_NEAR((*map.size)[0], 12.34e-6, 1e-15);
    EXPECT_NEAR((*map.size)[1], 5678.9e-9, 1e-15);
    EXPECT_EQ(map.values[5], -6.);
  }

  TEST_F(RealFiles, ContactEngineering)
  {
    const auto map = read("surface.nc");
    EXPECT_EQ(map.nx, 5);
    EXPECT_EQ(map.ny, 10);
    EXPECT_EQ((*map.size)[1], 10.);
    EXPECT_DOUBLE_EQ(map.lateral_unit.metres.value(), 1e-9);
    EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-9);
    EXPECT_FALSE(map.is_periodic);
    for (int ix = 0; ix < 5; ++ix)
      EXPECT_EQ(map.values[9 * 5 + ix], -map.values[ix]);
  }
} // namespace
