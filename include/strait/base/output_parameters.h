// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_output_parameters_h
#define strait_base_output_parameters_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
  /** At which steps fields are written. */
  enum class FieldOutput
  {
    none,
    last,
    all
  };

  /** The section Output. */
  struct OutputParameters
  {
    std::string              directory        = "output";
    FieldOutput              fields           = FieldOutput::none;
    bool                     pictures         = true;
    bool                     error_budget     = false; // with what costs more solves
    bool                     checkpoint       = true;
    bool                     surface_map      = false; // surface.nc
    bool                     surface_spectrum = false; // spectrum.csv
    std::vector<std::string> leak_rate_units;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };
} // namespace strait

#endif
