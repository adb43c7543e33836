// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/run_parameters.h>
#include <strait/base/surface_parameters.h>
#include <strait/base/text.h>
#include <strait/base/units.h>

namespace strait
{
  namespace
  {
    const Names orientation_names{"as is", "inverted", "rotated", "inverted and rotated"};
  } // namespace

  void
  ProgrammeParameters::bind(ParameterSection section)
  {
    section.add("Pressures", pressures, any_number).meaning =
      "Nominal pressures [pressure], or mean gaps [length] if Contact/Control = mean "
      "gap; one step each, in this order.";
    section.add("Find threshold", find_threshold).meaning =
      "Before the steps, find the critical load L_c, the largest at which an open "
      "channel connects inlet and outlet; leakage.csv then has the column reduced_load.";
    section.add("Find blow-out", find_blow_out).meaning =
      "With Fluid/Wall feedback: before the steps, find for each of Pressures the "
      "blow-out pressure, at which the seal begins to leak when the inlet pressure is "
      "raised; see blow_out.csv.";
    section.add("Find re-sealing", find_resealing).meaning =
      "With Find blow-out: find also the re-sealing pressure, at which the blown-out "
      "seal closes again when the inlet pressure is lowered; takes about as many solves "
      "again.";
    section.when("Find threshold = true | Find blow-out = true")
      .add("Threshold tolerance",
           threshold_tolerance,
           any_number.at_least(1e-9).at_most(0.1))
      .meaning =
      "Relative width of the brackets of the critical load L_c and of blow-out and "
      "re-sealing pressures [1].";
    section.add("Reduced loads", reduced_loads, positive.below(1.)).meaning =
      "Further steps at these values of 1 - L/L_c [1], with Find threshold. They follow "
      "the others on a path of their own, which begins anew.";
    section.when("Find threshold = true")
      .add("Largest reduced load of fits", largest_fitted, not_negative.at_most(1.))
      .meaning = "exponents are fitted to the steps with 1 - L/L_c up to this value [1].";
    section.when("Contact/Enabled = true")
      .add("Path", path, Names{"loading", "unloading", "cycle"})
      .meaning =
      "Side from which the threshold is approached, and order of the steps at Reduced "
      "loads: loading (towards larger loads) or unloading (towards smaller ones). With "
      "adhesion the first state is that without adhesion (loading) or that of full "
      "contact (unloading). cycle: as loading, and the Pressures then back in the "
      "reverse order.";
    section.when("Contact/Adhesion/Enabled = true")
      .add("Jump tolerance", jump_tolerance, not_negative.at_most(1.))
      .meaning =
      "With adhesion: width to which a jump is enclosed in load, or in mean gap if that "
      "is controlled, as a fraction of the largest of Pressures or, at Reduced loads, of "
      "these loads [1]; 0: jumps are not looked for.";
  }

  void
  ProgrammeParameters::check() const
  {
    require(!pressures.empty() || find_threshold,
            "Load programme/Pressures is empty; list at least one value.");
    require(reduced_loads.empty() || find_threshold,
            "Load programme/Reduced loads needs the critical load; set Find "
            "threshold = true.");
    require(
      !has_repetitions(reduced_loads),
      "Load programme/Reduced loads lists a value twice, which would count twice in "
      "the fits; remove the copy.");
    require(!find_resealing || find_blow_out,
            "Load programme/Find re-sealing looks for the pressure at which a "
            "seal that has blown out closes again; it needs Find blow-out.");
  }

  std::string
  name_of(const int orientation)
  {
    return orientation_names.text(orientation);
  }

  void
  RealisationParameters::bind(ParameterSection section)
  {
    section.add("Seeds", seeds, not_negative.at_most(largest_seed)).meaning =
      "Run the scene once for each of these seeds in place of Surface/Seed, each with "
      "its own folder of results; ensemble.csv compares them.";
    section.add("Orientations", orientations, orientation_names).meaning =
      "Run each seed in these orientations; Surface/Invert and Rotate turn a single run.";
    section.when("Seeds | Orientations")
      .add("Ranks each", ranks_each, any_number.at_least(1))
      .meaning =
      "Number of ranks that run one realisation together, a divisor of the number of all "
      "ranks; the groups run realisations at the same time. Empty: all ranks together "
      "run one after the other.";
  }

  void
  RealisationParameters::check() const
  {
    require(!orientations.empty(),
            "Realisations/Orientations is empty; give 'as is' for no change.");
    require(!has_repetitions(seeds) && !has_repetitions(orientations),
            "Realisations lists a seed or an orientation twice; the copies would "
            "falsify the scatter, remove them.");
    require(ranks_each.size() <= 1, "Realisations/Ranks each takes one number, or none.");
  }

