// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/units.h>
#include <strait/driver/result_units.h>

#include <gtest/gtest.h>

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
    EXPECT_FALSE(parse_length_unit("").is_stated());
  }

  TEST(Units, LeakRatesOfTheTrade)
  {
    FluidParameters fluid;
    fluid.inlet_pressure  = 1e5;
    fluid.outlet_pressure = 0;
    const UnitParameters si{"m", "Pa", "s"};
    const auto           in = [&](const char *name) {
      return in_trade_unit(1e-9, *find_leak_rate_unit(name), si, fluid);
    };
    EXPECT_DOUBLE_EQ(in("ml/h"), 3.6);
    EXPECT_DOUBLE_EQ(in("ul/min"), 60.);
    EXPECT_DOUBLE_EQ(in("l/min"), 6e-5);
    EXPECT_DOUBLE_EQ(in("Pa m3/s"), 5e-5); // 1e-9 m³/s at the mean pressure, 0.5 bar
    EXPECT_DOUBLE_EQ(in("mbar l/s"), 5e-4);
    EXPECT_NEAR(in("atm cm3/s"), 4.9346e-4, 1e-8);

    // The same in mm, MPa and s.
    fluid.inlet_pressure = 0.1;
    EXPECT_DOUBLE_EQ(
      in_trade_unit(1., *find_leak_rate_unit("mbar l/s"), {"mm", "MPa", "s"}, fluid),
      5e-4);
  }

  TEST(Units, OfColumns)
  {
    const UnitParameters units{"mm", "MPa", "s"};
    EXPECT_EQ(unit_of_column("leak_rate", units), "mm³/s");
    EXPECT_EQ(unit_of_column("worst_constriction_gap", units), "mm");
    EXPECT_EQ(unit_of_column("pressure", units), "MPa");
    EXPECT_EQ(unit_of_column("contact_area", units), "1");
    EXPECT_EQ(unit_of_column("status", units), "");
    EXPECT_EQ(unit_of_column("leak_rate_mbar_l_per_s", units), "mbar l/s");
  }
} // namespace
