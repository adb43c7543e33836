// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/parameter_table.h>
#include <strait/base/units.h>

#include <charconv>
#include <cmath>
#include <map>

namespace strait
{
  namespace
  {
    using Factors = std::map<std::string, double>;

    std::optional<double>
    look_up(const Factors &table, const std::string &unit)
    {
      const auto found = table.find(unit);
      return found == table.end() ? std::nullopt : std::optional(found->second);
    }

    /** @p text with any of the micro signs replaced by u. */
    std::string
    with_plain_micro(std::string text)
    {
      for (const char *micro : {"\xc2\xb5", "\xce\xbc", "\xb5"})
        if (text.compare(0, std::string(micro).size(), micro) == 0)
          return "u" + text.substr(std::string(micro).size());
      return text;
    }
  } // namespace

  std::optional<double>
  metres_in(const std::string &unit)
  {
    static const Factors table = {{"m", 1.},
                                  {"cm", 1e-2},
                                  {"mm", 1e-3},
                                  {"um", 1e-6},
                                  {"micron", 1e-6},
                                  {"microns", 1e-6},
                                  {"nm", 1e-9},
                                  {"pm", 1e-12},
                                  {"angstrom", 1e-10},
                                  {"\xc3\x85", 1e-10},     // A with ring, UTF-8
                                  {"\xe2\x84\xab", 1e-10}, // angstrom sign, UTF-8
                                  {"\xc5", 1e-10},         // A with ring, Latin-1
                                  {"in", 2.54e-2},
                                  {"inch", 2.54e-2}};
    return look_up(table, with_plain_micro(unit));
  }

  std::optional<double>
  pascals_in(const std::string &unit)
  {
    static const Factors table = {{"Pa", 1.},
                                  {"kPa", 1e3},
                                  {"MPa", 1e6},
                                  {"GPa", 1e9},
                                  {"mbar", 1e2},
                                  {"bar", 1e5},
                                  {"N/mm2", 1e6}};
    return look_up(table, unit);
  }

  std::optional<double>
  seconds_in(const std::string &unit)
  {
    static const Factors table = {{"s", 1.}, {"ms", 1e-3}, {"min", 60.}, {"h", 3600.}};
    return look_up(table, unit);
  }

  LengthUnit
  parse_length_unit(const std::string &text)
  {
    const std::string name   = trim(text);
    double            factor = 1.;
    const char *const end    = name.data() + name.size();
    const auto        number = std::from_chars(name.data(), end, factor);
    if (number.ec != std::errc())
      return {name, metres_in(name)};
    const auto unit = metres_in(trim(std::string(number.ptr, end)));
    if (!unit || !(factor > 0.) || !std::isfinite(factor))
      return {name, {}};
    return {name, factor * *unit};
  }

  void
  UnitParameters::bind(ParameterSection section)
  {
    const auto unit_or_nothing = [](const std::string &known, const auto &meaning) {
      return Text{known + ", or empty", [meaning](const std::string &unit) {
                    return unit.empty() || meaning(unit);
                  }};
    };
    section.add("Length", length, unit_or_nothing(length_units, metres_in)).meaning =
      "Unit of all lengths in the scene and its results; empty: not stated, or metres "
      "where a file states units.";
    section
      .add("Pressure",
           pressure,
           unit_or_nothing("Pa, kPa, MPa, GPa, mbar, bar, N/mm2", pascals_in))
      .meaning = "Unit of all pressures and moduli; empty: not stated.";
    section.add("Time", time, unit_or_nothing("s, ms, min, h", seconds_in)).meaning =
      "Unit of time in the viscosity and the leak rate; empty: not stated.";
  }
} // namespace strait
