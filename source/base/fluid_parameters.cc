// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/fluid_parameters.h>
#include <strait/base/parameter_table.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<FlowDirection> directions = {{FlowDirection::x, "x"},
                                               {FlowDirection::y, "y"}};

    const Choices<FlowPreconditioner> preconditioners = {{FlowPreconditioner::boomeramg,
                                                          "boomeramg"},
                                                         {FlowPreconditioner::ml, "ml"}};

    const Choices<GapInterpolation> interpolations = {
      {GapInterpolation::monotone_cubic, "monotone cubic"},
      {GapInterpolation::bilinear, "bilinear"}};

    const Choices<FlowBounds> bound_kinds = {{FlowBounds::asymptotic, "asymptotic"},
                                             {FlowBounds::rigorous, "rigorous"}};

    const Choices<Refinement> refinements = {{Refinement::adaptive, "adaptive"},
                                             {Refinement::uniform, "uniform"}};
  } // namespace

  void
  FluidParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const FluidParameters standard;
    prm.enter_subsection("Fluid");
    prm.declare_entry("Enabled",
                      "true",
                      Bool(),
                      "Let a fluid leak through the gap. false: contact only.");
    prm.declare_entry(
      "State",
      "liquid",
      Selection("liquid|gas"),
      "gas: pressures are absolute, leak_rate is the volume flow at their "
      "mean, and throughputs may be asked for with Output/Leak rate "
      "units. The flow is viscous in either case.");
    prm.declare_entry("Viscosity",
                      to_text(standard.viscosity),
                      Double(),
                      "eta: dynamic viscosity of the fluid [pressure * time].");
    prm.declare_entry("Inlet pressure",
                      to_text(standard.inlet_pressure),
                      Double(),
                      "Fluid pressure at the inlet, x = 0 or y = 0 [pressure].");
    prm.declare_entry("Outlet pressure",
                      to_text(standard.outlet_pressure),
                      Double(),
                      "Fluid pressure at the outlet, x = Lx or y = Ly [pressure].");
    prm.declare_entry(
      "Slip length",
      "0",
      List(Double(), 1),
      "d0, zero or negative: the conductivity is (g - 2|d0|)^3 / (12 eta), "
      "zero where the gap g is below 2|d0| [length]. Of several values each gets "
      "its own row at each load; the contact is solved once.");
    prm.declare_entry("Direction",
                      directions.name(standard.direction),
                      Selection(directions.pattern()),
                      "The direction of the mean flow; the box is periodic across it.");
    prm.declare_entry(
      "Mesh",
      "",
      FileName(),
      "Gmsh file (MSH 4.1, ASCII, quadrilaterals) of the part of the box where the fluid "
      "flows, with boundary ids 0 inlet, 1 outlet; all else is impermeable. Empty: the "
      "whole box, periodic across Direction.");
    prm.declare_entry(
      "Element degree",
      std::to_string(standard.element_degree),
      Integer(),
      "Polynomial degree of the fluid pressure, 1 or 2 [1]; 1 is the robust "
      "choice on rough gaps.");
    prm.declare_entry("Preconditioner",
                      preconditioners.name(standard.preconditioner),
                      Selection(preconditioners.pattern()),
                      "Algebraic multigrid of the flow equations: hypre's BoomerAMG or "
                      "Trilinos' ML.");
    prm.declare_entry("Gap interpolation",
                      interpolations.name(standard.interpolation),
                      Selection(interpolations.pattern()),
                      "The gap between the grid points.");
    prm.declare_entry(
      "Refinement",
      refinements.name(standard.refinement),
      Selection(refinements.pattern()),
      "adaptive: refine where the leak rate is decided; uniform: refine all "
      "cells.");
    prm.declare_entry(
      "Target accuracy",
      to_text(standard.target_accuracy),
      Double(),
      "Relative accuracy of the leak rate at which refinement stops, between "
      "0 and 1 [1].");
    prm.declare_entry(
      "Maximum unknowns",
      std::to_string(standard.maximum_unknowns),
      Integer(),
      "Refinement stops before the flow has more unknowns than this, the first mesh "
      "apart [1].");
    prm.declare_entry(
      "Bounds",
      bound_kinds.name(standard.bounds),
      Selection(bound_kinds.pattern()),
      "The leak rate's bounds. asymptotic: the conductivity is integrated by Gauss "
      "quadrature, which is accurate, but where the gap closes proves nothing; "
      "rigorous: its largest and smallest value in each quarter of a grid spacing "
      "take its place, so that the true value for the interpolated gap lies between "
      "the bounds, which cannot come as close.");
    FeedbackParameters::declare(prm);
    prm.leave_subsection();
  }

  void
  FluidParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Fluid");
    enabled          = prm.get_bool("Enabled");
    is_gas           = prm.get("State") == "gas";
    viscosity        = prm.get_double("Viscosity");
    inlet_pressure   = prm.get_double("Inlet pressure");
    outlet_pressure  = prm.get_double("Outlet pressure");
    slip_lengths     = parse_numbers(prm.get("Slip length"));
    direction        = directions.value(prm.get("Direction"));
    mesh_file        = prm.get("Mesh");
    element_degree   = static_cast<unsigned int>(prm.get_integer("Element degree"));
    preconditioner   = preconditioners.value(prm.get("Preconditioner"));
    interpolation    = interpolations.value(prm.get("Gap interpolation"));
    refinement       = refinements.value(prm.get("Refinement"));
    target_accuracy  = prm.get_double("Target accuracy");
    maximum_unknowns = static_cast<unsigned int>(prm.get_integer("Maximum unknowns"));
    bounds           = bound_kinds.value(prm.get("Bounds"));
    feedback.parse(prm);
    prm.leave_subsection();
  }

  void
  FluidParameters::check() const
  {
    if (!(viscosity > 0.))
      throw InputError("Fluid/Viscosity is " + to_text(viscosity) +
                       " but must be positive.");
    if (enabled && inlet_pressure == outlet_pressure && !feedback.enabled)
      throw InputError("Fluid/Inlet pressure and Outlet pressure are both " +
                       to_text(inlet_pressure) +
                       ", so nothing drives a flow; change one or set Fluid/Enabled = "
                       "false.");
    if (is_gas && (inlet_pressure < 0. || outlet_pressure < 0.))
      throw InputError(
        "Fluid/State = gas needs absolute pressures, but Inlet or Outlet pressure is "
        "negative.");
    for (const double slip_length : slip_lengths)
      if (!(slip_length <= 0.))
        throw InputError("Fluid/Slip length is " + to_text(slip_length) +
                         " but only zero or negative values are supported.");
    if (element_degree < 1 || element_degree > 2)
      throw InputError("Fluid/Element degree is " +
                       std::to_string(static_cast<int>(element_degree)) +
                       " but must be 1 or 2.");
    if (!(target_accuracy > 0. && target_accuracy < 1.))
      throw InputError("Fluid/Target accuracy is " + to_text(target_accuracy) +
                       " but must lie between 0 and 1.");
    if (static_cast<int>(maximum_unknowns) < 1)
      throw InputError("Fluid/Maximum unknowns is " +
                       std::to_string(static_cast<int>(maximum_unknowns)) +
                       " but must be at least 1.");
    if (enabled && !mesh_file.empty() && direction != FlowDirection::x)
      throw InputError(
        "Fluid/Direction = y goes without Fluid/Mesh: the boundary ids of "
        "the mesh say where inlet and outlet are; leave it at x.");
    if (enabled && !mesh_file.empty() && bounds == FlowBounds::rigorous)
      throw InputError(
        "Fluid/Bounds = rigorous needs the cells of the contact grid, which Fluid/Mesh "
        "replaces; set Bounds = asymptotic.");
    if (enabled && !mesh_file.empty() && feedback.enabled)
      throw InputError(
        "Fluid/Wall feedback and Fluid/Mesh cannot be used together yet; switch one of "
        "them off.");
    feedback.check();
  }
} // namespace strait
