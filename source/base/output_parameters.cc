// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/output_parameters.h>
#include <strait/base/text.h>
#include <strait/base/units.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<FieldOutput> field_outputs = {{FieldOutput::none, "none"},
                                                {FieldOutput::last, "last"},
                                                {FieldOutput::all, "all"}};
  } // namespace

  void
  OutputParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Output");
    prm.declare_entry("Directory",
                      "output",
                      Anything(),
                      "Folder of the results, made if it does not exist; a relative path "
                      "starts at the current folder.");
    prm.declare_entry(
      "Fields",
      field_outputs.name(FieldOutput::none),
      Selection(field_outputs.pattern()),
      "Steps whose fields are written: gap, pressure and labels on the grid "
      "(HDF5), the flow on its mesh (VTU).");
    prm.declare_entry(
      "Pictures",
      "true",
      Bool(),
      "Draw a picture of each step and of the leak rate against the load.");
    prm.declare_entry(
      "Error budget",
      "false",
      Bool(),
      "Estimate the leak rate's errors from contact grid and gap interpolation as "
      "well, from solutions on coarser grids; about doubles the time of a step.");
    prm.declare_entry(
      "Checkpoint",
      "true",
      Bool(),
      "Keep after every step what --resume needs to continue the run: 12 bytes a "
      "grid point on the disk for a dry contact, up to 28 with several slip lengths or "
      "adhesion, and the time to write that.");
    prm.declare_entry(
      "Surface map",
      "false",
      Bool(),
      "Write the surface on the grid, processed, as NetCDF (surface.nc).");
    prm.declare_entry("Surface spectrum",
                      "false",
                      Bool(),
                      "Write and draw the spectrum of the surface (spectrum.csv).");
    prm.declare_entry("Leak rate units",
                      "",
                      Anything(),
                      "Columns with the leak rate in units of the trade, a list of " +
                        leak_rate_unit_names() +
                        "; needs the section Units. The last three are throughputs of a "
                        "gas, for Fluid/State = gas.");
    prm.leave_subsection();
  }

  void
  OutputParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    directory        = prm.get("Directory");
    fields           = field_outputs.value(prm.get("Fields"));
    pictures         = prm.get_bool("Pictures");
    error_budget     = prm.get_bool("Error budget");
    checkpoint       = prm.get_bool("Checkpoint");
    surface_map      = prm.get_bool("Surface map");
    surface_spectrum = prm.get_bool("Surface spectrum");
    leak_rate_units.clear();
    if (!prm.get("Leak rate units").empty())
      leak_rate_units = split(prm.get("Leak rate units"), ',');
    prm.leave_subsection();
  }

  void
  OutputParameters::check() const
  {
    if (directory.empty())
      throw InputError("Output/Directory is empty; name a folder for the results.");
    for (const std::string &unit : leak_rate_units)
      if (find_leak_rate_unit(unit) == nullptr)
        throw InputError("Output/Leak rate units contains '" + unit +
                         "', which is not known; choose from " + leak_rate_unit_names() +
                         ".");
  }
} // namespace strait
