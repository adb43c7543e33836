// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/formats.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;
  using test::TemporaryFile;

  HeightMap
  read(const std::string &content, const MapFormat format)
  {
    return read_height_map({TemporaryFile(content).path, format, ""});
  }

  std::string
  complaint(const std::string &content, const MapFormat format)
  {
    const TemporaryFile file(content);
    return input_error([&]() { read_height_map({file.path, format, ""}); });
  }

  constexpr auto xyz = MapFormat::xyz;
  constexpr auto any = MapFormat::by_content;

  TEST(XyzReader, AnyOrderAndMissingPoints)
  {
    const auto map = read(
      "xy unit: um\nz unit: nm\n0 0 1\n2 0.5 6\n1 0 2\n2 0 3\n0 0.5 4\n"
      "1 .5 No Data\n",
      xyz);
    EXPECT_EQ(map.nx, 3);
    EXPECT_EQ(map.ny, 2);
    EXPECT_EQ(map.n_missing(), 1U);
    EXPECT_TRUE(std::isnan(map.values[4]));
    EXPECT_EQ(map.values[0] + map.values[1] + map.values[2] + map.values[3] +
                map.values[5],
              16.);
    ASSERT_TRUE(map.size);
    EXPECT_DOUBLE_EQ((*map.size)[0], 3.);
    EXPECT_DOUBLE_EQ((*map.size)[1], 1.);
    EXPECT_DOUBLE_EQ(map.lateral_unit.metres.value(), 1e-6);
    EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-9);
  }

  TEST(XyzReader, AbsentLinesAreMissing)
  {
    const auto map = read("0;0;1,5\n1;0;2\n3;0;3\n0;1;4\n1;1;5\n2;1;6\n3;1;7\n", xyz);
    EXPECT_EQ(map.nx, 4);
    EXPECT_EQ(map.n_missing(), 1U);
    EXPECT_DOUBLE_EQ(map.values[0], 1.5);
    EXPECT_TRUE(std::isnan(map.values[2]));
  }

  TEST(XyzReader, BadFiles)
  {
    EXPECT_TRUE(mentions(complaint("0 0 1\n1 0 2\n0 1\n", xyz), "x, y, z in line 3"));
    EXPECT_TRUE(mentions(complaint("0 0 1\n1 0 2\n0 0 3\n1 1 4\n", xyz), "twice"));
    EXPECT_TRUE(mentions(complaint("0 0 1\n1 0 2\n2 0 3\n", xyz), "one y only"));
    EXPECT_TRUE(
      mentions(complaint("0 0 1\n1 0 2\n2.4 1 3\n0 1 1\n", xyz), "regular grid"));
    EXPECT_TRUE(mentions(complaint("0 0 1\n1e-9 0 2\n1 1 1\n2 2 3\n", xyz), "grid"));
    EXPECT_TRUE(
      mentions(complaint("0 0 nan\n1 0 nan\n0 1 nan\n1 1 nan\n", xyz), "no valid point"));
    EXPECT_TRUE(mentions(complaint("no points\n", xyz), "holds no numbers"));
    EXPECT_TRUE(mentions(complaint("", xyz), "is empty"));
  }

  std::string
  ascii_sdf(const std::string &counts, const std::string &numbers)
  {
    return "aISO-1.0\nManufacID = test\nCreateDate = 010120260000\n" + counts +
           "Xscale = 1e-6\nYscale = 2e-6\nZscale = 1e-9\nZresolution = -1\n"
           "Compression = 0\nDataType = 7\nCheckType = 0\n*\n" +
           numbers;
  }

  TEST(SdfReader, Ascii)
  {
    const auto map = read(ascii_sdf("NumPoints = 3\nNumProfiles = 2\n",
                                    "1 2 BAD\n-4.5 5 6\n*\nremarks\n*\n"),
                          any);
    EXPECT_EQ(map.nx, 3);
    EXPECT_EQ(map.ny, 2);
    EXPECT_DOUBLE_EQ(map.values[3], -4.5e-9);
    EXPECT_TRUE(std::isnan(map.values[2]));
    EXPECT_DOUBLE_EQ((*map.size)[0], 3e-6);
    EXPECT_DOUBLE_EQ((*map.size)[1], 4e-6);
    EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1.);
  }

  TEST(SdfReader, BadAsciiFiles)
  {
    const std::string counts = "NumPoints = 3\nNumProfiles = 2\n";
    EXPECT_TRUE(mentions(complaint(ascii_sdf(counts, "1 2 3\n4 5\n*\n"), any),
                         "promises 6 values and holds 5"));
    EXPECT_TRUE(mentions(complaint(ascii_sdf(counts, "1 2 3\n4 x 6\n"), any), "'x'"));
    EXPECT_TRUE(mentions(complaint(ascii_sdf("", "1 2 3\n"), any), "'NumPoints'"));
    EXPECT_TRUE(mentions(
      complaint(ascii_sdf("NumPoints = 60000\nNumProfiles = 60000\n", "1 2\n"), any),
      "too short"));
    EXPECT_TRUE(
      mentions(complaint(ascii_sdf("NumPoints = 1e12\nNumProfiles = 1\n", "1 2\n"), any),
               "between 1 and"));
    EXPECT_TRUE(
      mentions(complaint("aISO-1.0\nNumPoints = 3\n", any), "within its header"));
    EXPECT_TRUE(mentions(complaint(ascii_sdf(counts, "BAD BAD BAD\nBAD BAD BAD\n"), any),
                         "no valid point"));
  }

  template <class Number>
  void
  append(std::string &bytes, const Number value)
  {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  }

  template <class Number>
  std::string
  binary_sdf(const int                  type,
             const std::vector<Number> &numbers,
             const std::uint16_t        nx          = 3,
             const int                  compression = 0)
  {
    std::string file = "bISO-1.0test      010120260000010120260000";
    append(file, nx);
    append(file, std::uint16_t(2));
    for (const double scale : {1e-6, 2e-6, 1e-9, -1.})
      append(file, scale);
    file += static_cast<char>(compression);
    file += static_cast<char>(type);
    file += '\0';
    for (const Number number : numbers)
      append(file, number);
    return file;
  }

  TEST(SdfReader, BinaryTypes)
  {
    const auto expect = [](const std::string &file) {
      const auto map = read(file, any);
      EXPECT_EQ(map.nx, 3);
      EXPECT_EQ(map.n_missing(), 1U);
      EXPECT_TRUE(std::isnan(map.values[1]));
      EXPECT_DOUBLE_EQ(map.values[5], 6e-9);
    };
    expect(binary_sdf<std::uint16_t>(1, {1, 65535, 3, 4, 5, 6}));
    expect(binary_sdf<float>(3, {1, NAN, 3, 4, 5, 6}));
    expect(binary_sdf<std::int16_t>(5, {1, -32768, 3, 4, 5, 6}));
    expect(binary_sdf<std::int32_t>(6, {1, INT32_MIN, 3, 4, 5, 6}));
    expect(binary_sdf<double>(7, {1, NAN, 3, 4, 5, 6}));
  }

  TEST(SdfReader, BadBinaryFiles)
  {
    const std::vector<double> six   = {1, 2, 3, 4, 5, 6};
    const std::string         whole = binary_sdf(7, six);
    EXPECT_TRUE(mentions(complaint(whole.substr(0, whole.size() - 1), any), "too short"));
    EXPECT_TRUE(mentions(complaint(whole.substr(0, 50), any), "within its header"));
    EXPECT_TRUE(mentions(complaint(binary_sdf(7, six, 60000), any), "too short"));
    EXPECT_TRUE(mentions(complaint(binary_sdf(7, six, 0), any), "0 x 2 points"));
    EXPECT_TRUE(mentions(complaint(binary_sdf(9, six), any), "unknown type 9"));
    EXPECT_TRUE(mentions(complaint(binary_sdf(7, six, 3, 1), any), "compressed"));
  }
} // namespace
