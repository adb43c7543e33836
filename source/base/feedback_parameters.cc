// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/fluid_parameters.h>
#include <strait/base/parameter_table.h>

#include <algorithm>

namespace strait
{
  void
  FeedbackParameters::bind(ParameterSection section)
  {
    section.add(
      "Enabled",
      enabled,
      "Let the fluid press the walls apart: contact and flow are solved in turn "
      "until they agree. The pressures of the fluid then count from that outside "
      "the seal, which the load is measured against.");
    section.add(
      "Tolerance",
      tolerance,
      positive.below(1.),
      "Relative change of the leak rate, and change of the fluid pressure (rms, over that "
      "of a reservoir or its own, whichever is more), below which contact and flow agree "
      "[1].");
    section.add(
      "Maximum iterations",
      maximum_iterations,
      any_number.at_least(1),
      "Rounds of contact and flow after which a step counts as not converged [1].");
    section.add(
      "Acceleration",
      acceleration,
      Names<Acceleration>(
        {{Acceleration::anderson, "anderson"}, {Acceleration::none, "none"}}),
      "anderson: combine the last rounds such that the change would be smallest; "
      "none: take the pressure of the last round.");
    section.add("Relaxation",
                relaxation,
                positive.at_most(1.),
                "Share of a change of the fluid pressure that is taken [1].");
    section.add(
      "Pool pressure",
      pool_pressure,
      any_number,
      "Fluid pressure in open regions that no reservoir reaches; 0: they are dry "
      "[pressure]. Where trapped fluid is not drained, that in which it is found at the "
      "start of a path.");
    section.add(
      "Trapped fluid",
      trapped_fluid,
      Names<TrappedFluidLaw>({{TrappedFluidLaw::drained, "drained"},
                              {TrappedFluidLaw::incompressible, "incompressible"},
                              {TrappedFluidLaw::compressible, "compressible"},
                              {TrappedFluidLaw::gas, "gas"}}),
      "What becomes of fluid that is cut off from its reservoirs. drained: it has Pool "
      "pressure, as in a seal that was assembled dry; otherwise it keeps its mass along "
      "the load path. incompressible: it keeps its volume; compressible: a liquid of Bulk "
      "modulus; gas: pressure times volume stays.");
    section.add("Bulk modulus",
                bulk_modulus,
                not_negative,
                "Of trapped fluid that is compressible, at pressure 0 [pressure].");
    section.add("Bulk modulus slope",
                bulk_modulus_slope,
                not_negative,
                "Derivative of the bulk modulus by the pressure [1].");
    section.add(
      "Vapour pressure",
      vapour_pressure,
      any_number,
      "Trapped liquid that has too much room forms a cavity of this pressure; it "
      "counts like all pressures from that outside the seal [pressure].");
  }

  void
  FeedbackParameters::check(const bool is_gas) const
  {
    if (trapped_fluid == TrappedFluidLaw::gas && !is_gas)
      throw InputError(
        "Fluid/Wall feedback/Trapped fluid = gas needs absolute pressures; "
        "set Fluid/State = gas, or Trapped fluid = compressible.");
    if (trapped_fluid == TrappedFluidLaw::gas && pool_pressure < 0.)
      throw InputError(
        "Fluid/Wall feedback/Pool pressure is negative, but that of a gas is absolute; "
        "raise it.");
    if (trapped_fluid != TrappedFluidLaw::compressible)
      return;
    if (!(bulk_modulus > 0.))
      throw InputError(
        "Fluid/Wall feedback/Trapped fluid = compressible needs Bulk "
        "modulus; give it, or set Trapped fluid = incompressible.");
    const double least = std::min(vapour_pressure, pool_pressure);
    if (!(bulk_modulus + bulk_modulus_slope * least > 0.))
      throw InputError(
        "Fluid/Wall feedback/Bulk modulus is not positive at Vapour pressure or Pool "
        "pressure; raise these or Bulk modulus.");
  }
} // namespace strait
