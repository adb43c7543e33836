// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/driver/slow_approach.h>
#include <strait/driver/threshold_search.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    constexpr double widest_range = 1e6; // of loads around the first

    /** Close to linear in the load around the threshold. */
    double
    straighten(const double value)
    {
      return value > 0 ? std::pow(value, 5. / 6) : -std::pow(-value, 1. / .63);
    }
  } // namespace

  ThresholdSearch::ThresholdSearch(Probe        probe_,
                                   const double first_load_,
                                   const double tolerance_)
    : probe(std::move(probe_))
    , first_load(first_load_)
    , tolerance(tolerance_)
  {
  }

  ThresholdSearch::Known
  ThresholdSearch::known_at(const double level) const
  {
    Known known;
    for (const auto &[load, result] : probed)
      {
        const double openness = result.bottleneck.value - level;
        (openness > 0 ? known.open : known.sealed)
          .push_back({load, openness, straighten(openness)});
      }
    std::reverse(known.sealed.begin(), known.sealed.end());
    return known;
  }

  double
  ThresholdSearch::load_outside(const Known &known) const
  {
    constexpr double smallest_step = 1.02, first_step = 1.2, largest_step = 1.6;
    if (known.open.empty() && known.sealed.empty())
      return first_load;
    const bool                upwards = known.sealed.empty();
    const std::vector<Point> &side    = upwards ? known.open : known.sealed;
    const Point              &edge    = side.back();
    double                    factor  = first_step;
    if (side.size() > 1)
      {
        // A tenth of the way beyond where the line through two loads meets zero.
        const Point &inner = side[side.size() - 2];
        const double reach =
          edge.value * (edge.load - inner.load) / (inner.value - edge.value);
        const double aim = edge.load + 1.1 * reach;
        factor           = upwards ? aim / edge.load : edge.load / aim;
        if (!(factor > 1))
          factor = largest_step;
        factor = std::clamp(factor, smallest_step, largest_step);
      }
    return upwards ? edge.load * factor : edge.load / factor;
  }

  bool
  ThresholdSearch::is_linear(const Known &known)
  {
    constexpr double alike = 1.6;
    const auto       slope = [](const Point &a, const Point &b) {
      return (a.openness - b.openness) / (b.load - a.load);
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
  ThresholdSearch::load_between(const Known &known, const bool bisect) const
  {
    constexpr double overshoot = .2;
    const Point     &open = known.open.back(), &sealed = known.sealed.back();
    const double     lower = open.load, upper = sealed.load;
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
              near.value * (near.load - far.load) / (far.value - near.value);
            if (const double beyond = near.load + (1 + overshoot) * reach;
                beyond > lower && beyond < upper && std::abs(reach) < shortest)
              {
                shortest = std::abs(reach);
                aim      = beyond;
              }
          }
    // A step to the other side of the threshold should end the search.
    const double margin = std::min(.8 * tolerance * upper, .5 * (upper - lower));
    return std::clamp(aim, lower + margin, upper - margin);
  }

  /** Returns how open it is. */
  double
  ThresholdSearch::ask(const double load, const double level)
  {
    const ThresholdProbe result = probe(load);
    ++n_solves;
    fft_pairs += result.fft_pairs;
    probed[load] = result;
    return result.bottleneck.value - level;
  }

  ThresholdSearch::Known
  ThresholdSearch::enclose(const double level)
  {
    bool  bisect = false;
    Known known  = known_at(level);
    while (known.open.empty() || known.sealed.empty() ||
           known.width() > tolerance * known.sealed.back().load)
      {
        const bool   is_between = !known.open.empty() && !known.sealed.empty();
        const double width      = is_between ? known.width() : 0.;
        const double load =
          is_between ? load_between(known, bisect) : load_outside(known);
        if (!(load < widest_range * first_load && load * widest_range > first_load))
          throw ComputationError(
            std::string("The threshold was not found: the contact ") +
            (known.sealed.empty() ? "still leaks" : "is still sealed") +
            " at a load of " + to_text(load) + ".");
        ask(load, level);
        known = known_at(level);
        // Where the line led astray, halve the bracket.
        bisect = is_between && known.width() > .5 * width;
      }
    return known;
  }

  Threshold
  ThresholdSearch::between(const double slip_length,
                           const double lower,
                           const double upper)
  {
    const ThresholdProbe &last = probed.at(lower);
    return {slip_length,
            lower,
            upper,
            last.contact_area,
            last.bottleneck.point,
            std::exchange(n_solves, 0),
            std::exchange(fft_pairs, 0)};
  }

  Threshold
  ThresholdSearch::find(const double slip_length)
  {
    const Known known = enclose(-2. * slip_length);
    return between(slip_length, known.open.back().load, known.sealed.back().load);
  }

  Threshold
  ThresholdSearch::find_slowly(const double slip_length, const bool from_open)
  {
    const double level  = -2. * slip_length;
    const Known  known  = enclose(level);
    const double open   = known.open.back().load;
    const double sealed = known.sealed.back().load;
    const auto   passage =
      approach_slowly(from_open ? Passage{open, sealed} : Passage{sealed, open},
                      tolerance,
                      [&](const double load) {
                        return (ask(load, level) > 0) != from_open;
                      });
    if (!passage)
      throw ComputationError(
        std::string("The threshold was not found: the contact stays ") +
        (from_open ? "open" : "sealed") + " however far the load goes.");
    return between(slip_length,
                   std::min(passage->before, passage->beyond),
                   std::max(passage->before, passage->beyond));
  }

  void
  transfer_probe(StateArchive &archive, ThresholdProbe &probe)
  {
    archive.value(probe.bottleneck.value);
    archive.value(probe.bottleneck.point.ix);
    archive.value(probe.bottleneck.point.iy);
    archive.value(probe.contact_area);
    archive.value(probe.fft_pairs);
  }

  void
  transfer_thresholds(StateArchive &archive, std::vector<Threshold> &thresholds)
  {
    auto n_thresholds = static_cast<long>(thresholds.size());
    archive.value(n_thresholds);
    thresholds.resize(n_thresholds);
    for (Threshold &threshold : thresholds)
      {
        archive.value(threshold.slip_length);
        archive.value(threshold.lower);
        archive.value(threshold.upper);
        archive.value(threshold.contact_area);
        archive.value(threshold.last_constriction.ix);
        archive.value(threshold.last_constriction.iy);
        archive.value(threshold.n_solves);
        archive.value(threshold.fft_pairs);
      }
  }
} // namespace strait
