// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/formats.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;
  using test::TemporaryFile;

  HeightMap
  read(const std::string &content)
  {
    return read_height_map({TemporaryFile(content).path});
  }

  std::string
  complaint(const std::string &content)
  {
    const TemporaryFile file(content);
    return input_error([&]() { read_height_map({file.path}); });
  }

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

  /** A .npy file around @p data, of any version. */
  std::string
  npy(const std::string &dictionary, const std::string &data, const int version = 1)
  {
    const std::string header = dictionary + std::string(20, ' ') + "\n";
    std::string       file   = "\x93NUMPY";
    file += static_cast<char>(version);
    file += '\0';
    for (int i = 0; i < (version == 1 ? 2 : 4); ++i)
      file += static_cast<char>(header.size() >> (8 * i) & 0xff);
    return file + header + data;
  }

  std::string
  dictionary(const std::string &type,
             const std::string &shape,
             const std::string &fortran = "False")
  {
    return "{'descr': '" + type + "', 'fortran_order': " + fortran +
           ", 'shape': " + shape + ", }";
  }

  /** The bytes of numbers on this machine, which is little-endian. */
  template <class Number>
  std::string
  bytes(const std::vector<Number> &numbers)
  {
    std::string result(numbers.size() * sizeof(Number), '\0');
    std::memcpy(result.data(), numbers.data(), result.size());
    return result;
  }

  const std::vector<double> six = {1.5, -2, 3e-7, 4, 5, 6};

  TEST(NpyReader, VersionsAndOrders)
  {
    for (const int version : {1, 2, 3})
      expect_map(read(npy(dictionary("<f8", "(2, 3)"), bytes(six), version)), 3, 2, six);
    expect_map(read(npy(dictionary("<f8", "(2, 3)", "True"), bytes(six))),
               3,
               2,
               {1.5, 3e-7, 5, -2, 4, 6});
    EXPECT_FALSE(read(npy(dictionary("<f8", "(2, 3)"), bytes(six))).size);
  }

  TEST(NpyReader, Types)
  {
    const std::vector<double> expected = {-1, 2, -300, 4};
    const auto read_as = [](const std::string &type, const std::string &data) {
      return read(npy(dictionary(type, "(2, 2)"), data));
    };
    expect_map(read_as("<f4", bytes<float>({-1, 2, -300, 4})), 2, 2, expected);
    expect_map(read_as("<i2", bytes<std::int16_t>({-1, 2, -300, 4})), 2, 2, expected);
    expect_map(read_as("<i4", bytes<std::int32_t>({-1, 2, -300, 4})), 2, 2, expected);
    expect_map(read_as("<i8", bytes<std::int64_t>({-1, 2, -300, 4})), 2, 2, expected);
  }

  TEST(NpyReader, BadFiles)
  {
    const std::string data = bytes(six);
    EXPECT_TRUE(mentions(complaint(npy(dictionary(">f8", "(2, 3)"), data)), "'>f8'"));
    EXPECT_TRUE(mentions(complaint(npy(dictionary("<c16", "(1, 3)"), data)), "'<c16'"));
    EXPECT_TRUE(
      mentions(complaint(npy("{'descr': [('h', '<f8')], 'shape': (2, 3), }", data)),
               "no single data type"));
    EXPECT_TRUE(
      mentions(complaint(npy(dictionary("<f8", "(6,)"), data)), "two-dimensional"));
    EXPECT_TRUE(
      mentions(complaint(npy(dictionary("<f8", "(1, 2, 3)"), data)), "two-dimensional"));
    EXPECT_TRUE(
      mentions(complaint(npy(dictionary("<f8", "(0, 3)"), "")), "not possible"));
    EXPECT_TRUE(mentions(complaint(npy(dictionary("<f8", "(2, 3)"), data.substr(8))),
                         "promises 2 x 3 values and holds 5"));
    EXPECT_TRUE(
      mentions(complaint(npy(dictionary("<f8", "(2, 3)"), data + data)), "holds 12"));
    EXPECT_TRUE(
      mentions(complaint(npy(dictionary("<f8", "(2000000000, 2000000000)"), data)),
               "holds 6"));
    EXPECT_TRUE(
      mentions(complaint(npy(dictionary("<f8", "(99999999999999999999, 3)"), data)),
               "not possible"));
    const std::string whole = npy(dictionary("<f8", "(2, 3)"), data);
    EXPECT_TRUE(mentions(complaint(whole.substr(0, 40)), "within its header"));
    EXPECT_TRUE(mentions(complaint(whole.substr(0, 9)), "within its header"));
    EXPECT_TRUE(
      mentions(complaint(npy(dictionary("<f8", "(2, 3)"), data, 7)), "version"));
    // Where a regular expression would run out of stack.
    EXPECT_TRUE(
      mentions(complaint(npy("{'descr': '" + std::string(400000, '<'), data, 2)),
               "too long a header"));
  }

  TEST(NpyReader, NaNIsMissingAndInfinityIsBad)
  {
    auto values = six;
    values[4]   = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(read(npy(dictionary("<f8", "(2, 3)"), bytes(values))).n_missing(), 1U);
    values[4] = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(mentions(complaint(npy(dictionary("<f8", "(2, 3)"), bytes(values))),
                         "row 1, column 1"));
    values.assign(6, std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(mentions(complaint(npy(dictionary("<f8", "(2, 3)"), bytes(values))),
                         "no valid point"));
  }

  TEST(MatrixTextReader, Separators)
  {
    const std::vector<double> expected = {1, -2.5, 3e-7, 4, 5, 6};
    for (const std::string text :
         {"1 -2.5 3e-7\n4 5 6\n",
          "  1\t-2.5  3E-07 \r\n 4 +5 6",
          "1,-2.5,3e-007\n4,5,6,\n",
          "1; -2.5 ;.3e-6\n\n4; 5; 6.\n",
          "\xef\xbb\xbf# by hand\nx y z\n1 -2.5 3e-7\n# 9 9 9\n4 5 6"})
      expect_map(read(text), 3, 2, expected);
  }

  TEST(MatrixTextReader, InterferometerHeader)
  {
    const auto map = read(
      "h=2 w=3\npixel size=5e-007 m\ndata unit=rad\n"
      "height conversion factor (-> m)=2e-008\n1 2 3\n4 5 6 \n");
    expect_map(map, 3, 2, {1, 2, 3, 4, 5, 6});
    EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 2e-8);
    EXPECT_DOUBLE_EQ(map.lateral_unit.metres.value(), 1.);
    ASSERT_TRUE(map.size);
    EXPECT_DOUBLE_EQ((*map.size)[0], 1.5e-6);
    EXPECT_DOUBLE_EQ((*map.size)[1], 1e-6);
    EXPECT_FALSE(read("data unit=rad\n1 2\n3 4\n").height_unit.metres);
    EXPECT_EQ(read("data unit=rad\n1 2\n3 4\n").height_unit.name, "rad");
  }

  TEST(MatrixTextReader, GwyddionHeader)
  {
    for (const std::string micro : {"\xc2\xb5", "\xb5", "\xce\xbc", "u"})
      {
        const auto map =
          read("# Channel: Topography\n# Width: 12,34 " + micro +
               "m\n# Height: 5678.9 nm\n# Value units: " + micro + "m\n1 1.5\n-2 0\n");
        expect_map(map, 2, 2, {1, 1.5, -2, 0});
        EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-6);
        ASSERT_TRUE(map.size);
        EXPECT_DOUBLE_EQ((*map.size)[0], 12.34e-6);
        EXPECT_DOUBLE_EQ((*map.size)[1], 5678.9e-9);
      }
  }

  TEST(MatrixTextReader, OtherInstruments)
  {
    const auto cells = read(
      "\"Date\",\"today\"\n\"XY calibration\",\"276.5\",\"nm\"\n"
      "\"Unit\",\"\xb5m\"\n\n1,2\n3,4\n");
    expect_map(cells, 2, 2, {1, 2, 3, 4});
    EXPECT_DOUBLE_EQ((*cells.size)[0], 553e-9);
    EXPECT_DOUBLE_EQ(cells.height_unit.metres.value(), 1e-6);

    const auto pixels = read(
      "# x-pixels = 2\n# y-pixels = 1\n# x-length = 500\n"
      "# y-length = 250\n# Bit2nm = 0.5\n# Start of Data:\n1 2\n");
    EXPECT_DOUBLE_EQ((*pixels.size)[0], 500.);
    EXPECT_FALSE(pixels.lateral_unit.is_stated());
    EXPECT_DOUBLE_EQ(pixels.height_unit.metres.value(), 5e-10);
  }

  TEST(MatrixTextReader, DecimalCommas)
  {
    const std::vector<double> expected = {1, -2.5, 3e-7, 4, 5, 6.25};
    for (const std::string text : {"1;-2,5;3e-7\n4;5;6,25\n",
                                   "1 -2,5 3e-7\n4 5 6,25\n",
                                   "1\t-2,5\t3e-7\r\n4\t5\t6,25\r\n"})
      expect_map(read(text), 3, 2, expected);
    EXPECT_TRUE(mentions(complaint("1.5 2\n3,5 4\n"), "mixes decimal points and commas"));
    EXPECT_TRUE(mentions(complaint("1.5;1,234.5\n"), "not a number in line 1, column 1"));
  }

  TEST(MatrixTextReader, MissingPoints)
  {
    for (const std::string text : {"1 nan\nBAD 4\n", "1,***\n--,4\n", "1;NaN\nn/a;4\n"})
      EXPECT_EQ(read(text).n_missing(), 2U) << text;
    EXPECT_EQ(read("bad 2\n3 4\n").n_missing(), 1U);
  }

  TEST(MatrixTextReader, BadFiles)
  {
    EXPECT_TRUE(mentions(complaint("1 2 3\n4 5\n"), "2 values in line 2 and 3"));
    EXPECT_TRUE(mentions(complaint("1 2\n4 5 6\n"), "3 values in line 2 and 2"));
    EXPECT_TRUE(mentions(complaint("1 2\n4 x\n"), "not a number in line 2, column 1"));
    EXPECT_TRUE(mentions(complaint("1 2\n4 5.5.5\n"), "not a number in line 2"));
    EXPECT_TRUE(mentions(complaint("1,,2\n"), "not a number in line 1, column 1"));
    EXPECT_TRUE(mentions(complaint("1 2\n3,4\n"), "1 values in line 2 and 2"));
    EXPECT_TRUE(mentions(complaint("h=3 w=2\n1 2\n3 4\n"), "promises 3 rows of 2"));
    EXPECT_TRUE(
      mentions(complaint("h=999999999 w=999999999\n1 2\n"), "holds 1 rows of 2"));
    for (const char *count : {"1e300", "-1e300", "nan"})
      EXPECT_TRUE(mentions(complaint("# x-pixels = " + std::string(count) + "\n1 2\n"),
                           "promises 1 rows of 0"));
    EXPECT_TRUE(mentions(complaint("1 2\n-inf 4\n"), "row 1, column 0"));
    EXPECT_TRUE(mentions(complaint("# Width: 3 furlong\n1 2\n"), "'furlong'"));
    EXPECT_TRUE(mentions(complaint("# Width: -3 m\n1 2\n"), "positive"));
    EXPECT_TRUE(mentions(complaint("# Width: wide\n1 2\n"), "'wide'"));
    EXPECT_TRUE(mentions(complaint("no number at all\n"), "holds no numbers"));
    EXPECT_TRUE(mentions(complaint(""), "is empty"));
    EXPECT_TRUE(mentions(complaint(std::string(100000, 'x')), "holds no numbers"));
  }

  TEST(HeightMap, FilesOfOtherKinds)
  {
    EXPECT_TRUE(mentions(complaint("\x89HDF\r\n\x1a\n"), "HDF5"));
    EXPECT_TRUE(mentions(complaint("CDF\x02"), "NetCDF"));
    EXPECT_TRUE(mentions(complaint("PK\x03\x04"), "zip"));
    EXPECT_TRUE(mentions(complaint(std::string("MZ\0\1", 4)), "not known"));
    EXPECT_TRUE(
      mentions(input_error([]() { read_height_map({""}); }), "Surface/File is empty"));
    EXPECT_TRUE(mentions(input_error([]() { read_height_map({"/no/such.npy"}); }),
                         "'/no/such.npy' does not exist"));
    EXPECT_TRUE(mentions(input_error([]() { read_height_map({"/"}); }), "is not a file"));
  }
} // namespace