  void
  WholeSealParameters::bind(ParameterSection section)
  {
    section.add("Enabled", enabled).meaning =
      "Estimate the leak rate of a whole seal and its uncertainty, with the realisations "
      "as patches of it; see seal.csv.";
    ParameterSection effect = section.when("Enabled = true");
    effect.add("Circumference", circumference, not_negative).meaning =
      "Length of the seal across the flow [length].";
    effect.add("Contact width", contact_width, not_negative).meaning =
      "Width of the contact along the flow, the same at all loads [length].";
    effect.add_path("Pressure profile", pressure_profile, "hertz").meaning =
      "Distribution of the contact pressure over the width. Empty: uniform; hertz: that "
      "of a cylinder on a plane, which vanishes at both edges; else a table of two "
      "columns, position [length] and pressure, for example from a finite-element "
      "program. A nominal pressure is then the mean over the width, and at least two "
      "patches must lie along it.";
    effect.add("Isotropic", isotropic).meaning =
      "true: rotated realisations are further samples of the conductance along the flow; "
      "false: they give that across the flow, for a surface with a lay.";
    effect.add("Wanted leak rate", wanted_leak_rate, not_negative).meaning =
      "Find the load at which the whole seal has this leak rate, in the first of "
      "Output/Leak rate units if that is set [length^3/time]; 0: do not.";
    section.add("Two in a row", two_in_a_row).meaning =
      "For a single box: solve also the flow through two copies of it, one behind the "
      "other. The patches of a seal that is wider than one patch do so by themselves.";
  }

  void
  WholeSealParameters::check() const
  {
    require(
      !enabled || (circumference > 0. && contact_width > 0.),
      "Seal/Enabled needs to know how large the seal is; set Seal/Circumference and "
      "Contact width.");
  }

  void
  TheoryParameters::bind(ParameterSection section)
  {
    section.add("Enabled", enabled).meaning =
      "Evaluate Persson's contact theory and an effective medium beside each step. With "
      "Contact and Fluid off they are evaluated alone, without a grid, for every load of "
      "Load programme/Pressures.";
    ParameterSection effect = section.when("Enabled = true");
    effect.add("Spectrum", spectrum_of_surface, Names{"model", "surface"}).meaning =
      "model: the average spectrum of a self-affine surface, in closed form; surface: "
      "that of the heights on the grid.";
    effect.add("Gap distribution", simulated_gaps, Names{"persson", "simulated"})
      .meaning =
      "Gaps that the effective medium is made of. persson: those of the theory; "
      "simulated: those of the step.";
    effect
      .add("Dimension parameter",
           dimension,
           Names{"bruggeman", "critical fraction", "from threshold"})
      .meaning =
      "n of the effective medium, which seals at the contact fraction 1 - 1/n. "
      "bruggeman: n = 2; critical fraction: n from Critical contact fraction; from "
      "threshold: n such that it seals at the critical load of this run (Load "
      "programme/Find threshold).";
    section.when("Dimension parameter = critical fraction")
      .add("Critical contact fraction", critical_fraction, positive.below(1.))
      .meaning = "contact fraction at which the effective medium seals [1].";
    effect.add("Gamma", gamma, positive.at_most(1.)).meaning =
      "Persson's gamma, the fraction of the elastic energy of full contact that is "
      "stored at low loads [1].";
  }

  void
  OutputParameters::bind(ParameterSection section)
  {
    section
      .add("Directory",
           directory,
           Text{"a folder", [](const std::string &text) { return !text.empty(); }})
      .meaning =
      "Folder of the results, made if it does not exist; a relative path starts at the "
      "current folder.";
    section.add("Fields", fields, Names{"none", "last", "all"}).meaning =
      "Steps whose fields are written: gap, pressure and labels on the grid (HDF5), the "
      "flow on its mesh (VTU).";
    section.add("Pictures", pictures).meaning =
      "Draw a picture of each step and of the leak rate against the load.";
    section.add("Error budget", error_budget).meaning =
      "Estimate also the errors of the leak rate from contact grid (by coarser grids) "
      "and gap interpolation, those of blow-out and re-sealing pressures and, where "
      "states depend on the load path, of critical loads; about doubles the time.";
    section.add("Checkpoint", checkpoint).meaning =
      "Keep after every step what --resume needs to continue the run. It takes 20 bytes "
      "a grid point on the disk for a dry contact, 28 with adhesion, 8 more with Wall "
      "feedback or Yielding, and the time to write that.";
    section.add("Surface map", surface_map).meaning =
      "Write the processed surface on the grid as NetCDF (surface.nc) and, at the end, "
      "as a contact that yields has left it (surface-indented.nc).";
    section.add("Surface spectrum", surface_spectrum).meaning =
      "Write and draw the spectrum of the surface (spectrum.csv).";
    section.add("Report", report).meaning =
      "Write report.html: scene, results, limits, pictures and errors on one page that "
      "needs no other file.";
    section
      .add("Leak rate units",
           leak_rate_units,
           Text{"some of: " + names_in(strait::leak_rate_units),
                [](const std::string &name) {
                  return find_row(strait::leak_rate_units, name) != nullptr;
                }})
      .meaning =
      "Add columns with the leak rate in these customary units; needs the section Units. "
      "The last four are throughputs of a gas, for Fluid/State = gas.";
  }
} // namespace strait
