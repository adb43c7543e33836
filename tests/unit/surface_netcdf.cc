// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/map_writer.h>
#include <strait/surface/readers/height_map.h>

#include <cmath>
#include <sstream>

#include "surface_test_tools.h"

// How the NetCDF library reads such files, and what it writes, is tested together with
// strait_import, which uses another implementation.

namespace
{
  using namespace strait;
  using namespace strait::test;

  /** The file of a map of 3 × 2 points with the heights 1 to 6 on a box of 30 × 40. */
  std::string
  canonical_map(const std::string &unit = "nm")
  {
    const SlabLayoutPtr layout = make_layout({3, 2, 30., 40.}, MPI_COMM_SELF);
    SlabField           heights(layout);
    for (int iy = 0; iy < 2; ++iy)
      for (int ix = 0; ix < 3; ++ix)
        heights(ix, iy) = 1 + iy * 3 + ix;
    const TemporaryFile file("");
    std::string         content;
    run_on_root(MPI_COMM_WORLD, [&]() {
      write_netcdf_map(file.path, heights, unit);
      std::ostringstream text;
      text << std::ifstream(file.path, std::ios::binary).rdbuf();
      content = text.str();
    });
    return broadcast(MPI_COMM_WORLD, content);
  }

  /** Replace each @p before, which must occur, by @p after, which has the same length. */
  std::string
  replaced(std::string content, const std::string &before, const std::string &after)
  {
    EXPECT_EQ(before.size(), after.size());
    std::size_t at = content.find(before);
    EXPECT_NE(at, std::string::npos);
    for (; at != std::string::npos; at = content.find(before, at + 1))
      content.replace(at, before.size(), after);
    return content;
  }

  TEST(NetcdfReader, LayoutOfContactEngineering)
  {
    const auto map = read_map(canonical_map());
    EXPECT_EQ(map.nx, 3);
    EXPECT_EQ(map.ny, 2);
    EXPECT_EQ(map.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    ASSERT_TRUE(map.size);
    EXPECT_DOUBLE_EQ((*map.size)[0], 30.);
    EXPECT_DOUBLE_EQ((*map.size)[1], 40.);
    EXPECT_DOUBLE_EQ(map.lateral_unit.metres.value(), 1e-9);
    EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-9);
    EXPECT_TRUE(map.is_periodic);
    EXPECT_EQ(map.format, "NetCDF");
    EXPECT_TRUE(read_map(canonical_map("")).height_unit.name.empty());
  }

  TEST(NetcdfReader, PeriodicByAWord)
  {
    // The attribute with its type and value: the integer 1, or a word of four letters.
    const auto periodic =
      [](const char type, const char count, const std::string &value) {
        return std::string("periodic\0\0\0", 11) + type + std::string(3, '\0') + count +
               value;
      };
    const std::string one = periodic(4, 1, std::string("\0\0\0\1", 4));
    for (const auto &[word, says_yes] :
         {std::pair{"true", true}, {"True", true}, {"TRUE", true}, {"none", false}})
      EXPECT_EQ(
        read_map(replaced(canonical_map(), one, periodic(2, 4, word))).is_periodic,
        says_yes)
        << word;
  }

