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

  /** What fluid that no reservoir reaches does, and by which law. */
  enum class TrappedFluidLaw
  {
    drained,        // it has the pool pressure: the seal was assembled dry
    incompressible, // it keeps its volume
    compressible,   // a liquid that keeps its mass
    gas             // likewise, of constant pressure times volume
  };

  /** The subsection Fluid/Wall feedback: the fluid presses the walls apart. */
  struct FeedbackParameters
  {
    bool   enabled            = false;
    double tolerance          = 1e-4; // of leak rate and fluid pressure
    int    maximum_iterations = 200;
    bool   plain_rounds       = false; // not combined by Anderson's method
    double relaxation         = 1.;
    double pool_pressure      = 0.;

    TrappedFluidLaw trapped_fluid      = TrappedFluidLaw::drained;
    double          bulk_modulus       = 0.; // at pressure 0; 0: not known
    double          bulk_modulus_slope = 0.; // its derivative by the pressure
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

  /** Where the mean flow goes; the box is periodic across it. */
  enum class FlowDirection
  {
    x,
    y
  };

  /** The algebraic multigrid that preconditions the flow. */
  enum class FlowPreconditioner
  {
    boomeramg,
    ml
  };

  /** How the gap runs between grid points. */
  enum class GapInterpolation
  {
    monotone_cubic,
    bilinear
  };

  /** What becomes of a gas where its mean free path is no longer small beside the gap. */
  enum class Rarefaction
  {
    none,        // it is viscous throughout
    slip,        // it slips along the walls, to first order
    transitional // from viscous to molecular, by kinetic theory
  };

  /** The section Fluid of a scene: Reynolds flow through the gap. */
  struct FluidParameters
  {
    bool        enabled = true;
    bool        is_gas  = false;
    std::string gas;                      // names a row of a table of gases, or empty
    double      molar_mass      = 0.;     // [kg/mol]; 0: not known
    double      temperature     = 293.15; // [K]
    Rarefaction rarefaction     = Rarefaction::none;
    double      accommodation   = 1.; // of a gas that slips [1]
    double      thermal_speed   = 0.; // √(2RT/M) in the scene's units; 0: not known
    double      surface_tension = 0.; // 0: not known
    double      viscosity       = 1.;
    double      inlet_pressure  = 1.;
    double      outlet_pressure = 0.;
    std::vector<double> slip_lengths = {0.}; // <= 0, one row of results for each
    FlowDirection       direction    = FlowDirection::x;
    std::string         mesh_file; // empty: the whole box
    unsigned int        element_degree     = 1;
    FlowPreconditioner  preconditioner     = FlowPreconditioner::boomeramg;
    GapInterpolation    interpolation      = GapInterpolation::monotone_cubic;
    bool                uniform_refinement = false; // of all cells, not the marked ones
    double              target_accuracy    = 0.02;
    unsigned int        maximum_unknowns   = 1000000;
    FeedbackParameters  feedback;
    bool                rigorous_bounds = false; // from extremes, not by Gauss quadrature

    /** Whether some slip length is not zero. */
    bool
    has_slip() const
    {
      return std::any_of(slip_lengths.begin(),
                         slip_lengths.end(),
                         [](const double slip_length) { return slip_length != 0.; });
    }

    /** (p_in + p_out)/2, at which the volume of a gas is counted [pressure]. */
    double
    mean_pressure() const
    {
      return .5 * (inlet_pressure + outlet_pressure);
    }

    /** The largest pressure of the fluid above that outside of the seal [pressure]: of a
     *  liquid, whose pressures count from there, the larger one of the two reservoirs; of
     *  a gas, whose pressures are absolute, the difference of the two. */
    double
    excess_pressure() const
    {
      return is_gas ? std::abs(inlet_pressure - outlet_pressure)
                    : std::max(inlet_pressure, outlet_pressure);
    }

    void bind(ParameterSection section);

    /** Where a gas is named, take its molar mass and, unless the scene gives one, its
     *  viscosity in the scene's @p units; of any gas find the thermal speed. Throws
     *  InputError where that contradicts the other values. */
    void take_gas(const UnitParameters &units);
    void check() const;
  };

  /** What a leak rate in the scene's units is in @p unit. A throughput is that rate times
   *  the mean of the two pressures: exact for an ideal gas at one temperature in viscous
   *  flow, because ∫ K p dp = K (p_in² − p_out²)/2. */
  double in_trade_unit(double                 leak_rate,
                       const LeakRateUnit    &unit,
                       const UnitParameters  &units,
                       const FluidParameters &fluid);
} // namespace strait
