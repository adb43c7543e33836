// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace strait
{
  struct ParameterSection;
  struct LeakRateUnit;
  struct UnitParameters;

  /** The behaviour of fluid that no reservoir reaches. */
  enum class TrappedFluidLaw
  {
    drained,        // it has the pool pressure: the seal was assembled dry
    incompressible, // it keeps its volume
    compressible,   // a liquid that keeps its mass
    gas             // keeps its mass; pressure times volume is constant
  };

  /** The subsection Fluid/Wall feedback: the fluid presses the walls apart. */
  struct FeedbackParameters
  {
    bool   enabled            = false;
    double tolerance          = 1e-4; // of leak rate and fluid pressure
    int    maximum_iterations = 200;
    bool   plain_rounds       = false; // true: no Anderson acceleration
    double relaxation         = 1.;
    double pool_pressure      = 0.;

    TrappedFluidLaw trapped_fluid      = TrappedFluidLaw::drained;
    double          bulk_modulus       = 0.; // at pressure 0; 0: not known
    double          bulk_modulus_slope = 0.; // its derivative with respect to pressure
    double          vapour_pressure    = 0.;

    /** Whether fluid that the contact cuts off keeps its mass. */
    bool
    keeps_trapped_fluid() const
    {
      return enabled && trapped_fluid != TrappedFluidLaw::drained;
    }

    void bind(ParameterSection section);
    void check(bool is_gas, double least_of_reservoirs) const;
  };

  /** The direction of the mean flow; the box is periodic across it. */
  enum class FlowDirection
  {
    x,
    y
  };

  /** The algebraic multigrid method that preconditions the flow equations. */
  enum class FlowPreconditioner
  {
    boomeramg,
    ml
  };

  /** How the gap is interpolated between grid points. */
  enum class GapInterpolation
  {
    monotone_cubic,
    bilinear
  };

  /** The model of a gas whose mean free path is not small compared with the gap. */
  enum class Rarefaction
  {
    none,        // viscous flow in any gap
    slip,        // slip along the walls, to first order
    transitional // from viscous to molecular flow, by kinetic theory
  };

  /** The section Fluid of a scene: Reynolds flow through the gap. */
  struct FluidParameters
  {
    bool        enabled = true;
    bool        is_gas  = false;
    std::string gas;                      // name in the table of gases, or empty
    double      molar_mass      = 0.;     // [kg/mol]; 0: not known
    double      temperature     = 293.15; // [K]
    Rarefaction rarefaction     = Rarefaction::none;
    double      accommodation   = 1.; // for Rarefaction::slip [1]
    double      thermal_speed   = 0.; // √(2RT/M) in the scene's units; 0: not known
    double      surface_tension = 0.; // 0: not known
    double      viscosity       = 1.;
    double      inlet_pressure  = 1.;
    double      outlet_pressure = 0.;
    std::vector<double> slip_lengths = {0.}; // <= 0; one row of results for each
    FlowDirection       direction    = FlowDirection::x;
    std::string         mesh_file; // empty: the whole box
    unsigned int        element_degree     = 1;
    FlowPreconditioner  preconditioner     = FlowPreconditioner::boomeramg;
    GapInterpolation    interpolation      = GapInterpolation::monotone_cubic;
    bool                uniform_refinement = false; // true: refine all cells
    double              target_accuracy    = 0.02;
    unsigned int        maximum_unknowns   = 1000000;
    FeedbackParameters  feedback;
    bool                rigorous_bounds = false; // by extremes, not by Gauss quadrature

    /** Whether some slip length is not zero. */
    bool
    has_slip() const
    {
      return std::any_of(slip_lengths.begin(),
                         slip_lengths.end(),
                         [](const double slip_length) { return slip_length != 0.; });
    }

    /** (p_in + p_out)/2, at which the volume flow of a gas is given [pressure]. */
    double
    mean_pressure() const
    {
      return .5 * (inlet_pressure + outlet_pressure);
    }

    /** The largest excess of the fluid's pressure over that outside the seal [pressure].
     *  Liquid pressures are relative to the outside, so it is the larger one of the two
     *  reservoirs; those of a gas are absolute, so it is their difference. */
    double
    excess_pressure() const
    {
      return is_gas ? std::abs(inlet_pressure - outlet_pressure)
                    : std::max(inlet_pressure, outlet_pressure);
    }

    void bind(ParameterSection section);

    /** If the scene names a gas, take its molar mass and, unless the scene gives a
     *  viscosity, its viscosity in the scene's @p units. From the molar mass compute the
     *  thermal speed. Throws InputError if that contradicts the other values. */
    void take_gas(const UnitParameters &units);
    void check() const;
  };

  /** Convert a leak rate from the scene's units to @p unit. A throughput is the leak rate
   *  times the mean of the two pressures: exact for an ideal gas at one temperature in
   *  viscous flow, because ∫ K p dp = K (p_in² − p_out²)/2. */
  double in_trade_unit(double                 leak_rate,
                       const LeakRateUnit    &unit,
                       const UnitParameters  &units,
                       const FluidParameters &fluid);
} // namespace strait
