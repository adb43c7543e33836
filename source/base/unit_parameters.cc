// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/unit_parameters.h>
#include <strait/base/units.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    void
    check_unit(const std::string           &name,
               const std::string           &value,
               const std::optional<double> &meaning,
               const std::string           &known)
    {
      if (!value.empty() && !meaning)
        throw InputError("Units/" + name + " is '" + value +
                         "', which is not a known unit; choose one of " + known +
                         ", or leave it empty.");
    }
  } // namespace

  double
  UnitParameters::length_in_metres() const
  {
    return length.empty() ? 1. : metres_in(length).value_or(1.);
  }

  bool
  UnitParameters::are_complete() const
  {
    return !length.empty() && !pressure.empty() && !time.empty();
  }

  void
  UnitParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Units");
    prm.declare_entry("Length",
                      "",
                      Anything(),
                      std::string("Unit of all lengths of the scene and its results: ") +
                        length_units +
                        "; empty: not stated, and metres where a file states units.");
    prm.declare_entry("Pressure",
                      "",
                      Anything(),
                      "Unit of all pressures and moduli: Pa, kPa, MPa, GPa, mbar, bar, "
                      "N/mm2; empty: not stated.");
    prm.declare_entry("Time",
                      "",
                      Anything(),
                      "Unit of time, in the viscosity and the leak rate: s, ms, min, h; "
                      "empty: not stated.");
    prm.leave_subsection();
  }

  void
  UnitParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Units");
    length   = prm.get("Length");
    pressure = prm.get("Pressure");
    time     = prm.get("Time");
    prm.leave_subsection();
  }

  void
  UnitParameters::check() const
  {
    check_unit("Length", length, metres_in(length), length_units);
    check_unit("Pressure",
               pressure,
               pascals_in(pressure),
               "Pa, kPa, MPa, GPa, mbar, bar, N/mm2");
    check_unit("Time", time, seconds_in(time), "s, ms, min, h");
  }
} // namespace strait
