// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/driver/result_units.h>

#include <array>
#include <cmath>
#include <map>

namespace strait
{
  namespace
  {
    constexpr std::array<const char *, 4> text_columns = {
      {"branch", "status", "orientation", "kind"}};

    constexpr std::array<const char *, 6> length_columns = {{"mean_gap",
                                                             "slip_length",
                                                             "effective_gap",
                                                             "worst_constriction_x",
                                                             "worst_constriction_y",
                                                             "worst_constriction_gap"}};

    template <std::size_t n>
    bool
    contains(const std::array<const char *, n> &names, const std::string &name)
    {
      for (const char *candidate : names)
        if (name == candidate)
          return true;
      return false;
    }
  } // namespace

  std::string
  unit_of_column(const std::string &column, const UnitParameters &units)
  {
    if (contains(text_columns, column))
      return "";
    if (contains(length_columns, column))
      return units.length;
    if (column == "pressure")
      return units.pressure;
    if (column == "leak_rate" || column == "leak_rate_lower" ||
        column == "leak_rate_upper" || column == "theory_leak_rate")
      return units.length + "³/" + units.time;
    if (column == "theory_mean_gap")
      return units.length;
    if (column == "fluid_load")
      return units.pressure;
    if (column == "adhesive_energy")
      return units.pressure + " " + units.length;
    if (column == "contact_seconds" || column == "flow_seconds")
      return "s";
    if (const LeakRateUnit *unit = find_leak_rate_unit(column))
      return unit->name;
    return "1";
  }

  double
  in_trade_unit(const double           leak_rate,
                const LeakRateUnit    &unit,
                const UnitParameters  &units,
                const FluidParameters &fluid)
  {
    double in_si = leak_rate * std::pow(metres_in(units.length).value_or(1.), 3) /
                   seconds_in(units.time).value_or(1.);
    if (unit.is_throughput)
      in_si *= 0.5 * (fluid.inlet_pressure + fluid.outlet_pressure) *
               pascals_in(units.pressure).value_or(1.);
    return in_si / unit.in_si;
  }
} // namespace strait
