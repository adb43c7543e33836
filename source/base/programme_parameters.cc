// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/programme_parameters.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<LoadPath> load_paths = {{LoadPath::loading, "loading"},
                                          {LoadPath::unloading, "unloading"},
                                          {LoadPath::cycle, "cycle"}};
  } // namespace

  void
  ProgrammeParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Load programme");
    prm.declare_entry(
      "Pressures",
      "0.05, 0.1",
      List(Double()),
      "One step each, in this order: nominal pressures [pressure], or mean "
      "gaps [length] if Contact/Control = mean gap.");
    prm.declare_entry(
      "Find threshold",
      "false",
      Bool(),
      "Find the critical load L_c, the largest at which an open channel connects "
      "inlet and outlet, before the steps; the table then has the column "
      "reduced_load.");
    prm.declare_entry(
      "Find blow-out",
      "false",
      Bool(),
      "With Fluid/Wall feedback: for each of Pressures find the inlet pressure at which "
      "the seal begins to leak when it is raised, before the steps; see blow_out.csv.");
    prm.declare_entry(
      "Find re-sealing",
      "false",
      Bool(),
      "With Find blow-out: find the inlet pressure, too, at which the seal that has blown "
      "out closes again when it is lowered; about as many solves more.");
    prm.declare_entry("Threshold tolerance",
                      "1e-4",
                      Double(),
                      "Relative width of the brackets of L_c and of blow-out pressures, "
                      "between 1e-9 and 0.1 [1].");
    prm.declare_entry(
      "Reduced loads",
      "",
      List(Double()),
      "Further steps at these values of 1 - L/L_c, once L_c is known [1].");
    prm.declare_entry(
      "Largest reduced load of fits",
      "0.02",
      Double(),
      "Exponents are fitted to the steps up to this value of 1 - L/L_c [1].");
    prm.declare_entry(
      "Path",
      load_paths.name(LoadPath::loading),
      Selection(load_paths.pattern()),
      "From which side the threshold is approached, and the order of the steps at "
      "Reduced loads: loading (towards larger loads) or unloading; with adhesion it "
      "also says whether the first state is that of no adhesion (loading) or of full "
      "contact (unloading). cycle: loading, and the Pressures then back in the reverse "
      "order.");
    prm.declare_entry(
      "Jump tolerance",
      "1e-3",
      Double(0., 1.),
      "With adhesion: width to which the load of a jump is enclosed, in units of the "
      "largest of Pressures; 0: jumps are not looked for [1].");
    prm.leave_subsection();
  }

  void
  ProgrammeParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Load programme");
    pressures           = parse_numbers(prm.get("Pressures"));
    find_threshold      = prm.get_bool("Find threshold");
    find_blow_out       = prm.get_bool("Find blow-out");
    find_resealing      = prm.get_bool("Find re-sealing");
    threshold_tolerance = prm.get_double("Threshold tolerance");
    reduced_loads       = parse_numbers(prm.get("Reduced loads"));
    largest_fitted      = prm.get_double("Largest reduced load of fits");
    path                = load_paths.value(prm.get("Path"));
    jump_tolerance      = prm.get_double("Jump tolerance");
    prm.leave_subsection();
  }

  void
  ProgrammeParameters::check() const
  {
    if (pressures.empty() && !find_threshold)
      throw InputError("Load programme/Pressures is empty; list at least one value.");
    if (!(threshold_tolerance >= 1e-9 && threshold_tolerance <= 0.1))
      throw InputError("Load programme/Threshold tolerance is " +
                       to_text(threshold_tolerance) +
                       " but must lie between 1e-9 and 0.1.");
    if (!reduced_loads.empty() && !find_threshold)
      throw InputError(
        "Load programme/Reduced loads needs the critical load; set Find "
        "threshold = true.");
    for (const double value : reduced_loads)
      if (!(value > 0. && value < 1.))
        throw InputError("Load programme/Reduced loads contains " + to_text(value) +
                         " but 1 - L/L_c must lie between 0 and 1.");
  }
} // namespace strait
