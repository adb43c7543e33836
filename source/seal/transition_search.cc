// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/seal/transition_search.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    /** A value, and by how much the openness there is above the level. */
    struct Point
    {
      double value;
      double openness;
    };

    /** The answers at one level, the last of each side nearest to the transition. */
    struct Known
    {
      std::vector<Point> open;   // ascending
      std::vector<Point> sealed; // descending
    };

    // The gap of a throat goes with this power of the distance from the transition.
    constexpr double power_of_gap = 1.2;

    Known
    known_at(const std::map<double, Probe> &asked, const double level)
    {
      Known known;
      for (const auto &[value, probe] : asked)
        {
          const double openness = probe.openness - level;
          (openness > 0 ? known.open : known.sealed).push_back({value, openness});
        }
      std::reverse(known.sealed.begin(), known.sealed.end());
      return known;
    }

    /** Where a power law through two points vanishes. */
    double
    zero_of(const Point &near, const Point &far, const double exponent)
    {
      const double root = std::pow(near.openness / far.openness, 1. / exponent);
      return near.value + (near.value - far.value) * root / (1. - root);
    }

    /** Where a power law through the last two points of one side puts the transition. */
    std::optional<double>
    extrapolate(const std::vector<Point> &side)
    {
      if (side.size() < 2)
        return {};
      const Point &first = side.back(), &second = side[side.size() - 2];
      if (!(std::abs(first.openness) < std::abs(second.openness)))
        return {};
      // Likewise of the contact pressure where a throat is closed.
      constexpr double power_of_pressure = .63;
      const double     usual = first.openness > 0 ? power_of_gap : power_of_pressure;
      return zero_of(first, second, usual);
    }

    /** The value to ask next as long as all answers are on one side. */
    double
    value_outside(const Known &known, const SearchStart &first, const double tolerance)
    {
      // Factor between values. With steps half as long, it takes more questions until the
      // transition is between two values; with steps twice as long, it is enclosed less
      // narrowly, and contact problems at the far end start from less similar ones.
      constexpr double          largest_step = 1.6;
      const bool                upwards      = known.sealed.empty();
      const std::vector<Point> &side         = upwards ? known.open : known.sealed;
      if (side.empty())
        return first.value;
      const double edge   = side.back().value;
      double       factor = side.size() > 1 ? largest_step : 1. + first.step;
      if (const auto guess = extrapolate(side))
        // Go a tenth of the way beyond.
        if (const double aim = edge + 1.1 * (*guess - edge),
            towards          = upwards ? aim / edge : edge / aim;
            towards > 1)
          factor = std::clamp(towards, 1. + tolerance, largest_step);
      // Leave at least half of the way to the end to the next steps.
      return upwards ? std::min(edge * factor, .5 * (edge + first.end)) : edge / factor;
    }

    /** Transform an @p openness for interpolation: on the open side it becomes about
     *  proportional to the distance from the transition. It is finite also where the
     *  walls part, and never zero, which would be taken for the root: zero is sealed. */
    double
    straightened(const double openness)
    {
      const double size = std::clamp(std::abs(openness),
                                     std::numeric_limits<double>::min(),
                                     double(std::numeric_limits<float>::max()));
      return std::copysign(std::pow(size, 1. / power_of_gap), openness > 0 ? 1. : -1.);
    }
  } // namespace

  TransitionSearch::TransitionSearch(Ask ask_, const double tolerance_, Name name_)
    : ask(std::move(ask_))
    , tolerance(tolerance_)
    , name(std::move(name_))
  {
  }

  const Probe &
  TransitionSearch::ask_at(const double value)
  {
    // Do not touch the map before the answer is there: asking may throw.
    const Probe answer  = ask(value);
    latest              = value;
    return asked[value] = answer;
  }

  EnclosingPair
  TransitionSearch::enclose(const SearchStart first, const double level)
  {
    Known known = known_at(asked, level);
    for (; known.open.empty() || known.sealed.empty(); known = known_at(asked, level))
      {
        const double value = value_outside(known, first, tolerance);
        const bool   ends =
          known.sealed.empty() && !known.open.empty() && known.open.back().value == value;
        if (ends ||
            !(negligible * value < first.value && value > negligible * first.value))
          throw ComputationError(
            std::string("The threshold was not found: the contact ") +
            (known.sealed.empty() ? "still leaks at " : "is still sealed at ") +
            name(value) +
            (first.value == first.end
               ? "; begin Load programme/Pressures with a load under which it seals."
               : "; switch the search off to run Load programme/Pressures alone."));
        ask_at(value);
      }
    const auto openness = [&](const double value) {
      return straightened(ask_at(value).openness - level);
    };
    const auto is_narrow = [&](const double lower, const double upper) {
      return upper - lower <= tolerance * upper;
    };
    const Point open = known.open.back(), sealed = known.sealed.back();
    if (is_narrow(open.value, sealed.value)) // or in the wrong order: answers disagree
      return {open.value, sealed.value};
    auto       n_steps = std::numeric_limits<std::uintmax_t>::max();
    const auto found   = boost::math::tools::toms748_solve(openness,
                                                         open.value,
                                                         sealed.value,
                                                         straightened(open.openness),
                                                         straightened(sealed.openness),
                                                         is_narrow,
                                                         n_steps);
    return {found.first, found.second};
  }

  EnclosingPair
  TransitionSearch::enclose_surely(const SearchStart first, const double level)
  {
    while (true)
      {
        const EnclosingPair found = enclose(first, level);
        bool                stays = true;
        for (const double value : {found.before, found.beyond})
          {
            const bool was_open = at(value).openness > level;
            const bool is_open  = ask_at(value).openness > level;
            if (is_open == was_open)
              continue;
            stays = false;
            for (auto other = asked.begin(); other != asked.end();)
              {
                const bool contradicts = (other->first < value) == is_open &&
                                         other->first != value &&
                                         (other->second.openness > level) != is_open;
                other = contradicts ? asked.erase(other) : std::next(other);
              }
          }
        if (stays)
          return found;
      }
  }

  double
  TransitionSearch::unresolved_distance(const EnclosingPair &transition,
                                        const double         level,
                                        const bool           may_ask)
  {
    // Spacings along a throat that the grid needs to tell where it closes.
    constexpr double resolved  = .5;
    const double     middle    = .5 * (transition.before + transition.beyond);
    const auto       points_at = [&](const Probe &probe) {
      return probe.openness > std::max(level, 0.)
                     ? probe.points * std::sqrt(1. - level / probe.openness)
                     : 0.;
    };
    // Nearer to the transition, throats open as the points lie, and not by the law.
    const auto last_resolved = [&]() {
      auto last = asked.end();
      for (auto probe = asked.begin(); probe != asked.end() && probe->first < middle;
           ++probe)
        if (points_at(probe->second) >= resolved)
          last = probe;
      return last;
    };
    const bool has_throat = points_at(at(transition.before)) > 0.;
    for (double distance = 2. * tolerance;
         may_ask && has_throat && last_resolved() == asked.end() && distance < 1.;
         distance *= 2.)
      ask_at((1. - distance) * middle);
    const auto last = last_resolved();
    if (last == asked.end())
      return unknown;
    return (1. - last->first / middle) *
           std::pow(resolved / points_at(last->second), 2. / power_of_gap);
  }

  std::optional<EnclosingPair>
  TransitionSearch::enclose_loss(const double kept,
                                 const double step,
                                 const Kept  &is_kept,
                                 const double lost)
  {
    EnclosingPair at        = {kept, lost};
    const double  typical   = std::isnan(lost) ? kept : std::max(kept, lost);
    const double  direction = step > 0 ? 1. : -1.;

    // The value at which the state was before it was lost at `beyond`: the one at which
    // it is kept, if `lost` was the last question.
    double     value_before_loss = latest == lost ? kept : unknown;
    const auto is_lost           = [&](const double value) {
      const bool stays = is_kept(ask_at(value));
      if (stays)
        at.before = value;
      else
        {
          value_before_loss = at.before;
          at.beyond         = value;
        }
      return !stays;
    };
    const auto is_near = [&](const double from) {
      return std::abs(at.beyond - from) <= tolerance * std::max(at.beyond, at.before);
    };

    // Towards smaller values, no step is larger than half of the value.
    for (double first = step;; first = direction * tolerance * at.before)
      {
        if (std::isnan(at.beyond))
          for (double next = first; !is_lost(std::max(at.before + next, .5 * at.before));
               next *= 2)
            if (negligible * at.before > typical || at.before < negligible * typical)
              return {};
        while (!is_near(at.before))
          is_lost(.5 * (at.before + at.beyond));
        if (is_near(value_before_loss) || is_lost(at.beyond))
          return at;
        at.beyond = unknown;
      }
  }
} // namespace strait
