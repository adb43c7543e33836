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
   * What is prescribed while the pressure 0 <= p <= limit is sought: its mean (load
   * control; the rigid displacement u0 in g = Gp + u0 − h follows) or u0 (gap control).
   */
  struct ContactConstraint
  {
    bool   fixes_pressure;
    double value; // the mean of the pressure, less than the limit, or u0
    double limit = std::numeric_limits<double>::infinity(); // of the pressure

    /** The rigid displacement u0; 0 in load control, where it is unknown. */
    double
    displacement() const
    {
      return fixes_pressure ? 0. : value;
    }

    /**
     * The constant to subtract from a field to make it admissible: in load control its
     * mean, from its sum @p sum over points of total weight @p weight; 0 in gap control.
     */
    double
    excess(const double sum, const double weight) const
    {
      return fixes_pressure && weight > 0 ? sum / weight : 0.;
    }

    /** The factor that takes a pressure of the mean @p mean to the prescribed one. */
    double
    rescale(const double mean) const
    {
      return fixes_pressure ? value / mean : 1.;
    }

    /** Whether the pressure has an upper limit, which requires that its mean is fixed. */
    bool
    is_limited() const
    {
      return std::isfinite(limit);
    }
  };

  /** The function of a point's pressure that brings it within the limits. */
  struct WithinLimits
  {
    double shift;      // added before truncation
    double factor;     // applied after truncation
    double limit;      // the upper one
    bool   shifts_all; // rather than marked points only

    double
    operator()(const double pressure, const bool is_marked) const
    {
      return shifts_all || is_marked ? factor * std::clamp(pressure + shift, 0., limit)
                                     : pressure;
    }
  };

  /**
   * Return the function that brings @p pressure within the limits of @p constraint and to
   * a prescribed mean. Without an upper limit it truncates and scales. With one it leads
   * to the nearest such pressure, by the same shift at all points that @p is_active
   * marks, or at all points where those cannot carry the mean. Collective.
   */
  WithinLimits within_limits(const DualProblem               &problem,
                             const ContactConstraint         &constraint,
                             const std::vector<std::uint8_t> &is_active,
                             const double                    *pressure);

  /** A contact problem without adhesion to be solved; see find_pressure(). */
  struct DualTask
  {
    DualProblem            &problem;
    const ContactConstraint constraint;
    const ContactTolerance  tolerance;
    double *const           pressure; // may exceed its limits during the search
    double *const           gap;      // meaningless during the search
  };
} // namespace strait
