// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_unit_parameters_h
#define strait_base_unit_parameters_h

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
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

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };
} // namespace strait

#endif
