// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/scene.h>
#include <strait/base/text.h>
#include <strait/base/theory_parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<TheorySpectrum> spectra = {{TheorySpectrum::model, "model"},
                                             {TheorySpectrum::surface, "surface"}};

    const Choices<TheoryGaps> gap_sources = {{TheoryGaps::persson, "persson"},
                                             {TheoryGaps::simulated, "simulated"}};

    const Choices<TheoryDimension> dimensions = {
      {TheoryDimension::bruggeman, "bruggeman"},
      {TheoryDimension::critical_fraction, "critical fraction"},
      {TheoryDimension::from_threshold, "from threshold"}};

    /** What a run of the theory alone cannot do without. */
    void
    check_alone(const Scene &scene)
    {
      if (scene.contact.control != ContactControl::load)
        throw InputError(
          "Theory/Enabled without Contact and Fluid takes Load programme/"
          "Pressures as loads; set Contact/Control = load.");
      if (scene.programme.pressures.empty())
        throw InputError(
          "Load programme/Pressures is empty; list at least one load for the theory.");
      for (const double pressure : scene.programme.pressures)
        if (!(pressure > 0.))
          throw InputError("Load programme/Pressures contains " + to_text(pressure) +
                           ", at which the theory has no contact; give positive "
                           "nominal pressures.");
    }
  } // namespace

  void
  TheoryParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const TheoryParameters standard;
    prm.enter_subsection("Theory");
    prm.declare_entry(
      "Enabled",
      "false",
      Bool(),
      "Persson's contact theory and an effective medium beside each step. "
      "With Contact and Fluid off they are evaluated alone, for every "
      "load of Load programme/Pressures and without a grid.");
    prm.declare_entry("Spectrum",
                      spectra.name(standard.spectrum),
                      Selection(spectra.pattern()),
                      "model: what a self-affine surface has on average, in closed form; "
                      "surface: that of the heights on the grid.");
    prm.declare_entry("Gap distribution",
                      gap_sources.name(standard.gaps),
                      Selection(gap_sources.pattern()),
                      "The gaps that the effective medium is made of: persson, those of "
                      "the theory; simulated, those of the step.");
    prm.declare_entry(
      "Dimension parameter",
      dimensions.name(standard.dimension),
      Selection(dimensions.pattern()),
      "n of the effective medium, which seals at the contact fraction 1 - 1/n. "
      "bruggeman: n = 2; critical fraction: from the fraction given below; from "
      "threshold: such that it seals at the critical load of this run (Load "
      "programme/Find threshold).");
    prm.declare_entry(
      "Critical contact fraction",
      to_text(standard.critical_fraction),
      Double(),
      "Contact fraction at which the effective medium seals, for Dimension "
      "parameter = critical fraction, between 0 and 1 [1].");
    prm.declare_entry("Gamma",
                      to_text(standard.gamma),
                      Double(),
                      "Persson's gamma, the share of the elastic energy of full contact "
                      "that is stored at low loads, between 0 and 1 [1].");
    prm.leave_subsection();
  }

  void
  TheoryParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Theory");
    enabled           = prm.get_bool("Enabled");
    spectrum          = spectra.value(prm.get("Spectrum"));
    gaps              = gap_sources.value(prm.get("Gap distribution"));
    dimension         = dimensions.value(prm.get("Dimension parameter"));
    critical_fraction = prm.get_double("Critical contact fraction");
    gamma             = prm.get_double("Gamma");
    prm.leave_subsection();
  }

  void
  TheoryParameters::check(const Scene &scene) const
  {
    if (!(critical_fraction > 0. && critical_fraction < 1.))
      throw InputError("Theory/Critical contact fraction is " +
                       to_text(critical_fraction) + " but must lie between 0 and 1.");
    if (!(gamma > 0. && gamma <= 1.))
      throw InputError("Theory/Gamma is " + to_text(gamma) +
                       " but must be positive and at most 1.");
    if (!enabled)
      return;
    const bool simulates = scene.contact.enabled || scene.fluid.enabled;
    if (spectrum == TheorySpectrum::model &&
        scene.surface.kind != SurfaceKind::self_affine)
      throw InputError(
        "Theory/Spectrum = model needs Surface/Kind = self-affine; set "
        "Theory/Spectrum = surface for other kinds.");
    if (gaps == TheoryGaps::simulated && !simulates)
      throw InputError(
        "Theory/Gap distribution = simulated needs a simulation; enable "
        "Contact or Fluid, or take persson.");
    if (gaps == TheoryGaps::persson && simulates && !scene.contact.enabled)
      throw InputError(
        "Theory/Gap distribution = persson needs a load, and with "
        "Contact/Enabled = false there is none; take simulated.");
    if (dimension == TheoryDimension::from_threshold && !scene.programme.find_threshold)
      throw InputError(
        "Theory/Dimension parameter = from threshold needs the critical "
        "load; set Load programme/Find threshold = true.");
    if (dimension == TheoryDimension::from_threshold && gaps == TheoryGaps::simulated &&
        scene.fluid.has_slip())
      throw InputError(
        "Theory/Dimension parameter = from threshold knows the simulated "
        "contact fraction at the threshold, not what a slip length "
        "blocks; take Gap distribution = persson or no slip length.");
    if (!simulates)
      check_alone(scene);
  }
} // namespace strait
