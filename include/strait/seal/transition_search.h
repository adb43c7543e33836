// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/text.h>

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** What one state tells about percolation. */
  struct Probe
  {
    /** > 0: it leaks, and this is the gap of the bottleneck; else how firmly it is
     * closed, likewise as a length. */
    double                openness     = 0.;
    double                contact_area = 0.;
    std::array<double, 2> bottleneck   = {{0., 0.}}; // its place [length]
    double                points       = 0.; // along the throat there, if it is open
    long                  fft_pairs    = 0;
    bool                  converged    = true;  // the solvers that it took
    bool                  is_parted    = false; // adhesive walls are, and leave no state
  };

  /** Between two values of what varies along a path, a load or a pressure. */
  struct Passage
  {
    double before; // nearer to where the path comes from
    double beyond;
  };

  /** Where a search begins. */
  struct SearchStart
  {
    double value;

    /** To the next value if both are on one side, relative to the first. */
    double step = .2;

    /** All values are below it, but for the first, which it may be. */
    double end = std::numeric_limits<double>::infinity();
  };

  /** A load or an inlet pressure at which a seal begins or ceases to leak, enclosed. */
  struct Transition
  {
    double slip_length = 0.;
    // With hysteresis these are on the path that the search follows.
    double                lower        = 0.;
    double                upper        = 0.;
    double                contact_area = 0.;         // at lower
    std::array<double, 2> bottleneck   = {{0., 0.}}; // place in the open state [length]
    int                   n_solves     = 0;          // states that were asked for
    long                  fft_pairs    = 0;          // of those
    bool                  converged    = true;       // the states at both ends

    /** How far from it, relative, finer grid points may have it; not a number where that
     *  is not known. */
    double grid_error = std::numeric_limits<double>::quiet_NaN();

    double
    middle() const
    {
      return .5 * (lower + upper);
    }

    double
    relative_width() const
    {
      return (upper - lower) / upper;
    }
  };

  /** The critical load of a slip length; null if there is none. */
  inline const Transition *
  threshold_of(const std::vector<Transition> &thresholds, const double slip_length)
  {
    for (const Transition &threshold : thresholds)
      if (threshold.slip_length == slip_length)
        return &threshold;
    return nullptr;
  }

  /** The inlet pressures at which a seal under a load opens and closes again. */
  struct BlowOut
  {
    double                    load = 0.;
    Transition                opening; // 0 where it leaks without any pressure
    std::optional<Transition> closing; // if it was sought; 0 where it never closes
  };

  /**
   * Encloses the value at which a seal that is asked for one value after the other begins
   * or ceases to leak. Knows nothing of what varies.
   *
   * Where only the value counts, the openness v falls with it and changes its sign at the
   * transition. On the open side it is the gap of a constriction, which vanishes as
   * (1 − L/L_c)^(6/5) with the load L, on the sealed side a contact pressure, which was
   * found to grow as (L/L_c − 1)^0.63. As long as all answers are on one side, a power
   * law through two of them foretells the transition; a third one tells its exponent,
   * which is 1 within a grid spacing of closing. Once it is enclosed, the root of v^(5/6)
   * is sought by the method of Alefeld, Potra and Shi (ACM Trans. Math. Softw. 21, 1995).
   * Every value that was asked serves later searches at other levels of the openness.
   *
   * Where it counts as well what the seal was before, steps matter: a state that a small
   * step keeps may be lost by a large one. Then the transition is where small steps along
   * the path lose the state.
   */
  class TransitionSearch
  {
  public:
    using Ask  = std::function<Probe(double value)>;
    using Kept = std::function<bool(const Probe &)>;
    using Name = std::function<std::string(double value)>;

    /** Of a usual load or pressure: what leaks with so little leaks by itself, and what
     *  does not change its mind between that and as many times more never does. Half and
     *  double of it judge alike, as neither bends the walls. */
    static constexpr double negligible = 1e-6;

    /** @p tolerance: relative width of the bracket to reach; @p name: what messages call
     *  a value. */
    TransitionSearch(Ask ask, double tolerance, Name name = to_text);

    /**
     * Enclose the value above which the openness is no more than @p level, beginning with
     * @p first. Throws ComputationError if no value within a factor of 10⁶ of the first,
     * and below its end, brackets it. Collective if asking is.
     */
    Passage enclose(SearchStart first, double level);

    /**
     * The same where the openness is known the better the nearer to the transition it is
     * asked for: both ends are asked again until they keep their sides. Answers that
     * contradict a later one are forgotten.
     */
    Passage enclose_surely(SearchStart first, double level);

    /**
     * Enclose where the state that is there at @p kept is lost, in steps that grow from
     * @p step, which is negative on the way to smaller values. If it is known to be lost
     * in one step to @p lost, that comes first, and small steps go on beyond it if they
     * keep the state. @p is_kept judges a probe. Nothing if the state is not lost within
     * a factor of 10⁶. Collective if asking is.
     */
    std::optional<Passage>
    leave(double kept, double step, const Kept &is_kept, double lost = unknown);

    /**
     * How far from @p transition, relative, half a grid spacing is left along the throat,
     * by the law above and as lengths go with the root of the gap; not a number if no
     * throat is known. Nearer to it than that the grid cannot tell whether the throat is
     * open: it hangs on where that lies between the points, so that the law is taken from
     * the last value that has more. If none was asked at that has, some are if that
     * @p may_ask, farther and farther from the transition. Of 48 critical loads of random
     * surfaces none was off by more, with half of the length 14. Collective if asking is.
     */
    double
    unresolved_distance(const Passage &transition, double level, bool may_ask = true);

    /** Ask at one value. Collective if asking is. */
    const Probe &ask_at(double value);

    /** The last answer at a value that was asked. */
    const Probe &
    at(const double value) const
    {
      return asked.at(value);
    }

  private:
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    Ask                     ask;
    double                  tolerance;
    Name                    name;
    std::map<double, Probe> asked;
    double                  latest = unknown; // that was asked
  };
} // namespace strait
