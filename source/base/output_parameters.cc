// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/output_parameters.h>

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
    prm.leave_subsection();
  }

  void
  OutputParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    directory    = prm.get("Directory");
    fields       = field_outputs.value(prm.get("Fields"));
    pictures     = prm.get_bool("Pictures");
    error_budget = prm.get_bool("Error budget");
    prm.leave_subsection();
  }

  void
  OutputParameters::check() const
  {
    if (directory.empty())
      throw InputError("Output/Directory is empty; name a folder for the results.");
  }
} // namespace strait
