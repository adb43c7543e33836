// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/seal/stride.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace strait
{
  namespace
  {
    // How many times faster than in the last step the contact area, and the mean gap
    // (or, under gap control, the pressure) may change; of the area how much more. Half
    // of any of them halves steps that are smooth, which costs contact problems; double
    // of it lets jumps pass that change the area or the gap by as little.
    constexpr double steeper_area = 3., free_change_of_area = .01;
    constexpr double steeper = 1.3;

    /** Between the change of the energy and the trapezoidal rule, in units of the
     *  range that the slopes at the ends leave: a smooth path has a twelfth of the
     *  relative step, a jump at a fraction f of the step |f − 1/2|. Half of it halves
     *  steps that are merely long, double of it overlooks jumps nearer to the middle. */
    constexpr double largest_skewness = .025;

    /** What a jump must dissipate, in units of the largest slope and the step; and the
     *  change of the slope itself that is always allowed. Half of it takes the
     * optimiser's tolerance for jumps sooner, double of it overlooks jumps that dissipate
     * so little. */
    constexpr double slope_noise = 1e-3;

    PathPoint
    point_of(const SealState &state)
    {
      const ContactState &contact = *state.contact;
      return {state.control.target,
              contact.nominal_pressure,
              contact.mean_gap,
              contact.contact_area,
              contact.adhesion->total_energy};
    }

    void
    transfer(StateArchive &archive, PathPoint &point)
    {
      archive.values(
        point.target, point.pressure, point.mean_gap, point.contact_area, point.energy);
    }
  } // namespace

  void
  transfer(StateArchive &archive, Jump &jump)
  {
    transfer(archive, jump.before);
    transfer(archive, jump.after);
    archive.values(jump.dissipated, jump.is_pull_off);
  }

  Stride::Stride(const SealState     &from,
                 const SealState     &to,
                 const ContactControl control_)
    : control(control_)
    , before(point_of(from))
    , after(point_of(to))
    , trend(from.trend)
    , largest_slope(std::max(from.trend.largest_slope, std::abs(slope_at(after))))
    , change(after.target - before.target)
    , rise(after.energy - before.energy)
  {
    // How much the energy changes without dissipation, by the slope at either end.
    std::tie(least, most) =
      std::minmax({slope_at(before) * change, slope_at(after) * change});
  }

  bool
  Stride::is_smooth() const
  {
    // The largest slope of the path before: this state may be beyond a jump.
    const double noise = slope_noise * trend.largest_slope * std::abs(change);
    if (rise < least - noise ||
        std::abs(rise - .5 * (least + most)) > largest_skewness * (most - least) + noise)
      return false;
    if (!trend.is_known)
      return true;
    const double area  = std::abs(after.contact_area - before.contact_area);
    const double slope = std::abs(slope_at(after) - slope_at(before));
    return area <= free_change_of_area + steeper_area * std::abs(trend.area * change) &&
           slope <=
             slope_noise * trend.largest_slope + steeper * std::abs(trend.slope * change);
  }

  std::optional<Jump>
  Stride::jump() const
  {
    if (rise >= least) // steep, but no jump
      return {};
    // The load of the jump is unknown within the step: the middle of the slopes.
    return Jump{before, after, .5 * (least + most) - rise, false};
  }

  Jump
  Stride::pull_off() const
  {
    return {before, after, 0., true};
  }

  PathTrend
  Stride::trend_after() const
  {
    PathTrend next     = trend;
    next.largest_slope = largest_slope;
    if (change != 0)
      {
        next.is_known = true;
        next.area     = (after.contact_area - before.contact_area) / change;
        next.slope    = (slope_at(after) - slope_at(before)) / change;
      }
    return next;
  }

  /** dH/dp. */
  double
  Stride::slope_at(const PathPoint &point) const
  {
    return control == ContactControl::load ? point.mean_gap : -point.pressure;
  }

  std::string
  describe(const Jump &jump)
  {
    if (jump.is_pull_off)
      return format("the surfaces part between the nominal pressures %.6g and %.6g",
                    jump.before.target,
                    jump.after.target);
    return format(
      "jump between %.6g and %.6g: contact %.3f %% to %.3f %%, %.4g "
      "dissipated per area",
      jump.before.target,
      jump.after.target,
      100 * jump.before.contact_area,
      100 * jump.after.contact_area,
      jump.dissipated);
  }
} // namespace strait
