// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>

namespace strait
{
  struct ParameterSection;

  /** The length of one @p unit in metres; nothing if the unit is not known. The micro
   *  sign may be UTF-8, Latin-1, a Greek mu or the letter u. */
  std::optional<double> metres_in(const std::string &unit);

  /** The pressure of one @p unit in pascals; nothing if the unit is not known. */
  std::optional<double> pascals_in(const std::string &unit);

  /** The duration of one @p unit in seconds; nothing if the unit is not known. */
  std::optional<double> seconds_in(const std::string &unit);

  /** The units of length, for messages; metres_in() knows some synonyms as well. */
  inline constexpr char length_units[] = "m, cm, mm, um, nm, pm, angstrom, inch";

  /** A unit as a file or a user writes it: "nm", or a multiple, "63.1 nm". */
  struct LengthUnit
  {
    std::string           name;   // empty: not stated
    std::optional<double> metres; // nothing if the name is no length
  };

  /** Parse a unit of length, or a multiple of one, as a file or a user writes it. */
  LengthUnit parse_length_unit(const std::string &text);

  /** A unit of leak rate as it is used in the trade: volume per time, or for gases
   *  throughput, which is pressure times volume per time. */
  struct LeakRateUnit
  {
    const char *name;
    const char *column;        // of leakage.csv
    bool        is_throughput; // Pa m³/s rather than m³/s
    double      in_si;         // m³/s or Pa m³/s
  };

  inline constexpr double standard_atmosphere = 101325.; // Pa

  /** All units of leak rate, volumes first. */
  inline constexpr LeakRateUnit leak_rate_units[] = {
    {"ml/h", "leak_rate_ml_per_h", false, 1e-6 / 3600},
    {"ml/min", "leak_rate_ml_per_min", false, 1e-6 / 60},
    {"ul/min", "leak_rate_ul_per_min", false, 1e-9 / 60},
    {"l/h", "leak_rate_l_per_h", false, 1e-3 / 3600},
    {"l/min", "leak_rate_l_per_min", false, 1e-3 / 60},
    {"Pa m3/s", "leak_rate_Pa_m3_per_s", true, 1.},
    {"mbar l/s", "leak_rate_mbar_l_per_s", true, 0.1},
    {"atm cm3/s", "leak_rate_atm_cm3_per_s", true, 1e-6 * standard_atmosphere},
    {"sccm", "leak_rate_sccm", true, 1e-6 / 60. * standard_atmosphere}}; // at 0 °C

  /** The section Units of a scene: the units of its numbers. Computations do not use
   *  them; they serve to read files, to label results and to convert leak rates. */
  struct UnitParameters
  {
    std::string length; // empty: not stated, as are the others
    std::string pressure;
    std::string time;

    /** Whether all three are stated. */
    bool
    are_complete() const
    {
      return !length.empty() && !pressure.empty() && !time.empty();
    }

    void bind(ParameterSection section);
  };
} // namespace strait
