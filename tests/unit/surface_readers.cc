// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::bytes;
  using test::complaint_of_map;
  using test::dictionary;
  using test::input_error;
  using test::mentions;
  using test::npy;
  using test::read_map;
  using test::TemporaryFile;

  void
  expect_map(const HeightMap           &map,
             const int                  nx,
             const int                  ny,
             const std::vector<double> &values)
  {
    EXPECT_EQ(map.nx, nx);
    EXPECT_EQ(map.ny, ny);
    ASSERT_EQ(map.values.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_DOUBLE_EQ(map.values[i], values[i]);
  }

  const std::vector<double> six = {1.5, -2, 3e-7, 4, 5, 6};

  TEST(NpyReader, VersionsAndOrders)
  {
    for (const int version : {1, 2, 3})
      expect_map(read_map(npy(dictionary("<f8", "(2, 3)"), bytes(six), version)),
                 3,
                 2,
                 six);
    expect_map(read_map(npy(dictionary("<f8", "(2, 3)", "True"), bytes(six))),
               3,
               2,
               {1.5, 3e-7, 5, -2, 4, 6});
    EXPECT_FALSE(read_map(npy(dictionary("<f8", "(2, 3)"), bytes(six))).size);
  }

  TEST(NpyReader, Types)
  {
    const std::vector<double> expected = {-1, 2, -300, 4};
    const auto read_as = [](const std::string &type, const std::string &data) {
      return read_map(npy(dictionary(type, "(2, 2)"), data));
    };
    expect_map(read_as("<f4", bytes<float>({-1, 2, -300, 4})), 2, 2, expected);
    expect_map(read_as("<i2", bytes<std::int16_t>({-1, 2, -300, 4})), 2, 2, expected);
    expect_map(read_as("<i4", bytes<std::int32_t>({-1, 2, -300, 4})), 2, 2, expected);
    expect_map(read_as("<i8", bytes<std::int64_t>({-1, 2, -300, 4})), 2, 2, expected);
  }

  TEST(NpyReader, BadFiles)
  {
    const std::string data = bytes(six);
    EXPECT_TRUE(
      mentions(complaint_of_map(npy(dictionary(">f8", "(2, 3)"), data)), "'>f8'"));
    EXPECT_TRUE(
      mentions(complaint_of_map(npy(dictionary("<c16", "(1, 3)"), data)), "'<c16'"));
    EXPECT_TRUE(mentions(complaint_of_map(
                           npy("{'descr': [('h', '<f8')], 'shape': (2, 3), }", data)),
                         "no single data type"));
    EXPECT_TRUE(mentions(complaint_of_map(npy(dictionary("<f8", "(6,)"), data)),
                         "two-dimensional"));
    EXPECT_TRUE(mentions(complaint_of_map(npy(dictionary("<f8", "(1, 2, 3)"), data)),
                         "two-dimensional"));
    EXPECT_TRUE(mentions(complaint_of_map(npy(dictionary("<f8", "(0, 3)"), "")),
                         "must lie between"));
    EXPECT_TRUE(
      mentions(complaint_of_map(npy(dictionary("<f8", "(2, 3)"), data.substr(8))),
               "promises 3 x 2 points and is too short"));
    EXPECT_TRUE(mentions(complaint_of_map(npy(dictionary("<f8", "(2, 3)"), data + data)),
                         "holds more"));
    EXPECT_TRUE(
      mentions(complaint_of_map(npy(dictionary("<f8", "(2000000000, 2000000000)"), data)),
               "must lie between"));
    EXPECT_TRUE(mentions(complaint_of_map(
                           npy(dictionary("<f8", "(99999999999999999999, 3)"), data)),
                         "must lie between"));
    const std::string whole = npy(dictionary("<f8", "(2, 3)"), data);
    EXPECT_TRUE(mentions(complaint_of_map(whole.substr(0, 40)), "within its header"));
    EXPECT_TRUE(mentions(complaint_of_map(whole.substr(0, 9)), "within its header"));
    EXPECT_TRUE(
      mentions(complaint_of_map(npy(dictionary("<f8", "(2, 3)"), data, 7)), "version"));
    // On this header, a regular expression would run out of stack.
    EXPECT_TRUE(
      mentions(complaint_of_map(npy("{'descr': '" + std::string(400000, '<'), data, 2)),
               "too long a header"));
  }

  TEST(NpyReader, NaNIsMissingAndInfinityIsBad)
  {
    auto values = six;
    values[4]   = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(read_map(npy(dictionary("<f8", "(2, 3)"), bytes(values))).n_missing(), 1U);
    values[4] = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(
      mentions(complaint_of_map(npy(dictionary("<f8", "(2, 3)"), bytes(values))),
               "row 1, column 1"));
    values.assign(6, std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(
      mentions(complaint_of_map(npy(dictionary("<f8", "(2, 3)"), bytes(values))),
               "no valid point"));
  }

  const std::string header = "# Width: 3\n# Height: 2\n";

  TEST(MatrixTextReader, Lines)
  {
    const std::vector<double> expected = {1, -2.5, 3e-7, 4, 5, 6};
    for (const std::string text : {"1 -2.5 3e-7\n4 5 6\n",
                                   "  1\t-2.5  3E-07 \r\n 4 +5 6",
                                   "# by hand\n\n1 -2.5 .3e-6\n4 5 6.\n\n\n"})
      expect_map(read_map(header + text), 3, 2, expected);
    EXPECT_EQ(read_map(header + "1 nan\nNaN 4\n").n_missing(), 2U);
  }

  TEST(MatrixTextReader, Units)
  {
    for (const std::string micro : {"\xc2\xb5", "\xb5", "\xce\xbc", "u"})
      {
        const auto map = read_map("# Channel: Topography\n# Width: 12.34 " + micro +
                                  "m\n# Height: 5678.9 nm\n# Value units: " + micro +
                                  "m\n1 1.5\n-2 0\n");
        expect_map(map, 2, 2, {1, 1.5, -2, 0});
        EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-6);
        EXPECT_DOUBLE_EQ(map.lateral_unit.metres.value(), 1e-6);
        ASSERT_TRUE(map.size);
        EXPECT_DOUBLE_EQ((*map.size)[0], 12.34);
        EXPECT_DOUBLE_EQ((*map.size)[1], 5.6789);
      }
    const auto plain = read_map(header + "1 2\n3 4\n");
    EXPECT_TRUE(plain.lateral_unit.name.empty());
    EXPECT_TRUE(plain.height_unit.name.empty());
    EXPECT_EQ((*plain.size)[0], 3.);
    EXPECT_EQ(read_map(header + "# Value units: rad\n1 2\n3 4\n").height_unit.name,
              "rad");
  }

  TEST(MatrixTextReader, WhatElseIsTextIsImported)
  {
    for (const std::string &text : std::vector<std::string>{
           "1 2\n3 4\n",                            // no size
           "# Breite: 3\n" + header + "1 2\n3 4\n", // another language
           "h=2 w=2\npixel size=1 um\n1 2\n3 4\n",  // an interferometer's
           header + "x y z\n1 2\n3 4\n",            // names of columns
           header + "# NODATA_value -9999\n1 2\n3 4\n",
           header + "# z scale = 2\n1 2\n3 4\n",
           header + "1,2\n3,4\n", // another separator
           header + "1;2\n3;4\n",
           header + "1 2\n3 4,5\n", // decimal commas
           header + "1 2\n3 bad\n",
           header + "1 2\n3 5.5.5\n",
           header + "1 2\n3 4\n\n5 6\n7 8\n", // a second channel
           header + "1 2\n3 4\n# Channel: error\n5 6\n7 8\n",
           "# Width: 3 furlong\n# Height: 2 m\n1 2\n",
           "# Width: 3 m\n# Height: 2\n1 2\n",
           "# Width: -3 m\n# Height: 2 m\n1 2\n",
           "# Width: 3,5 m\n# Height: 2 m\n1 2\n",
           "# Width: wide\n# Height: 2 m\n1 2\n",
           std::string(100000, 'x')})
      EXPECT_TRUE(mentions(complaint_of_map(text), "strait_import"))
        << text.substr(0, 100);
  }

  TEST(MatrixTextReader, HeaderThatContradictsItself)
  {
    const auto complaint = [](const std::string &line) {
      return complaint_of_map(
        "# Channel: Z\n# Width: 64 um\n# Height: 2 um\n"
        "# Value units: nm\n" +
        line + "\n1 2\n3 4\n");
    };
    EXPECT_TRUE(mentions(complaint("# Width: 32 um"),
                         "states 'Width' in its header as '64 um' and as '32 um': "
                         "remove one of these lines."));
    EXPECT_TRUE(mentions(complaint("#Height:2 mm"), "'Height'"));
    EXPECT_TRUE(mentions(complaint("# Value units: um"), "'Value units'"));
    EXPECT_TRUE(mentions(complaint("# Channel: error"), "'Channel'"));
    // Neither a line that is repeated word for word nor a byte order mark contradicts
    // anything.
    EXPECT_EQ((*read_map("\xef\xbb\xbf" + header + "1 2\n3 4\n").size)[0], 3.);
    EXPECT_EQ((*read_map(header + header + "1 2\n3 4\n").size)[0], 3.);
  }

  TEST(MatrixTextReader, BadFiles)
  {
    EXPECT_TRUE(
      mentions(complaint_of_map(header + "1 2 3\n4 5\n"), "2 values in line 4 and 3"));
    EXPECT_TRUE(
      mentions(complaint_of_map(header + "1 2\n4 5 6\n"), "3 values in line 4 and 2"));
    EXPECT_TRUE(mentions(complaint_of_map(header + "1 2\n-inf 4\n"), "row 1, column 0"));
    EXPECT_TRUE(mentions(complaint_of_map(header + "1 2\n3 1e200\n"),
                         "a value above 1e30 in row 1, column 1"));
    EXPECT_EQ(read_map(header + "# exported by hand\n1 2\n3 4\n").ny, 2);
    EXPECT_TRUE(mentions(complaint_of_map(header), "holds no numbers"));
    EXPECT_TRUE(mentions(complaint_of_map(""), "is empty"));
  }

  TEST(HeightMap, FilesOfOtherKinds)
  {
    for (const std::string &start :
         std::vector<std::string>{std::string("\x89HDF\r\n\x1a\n\0", 9),
                                  std::string("PK\x03\x04\0", 5),
                                  std::string("CDF\x05\0", 5),
                                  std::string("MZ\0\1", 4)})
      EXPECT_TRUE(mentions(complaint_of_map(start), "strait_import"));
    EXPECT_TRUE(mentions(input_error([]() { read_height_map("/no/such.npy"); }),
                         "'/no/such.npy' does not exist"));
    EXPECT_TRUE(mentions(input_error([]() { read_height_map("/"); }), "is not a file"));
  }

  TEST(HeightMap, CommandOfTheImport)
  {
    const std::string said = input_error([]() {
      reject_for_import("/maps/my map.opd", "is no map that strait reads itself");
    });
    EXPECT_TRUE(
      mentions(said, "strait_import '/maps/my map.opd' -o '/maps/my map.nc'\""));
    EXPECT_TRUE(mentions(said, "set Surface/File = /maps/my map.nc"));
    // The map must not overwrite the file.
    EXPECT_TRUE(mentions(input_error([]() { reject_for_import("/m.nc", "is none"); }),
                         "/m.nc -o /m.map.nc\""));
  }
} // namespace
