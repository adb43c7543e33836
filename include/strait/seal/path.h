// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_path_h
#define strait_seal_path_h

#include <strait/base/contact_parameters.h>
#include <strait/base/log.h>
#include <strait/seal/seal_model.h>

#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** What matters of a state of an adhesive contact on its path. */
  struct PathPoint
  {
    double target       = 0; // nominal pressure, or mean gap under gap control
    double pressure     = 0;
    double mean_gap     = 0;
    double contact_area = 0;
    double energy       = 0; // AdhesiveState::total_energy
  };

  /** A discontinuity: from one state to another at almost the same load. */
  struct Jump
  {
    PathPoint before;
    PathPoint after;               // without meaning at a pull-off
    double    dissipated  = 0;     // energy per area
    bool      is_pull_off = false; // the surfaces part
  };

  /** In either direction. Collective. */
  void transfer(StateArchive &archive, Jump &jump);

  /** How finely jumps are enclosed. */
  struct JumpSearch
  {
    ContactControl control   = ContactControl::load;
    double         tolerance = 0; // in units of the load; 0: every step is taken as it is
  };

  /** Where a step along a path ended. */
  struct Arrival
  {
    std::optional<SealState> state; // none: the surfaces part before
    std::vector<Jump>        jumps; // on the way
  };

  /**
   * Follow the states of @p model from @p from, or without a past if that is null, to the
   * control @p to. Costs in the state are those of all steps on the way. Collective.
   *
   * A dry adhesive contact jumps. Its energy H at equilibrium changes with the load p as
   * dH/dp = mean gap, so that a smooth step changes it by no less than the smaller of the
   * mean gaps at its ends times the change of the load (under gap control the same with
   * the pressure, −p). Less is proof of a jump. A change far from the trapezoidal rule is
   * suspicious, and so is a contact area or mean gap that changes much faster than
   * before. Such a step is halved, from its first state, until the halves are smooth or
   * shorter than the tolerance. Where a fluid presses on the walls there is no such
   * energy, and every step is taken as it is.
   */
  Arrival follow(SealModel        &model,
                 const Control    &to,
                 const SealState  *from,
                 Aim               aim,
                 const JumpSearch &how = {});

  /** One line about a jump for the log. */
  std::string describe(const Jump &jump);
} // namespace strait

#endif
