// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/seal/transition_search.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    /** A value, and the openness there above the level. */
    struct Point
    {
      double value;
      double openness;
    };

    /** What is known at one level, the last of each side nearest to the transition. */
    struct Known
    {
      std::vector<Point> open;   // ascending
      std::vector<Point> sealed; // descending

      bool
      has_both() const
      {
        return !open.empty() && !sealed.empty();
      }

      double
      width() const
      {
        return has_both() ? sealed.back().value - open.back().value
                          : std::numeric_limits<double>::infinity();
      }
    };

    /** Where a side of the transition says that this is. */
    struct Estimate
    {
      double value;
      double reach;    // from the nearest point of the side
      bool   is_above; // that point lies above
    };

    /** Where a power law through two points vanishes. */
    double
    zero_of(const Point &near, const Point &far, const double exponent)
    {
      const double root = std::pow(near.openness / far.openness, 1. / exponent);
      return near.value + (near.value - far.value) * root / (1. - root);
    }

    /** The exponent of a power law that vanishes at @p zero. */
    double
    exponent_of(const Point &near, const Point &far, const double zero)
    {
      return std::log(far.openness / near.openness) /
             std::log((zero - far.value) / (zero - near.value));
    }

    /** From points of one side, the nearest last. */
    std::optional<Estimate>
    estimate(const std::vector<Point> &side)
    {
      const auto is_nearer = [](const Point &near, const Point &far) {
        return std::abs(near.openness) < std::abs(far.openness);
      };
      if (side.size() < 2 || !is_nearer(side.back(), side[side.size() - 2]))
        return {};
      const Point &first = side.back(), &second = side[side.size() - 2];
      // Of the gap of a throat, and of the pressure where it is closed.
      const double usual = first.openness > 0 ? 1.2 : .63;
      double       zero  = zero_of(first, second, usual);
      if (side.size() > 2 && is_nearer(second, side[side.size() - 3]) &&
          second.openness != 0.)
        {
          // What exponent makes a third point lie on the same line.
          constexpr int n_steps = 20;
          for (int k = 0; k < n_steps; ++k)
            zero = zero_of(first,
                           second,
                           std::clamp(exponent_of(second, side[side.size() - 3], zero),
                                      .5 * usual,
                                      2. * usual));
        }
      return Estimate{zero, std::abs(zero - first.value), first.value > zero};
    }

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

    /** That of the side which has it nearer, if there are two and it lies between. */
    std::optional<Estimate>
    estimate(const Known &known)
    {
      std::optional<Estimate> nearest;
      if (!known.has_both())
        return nearest;
      for (const std::vector<Point> *side : {&known.open, &known.sealed})
        if (const auto guess = estimate(*side);
            guess && guess->value > known.open.back().value &&
            guess->value < known.sealed.back().value &&
            !(nearest && nearest->reach < guess->reach))
          nearest = guess;
      return nearest;
    }

    /** What to ask as long as all answers are on one side. */
    double
    value_outside(const Known &known, const SearchStart &first, const double tolerance)
    {
      // A factor. Steps half as long ask more often until the transition is between two
      // values, steps twice as long leave a wider bracket, and the contact problems at
      // its far end start from less similar ones.
      constexpr double          largest_step = 1.6;
      const bool                upwards      = known.sealed.empty();
      const std::vector<Point> &side         = upwards ? known.open : known.sealed;
      if (side.empty())
        return first.value;
      const double edge   = side.back().value;
      double       factor = side.size() > 1 ? largest_step : 1. + first.step;
      if (const auto guess = estimate(side))
        // A tenth of the way beyond.
        if (const double aim = edge + 1.1 * (guess->value - edge),
            towards          = upwards ? aim / edge : edge / aim;
            towards > 1)
          factor = std::clamp(towards, 1. + tolerance, largest_step);
      // Half of the way to the end is left to the next steps.
      return upwards ? std::min(edge * factor, .5 * (edge + first.end)) : edge / factor;
    }

    /**
     * What to ask between the two sides: beyond @p guess, seen from the side that it
     * comes from, so that the transition comes to lie between; or the middle. The more
     * often in a row the last @p n_astray estimates were no good, the farther beyond.
     */
    double
    value_between(const Known                   &known,
                  const std::optional<Estimate> &guess,
                  const int                      n_astray,
                  const double                   tolerance)
    {
      const double lower = known.open.back().value, upper = known.sealed.back().value;
      const double middle = .5 * (lower + upper);
      // Two values on both sides of the transition at this distance end the search.
      const double margin = std::min(.5 * tolerance * upper, .5 * (upper - lower));
      double       aim    = middle;
      if (guess)
        {
          const double beyond =
            n_astray > 0 ? std::ldexp(guess->reach, n_astray - 1) : .8 * margin;
          aim               = guess->value + (guess->is_above ? -beyond : beyond);
          const bool is_far = guess->is_above ? aim < middle : aim > middle;
          if (n_astray > 0 && is_far)
            aim = middle;
          else if (!(aim > lower && aim < upper))
            aim = guess->value;
        }
      return std::clamp(aim, lower + margin, upper - margin);
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
    // The answer comes first: asking may throw.
    return asked[value] = ask(value);
  }

  Passage
  TransitionSearch::enclose(const SearchStart first, const double level)
  {
    int   n_astray = 0;
    Known known    = known_at(asked, level);
    auto  guess    = estimate(known);
    while (!known.has_both() || known.width() > tolerance * known.sealed.back().value)
      {
        const double width = known.width();
        const double reach = guess ? guess->reach : 0.;
        const double value = known.has_both()
                               ? value_between(known, guess, n_astray, tolerance)
                               : value_outside(known, first, tolerance);
        const bool   ends =
          known.sealed.empty() && !known.open.empty() && known.open.back().value == value;
        if (ends ||
            !(negligible * value < first.value && value > negligible * first.value))
          throw ComputationError(
            std::string("The threshold was not found: the contact ") +
            (known.sealed.empty() ? "still leaks at " : "is still sealed at ") +
            name(value) +
            "; switch the search off to run Load programme/Pressures alone.");
        ask_at(value);
        known = known_at(asked, level);
        guess = estimate(known);
        const bool advances =
          known.width() <= .5 * width || (guess && guess->reach < .5 * reach);
        n_astray = advances || !known.has_both() ? 0 : n_astray + 1;
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
  TransitionSearch::leave(const double kept,
                          const double step,
                          const Kept  &is_kept,
                          const double lost)
  {
    Passage      at        = {kept, lost};
    const double typical   = std::isnan(lost) ? kept : std::max(kept, lost);
    const double direction = step > 0 ? 1. : -1.;

    double     lost_from = unknown; // where the state was when it was lost at `beyond`
    const auto is_lost   = [&](const double value) {
      const bool stays = is_kept(ask_at(value));
      if (stays)
        at.before = value;
      else
        {
          lost_from = at.before;
          at.beyond = value;
        }
      return !stays;
    };
    const auto is_near = [&](const double from) {
      return std::abs(at.beyond - from) <= tolerance * std::max(at.beyond, at.before);
    };

    // To smaller values no step is larger than a half of them.
    for (double first = step;; first = direction * tolerance * at.before)
      {
        if (std::isnan(at.beyond))
          for (double next = first; !is_lost(std::max(at.before + next, .5 * at.before));
               next *= 2)
            if (negligible * at.before > typical || at.before < negligible * typical)
              return {};
        while (!is_near(at.before))
          is_lost(.5 * (at.before + at.beyond));
        if (is_near(lost_from) || is_lost(at.beyond))
          return at;
        at.beyond = unknown;
      }
  }
} // namespace strait
