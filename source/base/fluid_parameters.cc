// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/fluid_parameters.h>
#include <strait/base/parameter_table.h>
#include <strait/base/units.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    struct Gas
    {
      const char *name;
      double      molar_mass; // kg/mol
      double      viscosity;  // Pa s, at 293.15 K
    };

    constexpr Gas gases[] = {{"helium", 4.0026e-3, 19.6e-6},
                             {"air", 28.965e-3, 18.13e-6},
                             {"nitrogen", 28.0134e-3, 17.58e-6},
                             {"hydrogen", 2.0159e-3, 8.8e-6},
                             {"argon", 39.948e-3, 22.3e-6}};

    void
    check_rarefaction(const FluidParameters &fluid)
    {
      if (fluid.rarefaction == Rarefaction::none)
        return;
      require(fluid.is_gas && fluid.molar_mass != 0.,
              "Fluid/Rarefaction needs a gas whose molecules are known; set "
              "Fluid/State = gas and Fluid/Gas or Molar mass.");
      require(
        !fluid.has_slip(),
        "Fluid/Slip length is an immobile layer of a liquid and Fluid/Rarefaction the slip "
        "of a gas; give one of them.");
      require(
        !fluid.feedback.enabled,
        "Fluid/Wall feedback takes the fluid's pressure from a linear problem, which that "
        "of a rarefied gas does not solve; switch it off or set Fluid/Rarefaction = none.");
      require(fluid.rarefaction != Rarefaction::transitional || fluid.accommodation == 1.,
              "Fluid/Rarefaction = transitional is for walls that reflect diffusely; set "
              "Fluid/Accommodation = 1, or Rarefaction = slip.");
    }
  } // namespace

  void
  FeedbackParameters::bind(ParameterSection section)
  {
    section.add("Enabled", enabled).meaning =
      "Let the fluid press the walls apart: contact and flow are solved in turn until "
      "they agree. The pressures of the fluid are then relative to the pressure outside "
      "the seal, as the load is.";
    ParameterSection effect = section.when("Enabled = true");
    effect.add("Tolerance", tolerance, positive.below(1.)).meaning =
      "Contact and flow agree where the fluid pressure changes by less than this in a "
      "round [1]: rms change over the pressure of a reservoir, over the load if "
      "reservoirs have none, or over its own rms if that is more. The leak rate then "
      "changes by less than this or a tenth of Fluid/Target accuracy, whichever is more.";
    effect.add("Maximum iterations", maximum_iterations, any_number.at_least(1)).meaning =
      "Rounds of contact and flow after which a step counts as not converged [1].";
    effect.add("Acceleration", plain_rounds, Names{"anderson", "none"}).meaning =
      "anderson: combine the last rounds such that the change of the pressure would be "
      "smallest; none: take the pressure of the last round.";
    effect.add("Relaxation", relaxation, positive.at_most(1.)).meaning =
      "Fraction of the change of the fluid pressure that a round takes [1].";
    effect.add("Pool pressure", pool_pressure, any_number).meaning =
      "Fluid pressure in open regions that no reservoir reaches [pressure]; 0: they are "
      "dry. If Trapped fluid is not drained, the pressure of the fluid that is trapped "
      "at the start of a path.";
    effect
      .add("Trapped fluid",
           trapped_fluid,
           Names{"drained", "incompressible", "compressible", "gas"})
      .meaning =
      "Behaviour of fluid that is cut off from its reservoirs. drained: it has Pool "
      "pressure, as in a seal that was assembled dry. Otherwise it keeps its mass along "
      "the load path; incompressible: its volume stays; compressible: it is a liquid of "
      "Bulk modulus; gas: pressure times volume stays.";
    ParameterSection elastic = effect.when("Trapped fluid = compressible");
    elastic.add("Bulk modulus", bulk_modulus, not_negative).meaning =
      "bulk modulus of the trapped liquid at pressure 0 [pressure].";
    elastic.add("Bulk modulus slope", bulk_modulus_slope, not_negative).meaning =
      "derivative of the bulk modulus with respect to the pressure [1].";
    effect.when("Trapped fluid = incompressible, compressible")
      .add("Vapour pressure", vapour_pressure, any_number)
      .meaning =
      "pressure of the cavity that trapped liquid forms where it has too much room "
      "[pressure]; like all pressures it is relative to that outside the seal.";
  }

  void
  FeedbackParameters::check(const bool is_gas, const double least_of_reservoirs) const
  {
    require(trapped_fluid != TrappedFluidLaw::gas || is_gas,
            "Fluid/Wall feedback/Trapped fluid = gas needs absolute pressures; "
            "set Fluid/State = gas, or Trapped fluid = compressible.");
    require(!is_gas || trapped_fluid == TrappedFluidLaw::gas ||
              trapped_fluid == TrappedFluidLaw::drained,
            "Fluid/Wall feedback/Trapped fluid is a liquid, and Fluid/State = gas; set "
            "Trapped fluid = gas or drained.");
    require(
      trapped_fluid != TrappedFluidLaw::gas || !(pool_pressure < 0.),
      "Fluid/Wall feedback/Pool pressure is negative, but that of a gas is absolute; "
      "raise it.");
    const double least = std::min(pool_pressure, least_of_reservoirs);
    require(!keeps_trapped_fluid() || is_gas || vapour_pressure <= least,
            "Fluid/Wall feedback/Vapour pressure is " + to_text(vapour_pressure) +
              ", but the least of Inlet, Outlet and Pool pressure " + to_text(least) +
              ", where the liquid would be vapour; lower Vapour pressure or raise that.");
    if (trapped_fluid != TrappedFluidLaw::compressible)
      return;
    require(bulk_modulus > 0.,
            "Fluid/Wall feedback/Trapped fluid = compressible needs Bulk "
            "modulus; give it, or set Trapped fluid = incompressible.");
    require(bulk_modulus + bulk_modulus_slope * vapour_pressure > 0.,
            "Fluid/Wall feedback/Bulk modulus is not positive at Vapour pressure, " +
              to_text(vapour_pressure) + "; raise that or Bulk modulus.");
  }

  void
  FluidParameters::bind(ParameterSection section)
  {
    section.add("Enabled", enabled).meaning =
      "Let a fluid leak through the gap. false: contact only.";
    ParameterSection theory_too = section.when("Enabled = true | Theory/Enabled = true");
    ParameterSection effect     = section.when("Enabled = true");
    theory_too.add("State", is_gas, Names{"liquid", "gas"}).meaning =
      "gas: pressures are absolute, leak_rate is the volume flow at the mean of both "
      "pressures, and Output/Leak rate units may ask for throughputs. Liquid and gas are "
      "viscous unless Rarefaction says otherwise.";
    theory_too
      .add("Gas",
           gas,
           Text{names_in(gases) + ", or empty",
                [](const std::string &name) {
                  return name.empty() || find_row(gases, name) != nullptr;
                }})
      .meaning =
      "Name of the gas, which gives its molar mass and, unless Viscosity is given and "
      "not 1, its viscosity at 293.15 K; needs the section Units. The column validity "
      "then tells where it is rarefied.";
    theory_too.add("Molar mass", molar_mass, not_negative).meaning =
      "M: molar mass of a gas that Gas does not know [kg/mol]; needs the section Units. "
      "0: not known.";
    theory_too.when("State = gas")
      .when("Gas | Molar mass | Output/Leak rate units")
      .add("Temperature", temperature, positive)
      .meaning = "T: temperature of the gas, for mean free path and volume in sccm [K].";
    theory_too.add("Rarefaction", rarefaction, Names{"none", "slip", "transitional"})
      .meaning =
      "Model of a gas; needs Gas or Molar mass. none: it is viscous in any gap; slip: it "
      "slips along the walls, to first order in the mean free path over the gap; "
      "transitional: from viscous to molecular flow, by the linearised BGK equation "
      "between walls that reflect diffusely.";
    theory_too.when("Rarefaction = slip, transitional")
      .add("Accommodation", accommodation, positive.at_most(1.))
      .meaning =
      "alpha: fraction of the molecules that the walls reflect diffusely [1]. The slip "
      "coefficient is 1.1466 (2 - alpha)/alpha; values other than 1 need Rarefaction = "
      "slip.";
    effect.when("State = liquid")
      .add("Surface tension", surface_tension, not_negative)
      .meaning =
      "gamma: surface tension of the liquid [energy/area]; 0: not known. The column "
      "validity compares the pressure across a meniscus in the throat with the one that "
      "drives the flow.";
    theory_too.add("Viscosity", viscosity, positive).meaning =
      "eta: dynamic viscosity of the fluid [pressure * time]; at its default, that of a "
      "named Gas is taken.";
    theory_too.add("Inlet pressure", inlet_pressure, any_number).meaning =
      "Fluid pressure at the inlet, x = 0 or y = 0 [pressure].";
    theory_too.add("Outlet pressure", outlet_pressure, any_number).meaning =
      "Fluid pressure at the outlet, x = Lx or y = Ly [pressure].";
    theory_too.add("Slip length", slip_lengths, any_number.at_most(0.)).meaning =
      "d0, zero or negative: the conductivity is (g - 2|d0|)^3 / (12 eta), and zero "
      "where the gap g is below 2|d0| [length]. Each of several values gets its own row "
      "at each load; the contact is solved once.";
    theory_too.add("Direction", direction, Names{"x", "y"}).meaning =
      "Direction of the mean flow; the box is periodic across it.";
    theory_too.add_path("Mesh", mesh_file).meaning =
      "Gmsh file (MSH 4.1, ASCII, quadrilaterals) of the part of the box where the fluid "
      "flows, with boundary ids 0 for inlet and 1 for outlet; all else is impermeable. "
      "Empty: the whole box, periodic across Direction.";
    effect.add("Element degree", element_degree, any_number.at_least(1).at_most(2))
      .meaning =
      "Polynomial degree of the fluid pressure [1]; 1 is the robust choice on rough "
      "gaps.";
    effect.add("Preconditioner", preconditioner, Names{"boomeramg", "ml"}).meaning =
      "Algebraic multigrid of the flow equations: hypre's BoomerAMG or Trilinos' ML.";
    effect.add("Gap interpolation", interpolation, Names{"monotone cubic", "bilinear"})
      .meaning = "Interpolation of the gap between the grid points.";
    effect.add("Refinement", uniform_refinement, Names{"adaptive", "uniform"}).meaning =
      "adaptive: refine the cells that decide the leak rate; uniform: refine all cells.";
    effect.add("Target accuracy", target_accuracy, positive.below(1.)).meaning =
      "Relative accuracy of the leak rate at which refinement stops [1]. With "
      "Contact/Zoom it is that of all errors together, of which the mesh takes half.";
    effect.add("Maximum unknowns", maximum_unknowns, any_number.at_least(1)).meaning =
      "Refinement stops before the flow has more unknowns than about this [1]; only the "
      "first mesh may have more.";
    effect.add("Bounds", rigorous_bounds, Names{"asymptotic", "rigorous"}).meaning =
      "The bounds of the leak rate come from integrals of the conductivity and of its "
      "reciprocal, taken from above. asymptotic: by Gauss quadrature where the gap is "
      "known to vary little, which is close but proves nothing; rigorous: by the largest "
      "values in parts of each cell, so that the true value for the interpolated gap "
      "lies between the bounds, which cannot come as close.";
    feedback.bind(section.subsection("Wall feedback"));
  }

  void
  FluidParameters::take_gas(const UnitParameters &units)
  {
    require(
      is_gas || (gas.empty() && !(molar_mass > 0.)),
      "Fluid/Gas and Molar mass are of a gas; set Fluid/State = gas, or remove them.");
    const Gas *const known = find_row(gases, gas);
    require(known == nullptr || !(molar_mass > 0.),
            "Fluid/Gas and Molar mass are both given; remove one.");
    if (known != nullptr)
      molar_mass = known->molar_mass;
    require(
      !(molar_mass > 0.) || units.are_complete(),
      "Fluid/Gas and Molar mass are in SI units, whatever the scene's are; give the "
      "section Units, with Length, Pressure and Time.");
    constexpr double gas_constant = 8.314462618; // J/(mol K)
    if (molar_mass > 0.)
      thermal_speed = std::sqrt(2. * gas_constant * temperature / molar_mass) *
                      *seconds_in(units.time) / *metres_in(units.length);
    if (known == nullptr || viscosity != FluidParameters().viscosity)
      return;
    require(temperature == FluidParameters().temperature,
            "Fluid/Gas knows the viscosity of " + gas +
              " at 293.15 K only; give Fluid/Viscosity at the temperature.");
    viscosity =
      known->viscosity / (*pascals_in(units.pressure) * *seconds_in(units.time));
  }

  void
  FluidParameters::check() const
  {
    check_rarefaction(*this);
    if (feedback.enabled)
      feedback.check(is_gas, std::min(inlet_pressure, outlet_pressure));
    require(!slip_lengths.empty(),
            "Fluid/Slip length is empty; give 0 for a fluid that does not slip.");
    require(!has_repetitions(slip_lengths),
            "Fluid/Slip length lists a value twice; remove the copy.");
    require(!enabled || inlet_pressure != outlet_pressure || feedback.enabled,
            "Fluid/Inlet pressure and Outlet pressure are both " +
              to_text(inlet_pressure) +
              ", so nothing drives a flow; change one or set Fluid/Enabled = false.");
    require(!is_gas || !(inlet_pressure < 0. || outlet_pressure < 0.),
            "Fluid/State = gas needs absolute pressures, but Inlet or Outlet pressure is "
            "negative.");
    if (!enabled || mesh_file.empty())
      return;
    require(direction == FlowDirection::x,
            "Fluid/Direction = y goes without Fluid/Mesh: the boundary ids of "
            "the mesh say where inlet and outlet are; leave it at x.");
    require(
      !rigorous_bounds,
      "Fluid/Bounds = rigorous needs the cells of the contact grid, which Fluid/Mesh "
      "replaces; set Bounds = asymptotic.");
    require(
      !feedback.enabled,
      "Fluid/Wall feedback and Fluid/Mesh cannot be used together yet; switch one of "
      "them off.");
  }

  double
  in_trade_unit(const double           leak_rate,
                const LeakRateUnit    &unit,
                const UnitParameters  &units,
                const FluidParameters &fluid)
  {
    double in_si = leak_rate * std::pow(metres_in(units.length).value_or(1.), 3) /
                   seconds_in(units.time).value_or(1.);
    if (unit.is_throughput)
      in_si *= fluid.mean_pressure() * pascals_in(units.pressure).value_or(1.);
    // sccm counts the volume of the gas at 0 °C instead of at its own temperature.
    if (std::string(unit.name) == "sccm")
      in_si *= 273.15 / fluid.temperature;
    return in_si / unit.in_si;
  }
} // namespace strait
