// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/base/log.h>
#include <strait/seal/seal_state.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** The part of a state of an adhesive contact that matters for its path. */
  struct PathPoint
  {
    double target       = 0; // nominal pressure, or mean gap under gap control
    double pressure     = 0;
    double mean_gap     = 0;
    double contact_area = 0;
    double energy       = 0;     // AdhesiveState::total_energy
    bool   detached     = false; // gap and area are meaningless
  };

  /** A discontinuity of a path: two different states at almost the same load. */
  struct Jump
  {
    PathPoint before;
    PathPoint after;
    double    dissipated = 0; // energy per area; not a number for a pull-off

    /** Whether the surfaces part. */
    bool
    is_pull_off() const
    {
      return after.detached;
    }

    /** The distance of the two states in what varies along the path. */
    double
    width() const
    {
      return std::abs(after.target - before.target);
    }
  };

  /** One line about a jump for the log. */
  std::string describe(const Jump &jump);

  /** Which steps of a path are too long. */
  struct StepRule
  {
    ContactControl control = ContactControl::load;

    /** Width to which jumps are enclosed, in the unit of the target; 0: they are not. */
    double jump_tolerance = 0;

    /** Fraction of the load that may depend on when in a step fluid was cut off. */
    double trapped_tolerance = std::numeric_limits<double>::infinity();
  };

  /** Where a step along a path ended. */
  struct Arrival
  {
    std::optional<SealState> state; // none: the surfaces part on the way
    std::vector<Jump>        jumps; // on the way
  };

  /**
   * Follow the states of @p model from @p from, or without a past if that is null, to the
   * control @p to. The costs of the state are those of all steps on the way. Collective.
   *
   * A dry adhesive contact jumps. Its energy H at equilibrium changes with the load p as
   * dH/dp = mean gap, so that a smooth step changes it by no less than the smaller of the
   * mean gaps at its ends times the change of the load (under gap control the same with
   * the pressure, −p). A smaller change proves a jump. A change far from the trapezoidal
   * rule is suspicious, and so is a mean gap that changes much faster than before. Such a
   * step is halved, from its first state, until the halves are smooth or shorter than the
   * tolerance.
   *
   * Where a fluid presses on the walls, there is no such energy. There a step is halved,
   * down to a sixteenth, while a channel opens or closes in it, as a large step may do
   * where small ones do not, or while too much of the load depends on when, within the
   * step, fluid was cut off. States on the way are found to the accuracy of a verdict.
   */
  Arrival follow(const SealModel &model,
                 const Control   &to,
                 const SealState *from,
                 Aim              aim,
                 const StepRule  &rule);
} // namespace strait
