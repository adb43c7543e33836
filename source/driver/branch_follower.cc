// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/driver/branch_follower.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    // How many times faster than in the last step the contact area, and the mean gap
    // (or, under gap control, the pressure) may change, plus how much.
    constexpr double steeper_area = 3., free_change_of_area = .01;
    constexpr double steeper = 1.3, free_change = 1e-3; // the latter of the largest

    /** Between the change of the energy and the trapezoidal rule, in units of the
     *  range that the slopes at the ends leave: a smooth path has a twelfth of the
     *  relative step, a jump at a share f of the step |f − 1/2|. */
    constexpr double largest_skewness = .025;

    /** What a jump must dissipate, in units of the largest slope and the step. */
    constexpr double slope_noise = 1e-3;

    /** Of one step: a rough contact line may move in many small jumps, which together
     *  are not worth more. */
    constexpr int max_solves = 60;

    PathPoint
    point_of(const ContactState &state, const double target)
    {
      return {target,
              state.nominal_pressure,
              state.mean_gap,
              state.contact_area,
              state.adhesion->total_energy};
    }

    void
    transfer_point(StateArchive &archive, PathPoint &point)
    {
      archive.value(point.target);
      archive.value(point.pressure);
      archive.value(point.mean_gap);
      archive.value(point.contact_area);
      archive.value(point.energy);
    }
  } // namespace

  BranchFollower::BranchFollower(ContactModel        &model_,
                                 const ContactControl control_,
                                 const double         tolerance_,
                                 Log                 &log_)
    : model(model_)
    , control(control_)
    , tolerance(tolerance_)
    , log(log_)
  {
  }

  void
  BranchFollower::begin_anew()
  {
    model.forget();
    last.reset();
    trend.reset();
    largest_slope = 0;
  }

  BranchFollower::Arrival
  BranchFollower::go_to(const double target)
  {
    Arrival             arrival;
    std::vector<double> ahead      = {target};
    long                pairs      = 0;
    int                 iterations = 0, n_solves = 0;
    while (!ahead.empty())
      {
        const ContactMemory start = last ? model.memory() : ContactMemory();
        ContactState        state = model.solve(ahead.back());
        pairs += state.fft_pairs;
        iterations += state.iterations;
        const PathPoint point    = point_of(state, ahead.back());
        const bool      detached = state.adhesion->detached;
        if (last && (detached || (tolerance > 0 && !is_smooth(point))))
          {
            const bool may_halve = tolerance > 0 && ++n_solves < max_solves;
            if (may_halve && std::abs(ahead.back() - last->target) > tolerance)
              {
                model.recall(start);
                ahead.push_back(.5 * (ahead.back() + last->target));
                continue;
              }
            note_jump(point, detached, arrival);
          }
        if (detached)
          {
            model.recall(start);
            arrival.state.reset();
            return arrival;
          }
        if (last && point.target != last->target)
          {
            const double change = point.target - last->target;
            trend               = {(point.contact_area - last->contact_area) / change,
                                   (slope_at(point) - slope_at(*last)) / change};
          }
        largest_slope = std::max(largest_slope, std::abs(slope_at(point)));
        last          = point;
        arrival.state = std::move(state);
        ahead.pop_back();
      }
    arrival.state->fft_pairs  = pairs;
    arrival.state->iterations = iterations;
    return arrival;
  }

  void
  BranchFollower::transfer(StateArchive &archive)
  {
    model.transfer(archive);
    bool has_last = last.has_value(), has_trend = trend.has_value();
    archive.value(has_last);
    archive.value(has_trend);
    if (archive.is_reading())
      {
        last  = has_last ? std::make_optional<PathPoint>() : std::nullopt;
        trend = has_trend ? std::make_optional<Trend>() : std::nullopt;
      }
    if (last)
      transfer_point(archive, *last);
    if (trend)
      {
        archive.value(trend->area);
        archive.value(trend->slope);
      }
    archive.value(largest_slope);
    auto n_jumps = static_cast<long>(all_jumps.size());
    archive.value(n_jumps);
    all_jumps.resize(n_jumps);
    for (Jump &jump : all_jumps)
      {
        transfer_point(archive, jump.before);
        transfer_point(archive, jump.after);
        archive.value(jump.dissipated);
        archive.value(jump.is_pull_off);
      }
  }

  /** dH/dp. */
  double
  BranchFollower::slope_at(const PathPoint &point) const
  {
    return control == ContactControl::load ? point.mean_gap : -point.pressure;
  }

  /** How much the energy changes to another state without dissipation, by the slope at
   *  either end. */
  std::pair<double, double>
  BranchFollower::reversible_rise(const PathPoint &to) const
  {
    const double change = to.target - last->target;
    return std::minmax({slope_at(*last) * change, slope_at(to) * change});
  }

  bool
  BranchFollower::is_smooth(const PathPoint &to) const
  {
    const double rise        = to.energy - last->energy;
    const double change      = to.target - last->target;
    const auto [least, most] = reversible_rise(to);
    const double noise       = slope_noise * largest_slope * std::abs(change);
    if (rise < least - noise ||
        std::abs(rise - .5 * (least + most)) > largest_skewness * (most - least) + noise)
      return false;
    if (!trend)
      return true;
    const double area  = std::abs(to.contact_area - last->contact_area);
    const double slope = std::abs(slope_at(to) - slope_at(*last));
    return area <= free_change_of_area + steeper_area * std::abs(trend->area * change) &&
           slope <=
             free_change * largest_slope + steeper * std::abs(trend->slope * change);
  }

  void
  BranchFollower::note_jump(const PathPoint &to, const bool is_pull_off, Arrival &arrival)
  {
    Jump jump{*last, to, 0., is_pull_off};
    // Within the tolerance the load of the jump is unknown: the middle of the slopes.
    const auto [least, most] = reversible_rise(to);
    const double rise        = to.energy - last->energy;
    if (!is_pull_off)
      jump.dissipated = .5 * (least + most) - rise;
    if (!is_pull_off && rise >= least) // steep, but no jump
      return;
    arrival.dissipated += jump.dissipated;
    all_jumps.push_back(jump);
    if (is_pull_off)
      log.line(format("the surfaces part between the nominal pressures %.6g and %.6g",
                      last->target,
                      to.target));
    else
      log.line(
        format("jump between %.6g and %.6g: contact %.3f %% to %.3f %%, %.4g "
               "dissipated per area",
               last->target,
               to.target,
               100 * last->contact_area,
               100 * to.contact_area,
               jump.dissipated));
  }
} // namespace strait
