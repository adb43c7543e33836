// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_branch_follower_h
#define strait_driver_branch_follower_h

#include <strait/base/contact_parameters.h>
#include <strait/base/log.h>
#include <strait/contact/contact_model.h>

#include <optional>
#include <utility>
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

  /**
   * Follows the states of an adhesive contact from load to load.
   *
   * The energy H at equilibrium changes with the load p as dH/dp = mean gap, so that
   * a smooth step changes it by no less than the smaller of the mean gaps at its ends
   * times the change of the load (under gap control the same with the pressure, −p).
   * Less is proof of a jump. A change far from the trapezoidal rule is suspicious, and so
   * is a contact area or mean gap that changes much faster than before. Such a step is
   * halved, from its first state, until the halves are smooth or shorter than the
   * tolerance.
   */
  class BranchFollower
  {
  public:
    /** @p tolerance: in units of the load, 0 to take every step as it is. @p model
     *  and @p log must outlive this object. */
    BranchFollower(ContactModel  &model,
                   ContactControl control,
                   double         tolerance,
                   Log           &log);

    /** Where a step ended. */
    struct Arrival
    {
      std::optional<ContactState> state;          // none: the surfaces part before
      double                      dissipated = 0; // by jumps on the way [energy/area]
    };

    /** Go to the load (or mean gap) @p target. Costs in the state are those of all
     *  steps on the way. Collective. */
    Arrival go_to(double target);

    /** The next step begins a new path. */
    void begin_anew();

    /** The path so far, and that of the model. Collective. */
    void transfer(StateArchive &archive);

    /** All jumps so far, on all paths. */
    const std::vector<Jump> &
    jumps() const
    {
      return all_jumps;
    }

  private:
    /** Changes with the load. */
    struct Trend
    {
      double area;  // of the contact area
      double slope; // of the slope of the energy
    };

    bool                      is_smooth(const PathPoint &to) const;
    double                    slope_at(const PathPoint &point) const;
    std::pair<double, double> reversible_rise(const PathPoint &to) const;
    void note_jump(const PathPoint &to, bool is_pull_off, Arrival &arrival);

    ContactModel            &model;
    const ContactControl     control;
    const double             tolerance;
    Log                     &log;
    std::optional<PathPoint> last;
    std::optional<Trend>     trend;             // of the last step
    double                   largest_slope = 0; // of the energy, so far
    std::vector<Jump>        all_jumps;
  };
} // namespace strait

#endif