  TEST(NetcdfReader, UnitOfAllLengths)
  {
    // The attribute gets a name eight bytes longer, and a text eight bytes shorter.
    const auto attribute = [](const std::string &length, const std::string &name) {
      return std::string("\0\0\0", 3) + length + name + std::string("\0\0\0\2\0\0\0", 7);
    };
    const std::string padding(2, '\0');
    std::string       content =
      replaced(canonical_map("micrometre"),
               attribute("\4", "unit") + "\n" + "micrometre" + padding,
               attribute("\v", "length_unit" + std::string(1, '\0')) + "\2" + "um" +
                 padding);
    content.replace(content.find("length_unit", content.find("heights")),
                    11,
                    "length_unix");
    const auto map = read_map(content);
    EXPECT_DOUBLE_EQ(map.lateral_unit.metres.value(), 1e-6);
    EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-6);
    // Likewise, a mark of missing points that is a text.
    const std::string text_as_mark =
      replaced(canonical_map("micrometre"),
               attribute("\4", "unit") + "\n" + "micrometre" + padding,
               attribute("\n", "_FillValue" + padding) + "\2" + "um" + padding);
    EXPECT_TRUE(mentions(complaint_of_map(text_as_mark), "_FillValue that is not one"));
  }

  TEST(NetcdfReader, TwoUnits)
  {
    // The integer 1 for periodic becomes a second unit of the coordinates.
    const std::string one("\0\0\0\bperiodic\0\0\0\4\0\0\0\1\0\0\0\1", 24);
    const auto        unit = [](const std::string &text) {
      return std::string("\0\0\0\5units\0\0\0\0\0\0\2\0\0\0\2", 20) + text +
             std::string(2, '\0');
    };
    const auto with = [&](const std::string &text) {
      return replaced(canonical_map(), one, unit(text));
    };
    EXPECT_TRUE(mentions(complaint_of_map(with("um")), "two units, 'nm' and 'um'"));
    EXPECT_DOUBLE_EQ(read_map(with("nm")).lateral_unit.metres.value(), 1e-9);
  }

  TEST(NetcdfReader, OtherNames)
  {
    // Without a dimension called x, the last one runs along x, by its own coordinates.
    const std::string name(std::string("\0\0\0\1x\0\0\0", 8));
    const auto        map =
      read_map(replaced(canonical_map(), name, std::string("\0\0\0\1r\0\0\0", 8)));
    EXPECT_EQ(map.nx, 2);
    EXPECT_EQ(map.values[1], 4.);
    EXPECT_DOUBLE_EQ(map.size.value().at(0), 40.);
    EXPECT_TRUE(
      mentions(complaint_of_map(replaced(canonical_map(), "heights", "voltage")),
               "no two-dimensional variable 'heights': type \""));
    // Without a length, the steps of coordinates that have a unit give the size.
    const std::string without = replaced(canonical_map(), "length", "widths");
    EXPECT_DOUBLE_EQ(read_map(without).size.value().at(0), 30.);
    EXPECT_DOUBLE_EQ(read_map(without).size.value().at(1), 40.);
    EXPECT_FALSE(read_map(replaced(without, "unit", "unix")).size);
    EXPECT_FALSE(read_map(replaced(canonical_map(), "nm", "qm")).height_unit.metres);
  }

  TEST(NetcdfReader, CoordinatesAndLengthAgree)
  {
    // Replace the last two coordinates along x, which are 0, 10 and 20 for a length
    // of 30. The 20 of those along y, 0 and 20 for a length of 40, is replaced as well,
    // which does no harm.
    const auto with_x = [](const std::string &second, const std::string &third) {
      const std::string rest(6, '\0');
      return replaced(replaced(canonical_map(), "\x40\x34" + rest, third + rest),
                      "\x40\x24" + rest,
                      second + rest);
    };
    const std::string zero(2, '\0');
    for (const auto &[second, third] : {std::pair{"\x40\x34", "\x40\x44"}, // 20, 40
                                        {"\xc0\x24", "\xc0\x34"}})         // −10, −20
      EXPECT_TRUE(
        mentions(complaint_of_map(with_x(second, third)),
                 "has coordinates 'x' that do not rise in steps of its length"));
    // Coordinates that span the length, 0 to 30, in two steps: the period is three.
    EXPECT_DOUBLE_EQ(read_map(with_x("\x40\x2e", "\x40\x3e")).size->at(0), 45.);
    EXPECT_EQ(read_map(with_x(zero, zero)).size->at(0), 30.);
    for (const std::string &second : {std::string("\x40\x2e"), zero}) // 15, 0
      EXPECT_TRUE(mentions(complaint_of_map(with_x(second, "\x40\x34")),
                           "has coordinates 'x' without equal steps"));
  }

  TEST(NetcdfReader, DamagedFiles)
  {
    const std::string whole = canonical_map();
    for (std::size_t length = 1; length < whole.size(); ++length)
      EXPECT_FALSE(complaint_of_map(whole.substr(0, length)).empty()) << length;
    // A damaged header claims more than 2^30 points along x instead of 3, and then 16387.
    std::string       claims = whole;
    const std::size_t at     = claims.find(std::string("\0\0\0\1x\0\0\0", 8)) + 8;
    claims[at]               = '\x40';
    EXPECT_TRUE(mentions(complaint_of_map(claims), "must lie between 1 and"));
    claims[at]     = '\0';
    claims[at + 2] = '\x40';
    EXPECT_TRUE(mentions(complaint_of_map(claims), "too short"));
  }
} // namespace
