// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/feedback_parameters.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<Acceleration> accelerations = {{Acceleration::anderson, "anderson"},
                                                 {Acceleration::none, "none"}};
  } // namespace

  void
  FeedbackParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const FeedbackParameters standard;
    prm.enter_subsection("Wall feedback");
    prm.declare_entry("Enabled",
                      "false",
                      Bool(),
                      "Let the fluid press the walls apart: contact and flow are solved "
                      "in turn until they agree. The pressures of the fluid then count "
                      "from that outside the seal, which the load is measured against.");
    prm.declare_entry("Tolerance",
                      to_text(standard.tolerance),
                      Double(),
                      "Relative change of the leak rate, and change of the fluid "
                      "pressure (rms, over its largest value), below which contact and "
                      "flow agree [1].");
    prm.declare_entry("Maximum iterations",
                      std::to_string(standard.maximum_iterations),
                      Integer(),
                      "Rounds of contact and flow after which a step counts as not "
                      "converged [1].");
    prm.declare_entry("Acceleration",
                      accelerations.name(standard.acceleration),
                      Selection(accelerations.pattern()),
                      "anderson: combine the last rounds such that the change would be "
                      "smallest; none: take the pressure of the last round.");
    prm.declare_entry("Relaxation",
                      to_text(standard.relaxation),
                      Double(),
                      "Share of a change of the fluid pressure that is taken, above 0 "
                      "and up to 1 [1].");
    prm.declare_entry("Pool pressure",
                      to_text(standard.pool_pressure),
                      Double(),
                      "Fluid pressure in open regions that no reservoir reaches; 0: they "
                      "are dry [pressure].");
    prm.leave_subsection();
  }

  void
  FeedbackParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Wall feedback");
    enabled            = prm.get_bool("Enabled");
    tolerance          = prm.get_double("Tolerance");
    maximum_iterations = static_cast<int>(prm.get_integer("Maximum iterations"));
    acceleration       = accelerations.value(prm.get("Acceleration"));
    relaxation         = prm.get_double("Relaxation");
    pool_pressure      = prm.get_double("Pool pressure");
    prm.leave_subsection();
  }

  void
  FeedbackParameters::check() const
  {
    const std::string section = "Fluid/Wall feedback/";
    if (!(tolerance > 0. && tolerance < 1.))
      throw InputError(section + "Tolerance is " + to_text(tolerance) +
                       " but must lie between 0 and 1.");
    if (maximum_iterations < 1)
      throw InputError(section + "Maximum iterations is " +
                       std::to_string(maximum_iterations) + " but must be at least 1.");
    if (!(relaxation > 0. && relaxation <= 1.))
      throw InputError(section + "Relaxation is " + to_text(relaxation) +
                       " but must lie above 0 and not above 1.");
  }
} // namespace strait
