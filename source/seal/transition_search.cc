// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/seal/transition_search.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    // Of values around the first: a contact that neither seals nor leaks within it has no
    // transition that a scene could mean. Half of it is as good, double of it says so
    // later.
    constexpr double widest_range = 1e6;
    constexpr double unknown      = std::numeric_limits<double>::quiet_NaN();

    /** Close to linear in the value around the transition. */
    double
    straighten(const double openness)
    {
      return openness > 0 ? std::pow(openness, 5. / 6) : -std::pow(-openness, 1. / .63);
    }
  } // namespace

  TransitionSearch::TransitionSearch(Ask ask_, const double tolerance_)
    : ask(std::move(ask_))
    , tolerance(tolerance_)
  {
  }

  const Probe &
  TransitionSearch::ask_at(const double value)
  {
    const Probe probe = ask(value);
    ++n_answers;
    fft_pairs += probe.fft_pairs;
    return asked[value] = probe;
  }

  TransitionSearch::Known
  TransitionSearch::known_at(const double level) const
  {
    Known known;
    for (const auto &[value, probe] : asked)
      {
        const double openness = probe.openness - level;
        (openness > 0 ? known.open : known.sealed)
          .push_back({value, openness, straighten(openness)});
      }
    std::reverse(known.sealed.begin(), known.sealed.end());
    return known;
  }

  double
  TransitionSearch::value_outside(const Known &known, const SearchStart &first)
  {
    // Factors. Steps half as long ask more often until the transition is between two
    // values, steps twice as long leave a wider bracket, and the contact problems at its
    // far end start from less similar ones.
    const double     first_step    = 1. + first.step;
    const double     smallest_step = 1. + .1 * first.step;
    constexpr double largest_step  = 1.6;
    if (known.open.empty() && known.sealed.empty())
      return first.value;
    const bool                upwards = known.sealed.empty();
    const std::vector<Point> &side    = upwards ? known.open : known.sealed;
    const Point              &edge    = side.back();
    double                    factor  = first_step;
    if (side.size() > 1)
      {
        // A tenth of the way beyond where the line through two values meets zero.
        const Point &inner = side[side.size() - 2];
        const double reach =
          edge.straight * (edge.value - inner.value) / (inner.straight - edge.straight);
        const double aim = edge.value + 1.1 * reach;
        factor           = upwards ? aim / edge.value : edge.value / aim;
        if (!(factor > 1))
          factor = largest_step;
        factor = std::clamp(factor, smallest_step, largest_step);
      }
    return upwards ? edge.value * factor : edge.value / factor;
  }

  bool
  TransitionSearch::is_linear(const Known &known)
  {
    // Slopes that differ by less than this factor are one line. A factor nearer to one
    // falls back to the power laws of a transition where the line would have led closer,
    // double of it follows lines across the kink.
    constexpr double alike = 1.6;
    const auto       slope = [](const Point &a, const Point &b) {
      return (a.openness - b.openness) / (b.value - a.value);
    };
    const double across = slope(known.open.back(), known.sealed.back());
    for (const std::vector<Point> *side : {&known.open, &known.sealed})
      if (side->size() > 1)
        {
          const double ratio = slope((*side)[side->size() - 2], side->back()) / across;
          if (ratio < alike && ratio * alike > 1)
            return true;
        }
    return false;
  }

  double
  TransitionSearch::value_between(const Known &known, const bool bisect) const
  {
    // Beyond where the line meets zero, so that the transition comes to lie between. With
    // half of it the next value is more often on the same side, with double of it the
    // bracket stays wider.
    constexpr double overshoot = .2;
    const Point     &open = known.open.back(), &sealed = known.sealed.back();
    const double     lower = open.value, upper = sealed.value;
    double           aim = .5 * (lower + upper), shortest = upper - lower;
    if (!bisect && is_linear(known))
      {
        // A little to the side of the farther end, which thus comes close.
        const double zero =
          lower + (upper - lower) * open.openness / (open.openness - sealed.openness);
        const double far_end = zero - lower > upper - zero ? lower : upper;
        aim                  = zero + .1 * (far_end - zero);
      }
    else if (!bisect)
      for (const std::vector<Point> *side : {&known.open, &known.sealed})
        if (side->size() > 1)
          {
            const Point &near = side->back(), &far = (*side)[side->size() - 2];
            const double reach =
              near.straight * (near.value - far.value) / (far.straight - near.straight);
            if (const double beyond = near.value + (1 + overshoot) * reach;
                beyond > lower && beyond < upper && std::abs(reach) < shortest)
              {
                shortest = std::abs(reach);
                aim      = beyond;
              }
          }
    // A step to the other side of the transition should end the search.
    const double margin = std::min(.8 * tolerance * upper, .5 * (upper - lower));
    return std::clamp(aim, lower + margin, upper - margin);
  }

  Passage
  TransitionSearch::enclose(const SearchStart first, const double level)
  {
    bool  bisect = false;
    Known known  = known_at(level);
    while (known.open.empty() || known.sealed.empty() ||
           known.width() > tolerance * known.sealed.back().value)
      {
        const bool   is_between = !known.open.empty() && !known.sealed.empty();
        const double width      = is_between ? known.width() : 0.;
        const double value =
          is_between ? value_between(known, bisect) : value_outside(known, first);
        if (!(value < widest_range * first.value && value * widest_range > first.value))
          throw ComputationError(
            std::string("The threshold was not found: the contact ") +
            (known.sealed.empty() ? "still leaks" : "is still sealed") +
            " at a load of " + to_text(value) + ".");
        ask_at(value);
        known = known_at(level);
        // Where the line led astray, halve the bracket.
        bisect = is_between && known.width() > .5 * width;
      }
    return {known.open.back().value, known.sealed.back().value};
  }

  Passage
  TransitionSearch::enclose_surely(const SearchStart first, const double level)
  {
    while (true)
      {
        const Passage found = enclose(first, level);
        bool          stays = true;
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

  std::optional<Passage>
  TransitionSearch::approach(const Passage known, const Kept &is_kept)
  {
    const double direction = known.beyond > known.before ? 1. : -1.;
    return lose_slowly(known, direction * tolerance, is_kept);
  }

  std::optional<Passage>
  TransitionSearch::leave(const double kept, const double step, const Kept &is_kept)
  {
    return lose_slowly({kept, unknown}, step / kept, is_kept);
  }

  /** Steps begin with the fraction @p first_step of the value; to smaller values none is
   *  larger than a half of it. */
  std::optional<Passage>
  TransitionSearch::lose_slowly(Passage at, const double first_step, const Kept &is_kept)
  {
    const double typical =
      std::isnan(at.beyond) ? at.before : std::max(at.before, at.beyond);
    const double direction = first_step > 0 ? 1. : -1.;

    double     lost_from = unknown; // where the state was when it was lost at `beyond`
    const auto is_lost   = [&](const double value) {
      const bool lost = !is_kept(ask_at(value));
      if (lost)
        {
          lost_from = at.before;
          at.beyond = value;
        }
      else
        at.before = value;
      return lost;
    };
    const auto is_near = [&](const double from) {
      return std::abs(at.beyond - from) <= tolerance * std::max(at.beyond, at.before);
    };

    for (double relative_step = first_step;; relative_step = direction * tolerance)
      {
        if (std::isnan(at.beyond))
          for (double step = relative_step * at.before;
               !is_lost(std::max(at.before + step, .5 * at.before));
               step *= 2)
            if (at.before > widest_range * typical || widest_range * at.before < typical)
              return {};
        while (!is_near(at.before))
          is_lost(.5 * (at.before + at.beyond));
        if (is_near(lost_from) || is_lost(at.beyond))
          return at;
        at.beyond = unknown;
      }
  }
} // namespace strait
