// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/contact_problem.h>
#include <strait/contact/contact_state.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace strait
{
  /**
   * What is held while the pressure 0 <= p <= limit is sought: its mean (force control;
   * the rigid displacement u0 of g = Gp + u0 − h follows) or u0 (gap control).
   */
  struct ContactConstraint
  {
    bool   fixes_pressure;
    double value; // the mean of the pressure, which is less than the limit, or u0
    double limit = std::numeric_limits<double>::infinity(); // of the pressure

    /** The rigid displacement of gap control; 0 where it is unknown. */
    double
    displacement() const
    {
      return fixes_pressure ? 0. : value;
    }

    /**
     * The mean that a field with the sum @p sum over points of total weight
     * @p weight must lose to be admissible: none in gap control.
     */
    double
    excess(const double sum, const double weight) const
    {
      return fixes_pressure && weight > 0 ? sum / weight : 0.;
    }

    /** The factor that gives a pressure of the mean @p mean the prescribed one. */
    double
    rescale(const double mean) const
    {
      return fixes_pressure ? value / mean : 1.;
    }

    /** Whether the pressure has an upper limit, and the mean is held. */
    bool
    is_limited() const
    {
      return std::isfinite(limit);
    }
  };

  /** What brings a pressure within its limits, point by point. */
  struct WithinLimits
  {
    double shift;    // before truncation,
    double factor;   // and what is left is multiplied by this
    double limit;    // the upper one
    bool   all_move; // and not only marked points

    double
    operator()(const double pressure, const bool is_marked) const
    {
      return all_move || is_marked ? factor * std::clamp(pressure + shift, 0., limit)
                                   : pressure;
    }
  };

  /**
   * The way to a pressure within the limits of @p constraint that has its mean: @p
   * pressure truncated and scaled or, where there is an upper limit, the nearest one,
   * which is reached by the same shift at all points that @p may_move marks. Where these
   * cannot carry that mean all points move. Collective.
   */
  WithinLimits within_limits(const DualProblem               &problem,
                             const ContactConstraint         &constraint,
                             const std::vector<std::uint8_t> &may_move,
                             const double                    *pressure);

  /** A contact without adhesion whose pressure is to be found; see find_pressure(). */
  struct DualTask
  {
    DualProblem            &problem;
    const ContactConstraint constraint;
    const ContactTolerance  tolerance;
    double *const           pressure; // on the way also beyond its limits
    double *const           gap;      // on the way anything
  };
} // namespace strait
