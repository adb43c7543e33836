// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/base/units.h>
#include <strait/run/result_tables.h>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "temporary_folder.h"

namespace
{
  using namespace strait;

  TEST(Units, LengthsInAllSpellings)
  {
    for (const char *um : {"um", "\xc2\xb5m", "\xce\xbcm", "\xb5m", "micron"})
      EXPECT_EQ(metres_in(um), 1e-6) << um;
    EXPECT_EQ(metres_in("\xc3\x85"), 1e-10);
    EXPECT_FALSE(metres_in("rad"));
    EXPECT_FALSE(metres_in(""));

    EXPECT_DOUBLE_EQ(parse_length_unit("63.1 nm").metres.value(), 63.1e-9);
    EXPECT_DOUBLE_EQ(parse_length_unit(" 2e-3um ").metres.value(), 2e-9);
    EXPECT_FALSE(parse_length_unit("63.1 rad").metres);
    EXPECT_FALSE(parse_length_unit("-1 nm").metres);
    EXPECT_FALSE(parse_length_unit("3").metres);
    EXPECT_TRUE(parse_length_unit("").name.empty());
  }

  TEST(Units, LeakRatesOfTheTrade)
  {
    FluidParameters fluid;
    fluid.inlet_pressure  = 1e5;
    fluid.outlet_pressure = 0;
    const UnitParameters si{"m", "Pa", "s"};
    const auto           in = [&](const char *name) {
      return in_trade_unit(1e-9, *find_row(leak_rate_units, name), si, fluid);
    };
    EXPECT_DOUBLE_EQ(in("ml/h"), 3.6);
    EXPECT_DOUBLE_EQ(in("ul/min"), 60.);
    EXPECT_DOUBLE_EQ(in("l/min"), 6e-5);
    EXPECT_DOUBLE_EQ(in("Pa m3/s"), 5e-5); // 1e-9 m³/s at the mean pressure, 0.5 bar
    EXPECT_DOUBLE_EQ(in("mbar l/s"), 5e-4);
    EXPECT_NEAR(in("atm cm3/s"), 4.9346e-4, 1e-8);

    // The same in mm, MPa and s.
    fluid.inlet_pressure = 0.1;
    EXPECT_DOUBLE_EQ(in_trade_unit(1.,
                                   *find_row(leak_rate_units, "mbar l/s"),
                                   {"mm", "MPa", "s"},
                                   fluid),
                     5e-4);
  }

  TEST(Units, OfColumns)
  {
    Scene scene;
    scene.output.leak_rate_units = {"mbar l/s"};
    scene.units                  = {"mm", "MPa", "min"};
    std::map<std::string, std::string> unit;
    for (const TableInfo &table : all_tables(scene))
      for (const ColumnInfo &column : table.columns)
        {
          // run.json and the readers of tables tell a column's unit by its name alone.
          const std::string own = in_units_of(column.unit, scene.units);
          EXPECT_EQ(unit.emplace(column.name, own).first->second, own) << column.name;
        }
    EXPECT_EQ(unit.at("leak_rate"), "mm³/min");
    EXPECT_EQ(unit.at("worst_constriction_gap"), "mm");
    EXPECT_EQ(unit.at("critical_load_lower"), "MPa");
    EXPECT_EQ(unit.at("contact_area"), "1");
    EXPECT_EQ(unit.at("status"), "");
    EXPECT_EQ(unit.at("dissipated_energy"), "MPa mm");
    EXPECT_EQ(unit.at("contact_seconds"), "s");
    EXPECT_EQ(unit.at("leak_rate_mbar_l_per_s"), "mbar l/s");
  }

  TEST(Table, HeaderRowsAndColumnsThatAreAbsent)
  {
    struct Row
    {
      std::string name;
      double      value;
      int         count;
    };
    const test::TemporaryFolder folder;
    const std::string           path = folder.path() + "/table.csv";
    const auto                  make = [](const bool with_count) {
      Table<Row> table("table.csv", {}, "");
      table.add(&Row::name, "name: of a row")
        .when({"", with_count})
        .add(&Row::count, "count [1]: how many")
        .when()
        .add([](const Row &row) { return row.value / 2; }, "half [length]: of it");
      return table;
    };
    const auto text = [&path]() {
      std::stringstream all;
      all << std::ifstream(path).rdbuf();
      return all.str();
    };
    if (rank_in(MPI_COMM_WORLD) != 0) // one rank writes
      return;
    make(true).write_rows(folder.path(), {{"a", .2, 3}});
    EXPECT_EQ(text(), "name,count,half\na,3,0.10000000000000001\n");
    auto table = make(false);
    table.write_rows(folder.path(), {{"a", 1., 3}});
    table.append({"b", 2., 4});
    make(false).open(folder.path());
    EXPECT_EQ(text(), "name,half\na,0.5\nb,1\n");
    EXPECT_THROW(make(true).open(folder.path() + "/none"), ComputationError);
  }
} // namespace
