// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_units_h
#define strait_base_units_h

#include <optional>
#include <string>

namespace strait
{
  class ParameterSection;

  /**
   * What one of @p unit is in metres; nothing if the unit is
   * not known. The micro sign may be UTF-8, Latin-1, a Greek mu or the letter u.
   */
  std::optional<double> metres_in(const std::string &unit);

  /** What one of @p unit is in pascals; nothing if the unit is not known. */
  std::optional<double> pascals_in(const std::string &unit);

  /** What one of @p unit is in seconds; nothing if the unit is not known. */
  std::optional<double> seconds_in(const std::string &unit);

  /** The units that metres_in() knows, for messages. */
  inline constexpr char length_units[] = "m, cm, mm, um, nm, pm, angstrom, inch";

  /** A unit as a file or a user writes it: "nm", or a multiple, "63.1 nm". */
  struct LengthUnit
  {
    std::string           name;   // empty: not stated
    std::optional<double> metres; // nothing if the name is no length

    bool
    is_stated() const
    {
      return !name.empty();
    }
  };

  /** What a file or a user wrote; not a length if its name is not known. */
  LengthUnit parse_length_unit(const std::string &text);

  /**
   * A unit of leak rate as it is quoted in the trade: volume per time, or for
   * gases the throughput, pressure times volume per time.
   */
  struct LeakRateUnit
  {
    const char *name;
    const char *column;        // of leakage.csv
    bool        is_throughput; // Pa m³/s rather than m³/s
    double      in_si;
  };

  /** The unit of this name; nothing if there is none. */
  const LeakRateUnit *find_leak_rate_unit(const std::string &name);

  /** The names of all of them, for messages and documentation. */
  std::string leak_rate_unit_names();

  /**
   * The section Units of a scene: in what its numbers are meant. Computations
   * know no units; they serve to read files, to label results and to convert
   * leak rates.
   */
  struct UnitParameters
  {
    std::string length; // empty: not stated, as are the others
    std::string pressure;
    std::string time;

    /** The scene's unit of length in metres; 1 if it is not stated. */
    double length_in_metres() const;

    /** Whether all three are stated. */
    bool are_complete() const;

    void bind(ParameterSection section);
  };
} // namespace strait

#endif
