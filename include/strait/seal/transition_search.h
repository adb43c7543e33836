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
    /** If positive, the gap of the bottleneck; else how firmly it is closed, likewise as
     *  a length. The seal leaks above the level of the search, 0 without slip. */
    double                openness     = 0.;
    double                contact_area = 0.;
    std::array<double, 2> bottleneck   = {{0., 0.}}; // its place [length]
    double                points       = 0.; // along the throat there, if it is open
    long                  fft_pairs    = 0;
    bool                  converged    = true;  // all solvers did
    bool                  is_parted    = false; // adhesive walls parted: no state is left
  };

  /** Two values of what varies on a path, a load or a pressure, around a transition. */
  struct EnclosingPair
  {
    double before; // nearer to where the path comes from
    double beyond;
  };

  /** Where a search begins. */
  struct SearchStart
  {
    double value;

    /** The step to the next value if both are on one side, relative to the first. */
    double step = .2;

    /** All values are below it, except the first, which may be equal. */
    double end = std::numeric_limits<double>::infinity();
  };

  /** A load or an inlet pressure at which a seal begins or ceases to leak, enclosed. */
  struct Transition
  {
    double slip_length = 0.;
    // With hysteresis, those on the path that the search follows.
    double                lower        = 0.;
    double                upper        = 0.;
    double                contact_area = 0.;         // at lower
    std::array<double, 2> bottleneck   = {{0., 0.}}; // place in the open state [length]
    int                   n_solves     = 0;          // states that were asked for
    long                  fft_pairs    = 0;          // of those
    bool                  converged    = true;       // the states at both ends

    /** By how much, relative, a finer grid may shift it; not a number where unknown. */
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
    Transition                opening; // at the outlet pressure where it leaks by itself
    std::optional<Transition> closing; // if sought; likewise where it never closes
  };

  /**
   * Encloses the value at which a seal begins or ceases to leak, by asking one value
   * after the other. Knows nothing of what varies.
   *
   * Without hysteresis, the openness v falls with the value and changes its sign at the
   * transition. On the open side it is the gap of a constriction, which vanishes as
   * (1 − L/L_c)^(6/5) with the load L; on the sealed side it is a contact pressure, which
   * was found to grow as (L/L_c − 1)^0.63. As long as all answers are on one side, such a
   * law through two of them predicts the transition. Once it is enclosed, the root of
   * v^(5/6) is sought by the method of Alefeld, Potra and Shi (ACM Trans. Math. Softw.
   * 21, 1995). Every answer serves later searches at other levels of the openness.
   *
   * With hysteresis, steps matter: a large one may lose a state that a small one keeps.
   * Then the transition is where small steps along the path lose the state.
   */
  class TransitionSearch
  {
  public:
    using Ask  = std::function<Probe(double value)>;
    using Kept = std::function<bool(const Probe &)>;
    using Name = std::function<std::string(double value)>;

    /** Fraction of a usual load or pressure that counts as zero: a seal that leaks under
     *  it leaks under none, and one whose answer is the same at this fraction and at its
     *  inverse has no transition. Half and double of it give the same answers, as neither
     *  bends the walls. */
    static constexpr double negligible = 1e-6;

    /** @p tolerance: relative width to which a transition is enclosed; @p name: what
     *  messages call a value. */
    TransitionSearch(Ask ask, double tolerance, Name name = to_text);

    /**
     * Enclose the value above which the openness is no more than @p level, beginning with
     * @p first. Throws ComputationError if no value within a factor of 10⁶ of the first,
     * and below its end, is on the other side. Collective if asking is.
     */
    EnclosingPair enclose(SearchStart first, double level);

    /**
     * The same for an openness that is more accurate if asked for nearer to the
     * transition: both ends are asked again until they keep their sides. Answers that
     * contradict a later one are forgotten.
     */
    EnclosingPair enclose_surely(SearchStart first, double level);

    /**
     * Enclose where the state that exists at @p kept is lost, in steps that double from
     * @p step, which is negative towards smaller values. If it is known to be lost in one
     * step to @p lost, the search begins between both, and small steps go on beyond if
     * they keep the state there. @p is_kept judges a probe. Returns nothing if the state
     * is not lost within a factor of 10⁶. Collective if asking is.
     */
    std::optional<EnclosingPair>
    enclose_loss(double kept, double step, const Kept &is_kept, double lost = unknown);

    /**
     * Return the relative distance from @p transition at which half a grid spacing is
     * left along the throat, by the law above and with lengths proportional to the root
     * of the gap; not a number if no throat is known. Any nearer, the grid cannot tell
     * whether the throat is open: that depends on where it lies between the points. The
     * law is therefore taken from the last value with a longer throat. If no such value
     * was asked and it @p may_ask, ever farther ones are tried. Of 48 critical loads of
     * random surfaces none was off by more; with half of the length, 14 were. Collective
     * if asking is.
     */
    double unresolved_distance(const EnclosingPair &transition,
                               double               level,
                               bool                 may_ask = true);

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
    double                  latest = unknown; // the value asked last
  };
} // namespace strait
