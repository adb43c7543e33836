// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    using Place = DualConjugateGradients::Place;

    Place
    place_of(const double pressure, const double limit)
    {
      return pressure == 0 ? Place::none : pressure == limit ? Place::full : Place::free;
    }
  } // namespace

  ContactSolution
  DualConjugateGradients::solve()
  {
    for (const SlabLayout::Range &range : problem.ranges)
      for (std::size_t i = range.begin; i < range.end; ++i)
        active[i] = pressure[i] != 0;

    ContactSolution solution;
    double          least_residual = std::numeric_limits<double>::infinity();
    find_gap();
    while (true)
      {
        solution.residual = choose_active_set(); // C and y
        const bool small  = solution.residual <= tolerance.residual;
        const bool late   = solution.iterations >= tolerance.max_iterations;
        if (!any_beyond && (small || late || !std::isfinite(energy)))
          {
            if (gap_is_exact)
              {
                solution.converged = small && std::isfinite(energy);
                break;
              }
            find_gap();
            continue;
          }

        const double slope    = choose_direction();
        bool         followed = true; // whether the step goes along a direction
        if (any_beyond)
          {
            // Only truncate where a step as well has not helped, or the pressure has an
            // upper limit: with many points of hardly any gap or pressure it may cycle.
            followed = !late && !cautious && !constraint.is_limited() &&
                       solution.residual < least_residual;
            step_within_limits(followed ? last_length : 0.);
            least_residual = std::min(least_residual, solution.residual);
          }
        else if (!step(slope))
          {
            // If that was the exact gap, nothing can be improved, as with a single point.
            const bool is_solved = gap_is_exact;
            find_gap();
            if (is_solved)
              break;
          }
        watch_energy();
        solution.iterations += followed ? 1 : 0;
      }

    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      gap[i] -= gap_shift + tolerance.unit * shift;
    return solution;
  }

  /** Bring p within its limits, with the prescribed mean, and compute g = G p + u0 − h in
   *  double precision. */
  void
  DualConjugateGradients::find_gap()
  {
    double            *p = pressure, *g = gap;
    const double      *h     = problem.heights;
    const WithinLimits limit = within_limits(problem, constraint, active, p);
    const auto [mean, p_h]   = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      p[i]      = limit(p[i], active[i] != 0);
      active[i] = p[i] != 0;
      sums[0] += p[i];
      sums[1] += p[i] * h[i];
    });
    const double u0          = constraint.displacement();
    const double p_Gp        = problem.apply(p, g);
    const auto [sum_g, area] = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      g[i] += u0 - h[i];
      places[i] = place_of(p[i], constraint.limit);
      if (places[i] != Place::free)
        return;
      sums[0] += g[i];
      sums[1] += 1;
    });
    gap_shift                = constraint.excess(sum_g, area);
    float *y                 = gap_in_units.data();
    move([=, s = gap_shift, unit = 1. / tolerance.unit](const std::size_t i) {
      y[i] = static_cast<float>(unit * (g[i] - s));
    });
    gap_is_exact = true;
    truncated    = false;

    const double elastic = 0.5 * p_Gp;
    const double work    = p_h - u0 * mean;
    energy               = elastic - work;
    energy_scale         = elastic + std::abs(work);
    lowest_energy        = energy;
    cautious             = false;
  }

  void
  DualConjugateGradients::watch_energy()
  {
    if (any_beyond)
      return;
    cautious      = energy > lowest_energy + 1e-12 * energy_scale;
    lowest_energy = std::min(lowest_energy, energy);
  }

  // These loops run over all points and are memory-bound: they touch p, t and z only in
  // contact. They work on local copies of members because, for all the compiler knows, a
  // write to a field might change a member.

  /**
   * Choose C: the points whose pressure is between its limits or beyond and, unless the
   * pressure was just truncated, those that penetrate at zero pressure or open at the
   * upper limit. Write the gap y on C, and 0 elsewhere, to the scratch memory. Return the
   * residual, the largest violation of the conditions on the gap.
   */
  double
  DualConjugateGradients::choose_active_set()
  {
    const float  *y     = gap_in_units.data();
    const Place  *place = places.data();
    float        *z     = problem.scratch();
    std::uint8_t *c     = active.data();
    const auto    s     = static_cast<float>(shift);
    const bool    grows = !truncated;
    float         worst = 0;
    for (const SlabLayout::Range &range : problem.ranges)
      {
        // No branches, and a maximum in any order, so that four points go at a time.
#pragma omp simd reduction(max : worst)
        for (std::size_t i = range.begin; i < range.end; ++i)
          {
            const float centred  = y[i] - s;
            const bool  is_free  = place[i] == Place::free;
            const bool  is_wrong = is_free | ((place[i] == Place::none) & (centred < 0)) |
                                  ((place[i] == Place::full) & (centred > 0));
            const bool counts = is_free | (grows & is_wrong);
            c[i]              = counts;
            z[i]              = counts ? centred : 0.f;
            worst             = std::max(worst, is_wrong ? std::abs(centred) : 0.f);
          }
      }
    return maximum(problem.communicator, worst);
  }

  /**
   * Compute z = M y in the scratch memory, and choose beta and the means such that the
   * direction t = z + beta t on C is conjugate to the last one and admissible. Return
   * <y, t> > 0.
   */
  double
  DualConjugateGradients::choose_direction()
  {
    // A recomputed gap starts a new sequence of conjugate directions.
    if (gap_is_exact)
      std::fill_n(direction, 2 * problem.size, 0.f);
    const float *y = gap_in_units.data(), *t = direction, *r = response;
    float       *z = problem.scratch();
    const auto  *c = active.data();
    const auto   s = static_cast<float>(shift);
    problem.precondition(z, c);
    const auto [area, sum_z, sum_t, sum_y, sum_r, z_r, t_r, y_z, y_t] =
      weighted_sums<9>(problem, [=](const auto i, auto &sums) {
        if (!c[i])
          return;
        const double z_i = z[i], t_i = t[i], r_i = r[i], y_i = y[i] - s;
        sums[0] += 1;
        sums[1] += z_i;
        sums[2] += t_i;
        sums[3] += y_i;
        sums[4] += r_i;
        sums[5] += z_i * r_i;
        sums[6] += t_i * r_i;
        sums[7] += y_i * z_i;
        sums[8] += y_i * t_i;
      });
    mean_z          = constraint.excess(sum_z, area);
    mean_t          = constraint.excess(sum_t, area);
    double gradient = y_z - mean_z * sum_y;
    beta            = 0;
    if (!(gradient > 0))
      {
        // M is not positive on this C: use z = y.
        const auto [y_y] = weighted_sums<1>(problem, [=](const auto i, auto &sums) {
          z[i] = c[i] ? y[i] - s : 0.f;
          sums[0] += static_cast<double>(z[i]) * z[i];
        });
        mean_z           = constraint.excess(sum_y, area);
        return y_y - mean_z * sum_y;
      }
    if (!cautious && t_r > 0)
      beta = std::max(0., -(z_r - mean_z * sum_r) / t_r);
    const double slope = gradient + beta * (y_t - mean_t * sum_y);
    if (slope > 0)
      return slope;
    beta = 0;
    return gradient;
  }

  /** Return the next direction as a function of the point. */
  auto
  DualConjugateGradients::next_direction() const
  {
    return [z  = problem.scratch(),
            t  = direction,
            c  = active.data(),
            z0 = static_cast<float>(mean_z),
            b  = static_cast<float>(beta),
            t0 = static_cast<float>(mean_t)](const std::size_t i) {
      return c[i] ? (z[i] - z0) + b * (t[i] - t0) : 0.f;
    };
  }

  /** Form t and go to the minimum along it, also beyond the limits. Return whether there
   *  is one. */
  bool
  DualConjugateGradients::step(const double slope)
  {
    float     *t = direction, *r = response, *y = gap_in_units.data();
    const auto next = next_direction();
    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      t[i] = next(i);
    const double curvature = problem.respond(t, r);
    const bool   is_convex = curvature > 0;
    const double length    = is_convex ? slope / curvature : 0.;
    double      *p         = pressure;
    const auto  *c         = active.data();
    const double far       = tolerance.unit * length;
    const auto   s = static_cast<float>(shift), l = static_cast<float>(length);
    move([=](const std::size_t i) {
      if (c[i])
        p[i] -= far * t[i];
      y[i] = (y[i] - s) - l * r[i];
    });
    if (!is_convex)
      return false;
    gap_is_exact = false;
    truncated    = false;
    last_length  = length;
    energy -= 0.5 * (tolerance.unit * tolerance.unit) * slope * length;
    return true;
  }

  /**
   * Bring the pressure within its limits and, in the same step, go along the direction:
   * both for the price of one response. No minimum is sought, as truncation is not
   * linear: the step is half of @p length, which is that of the last step, or 0 to
   * truncate only. (The whole of it takes a tenth to a sixth more responses at 2048²
   * points and as many at 1024², a quarter of it a tenth more at both.) The old direction
   * and its response are kept, because the next direction is to be conjugate to them.
   */
  void
  DualConjugateGradients::step_within_limits(const double length)
  {
    double       *p     = pressure;
    float        *y     = gap_in_units.data();
    std::uint8_t *c     = active.data();
    Place        *place = places.data();
    float        *d     = problem.scratch(); // z, then direction, step, its response
    const double  far = .5 * tolerance.unit * length, unit = 1. / tolerance.unit;
    const auto    next = next_direction();
    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      {
        d[i] = next(i);
        if (c[i])
          p[i] -= far * d[i];
      }
    const WithinLimits limit = within_limits(problem, constraint, active, p);
    const auto         s     = static_cast<float>(shift);
    const auto [slope]       = weighted_sums<1>(problem, [=](const auto i, auto &sums) {
      if (!limit.shifts_all && !c[i])
        return;
      const double before = p[i] + far * d[i];
      p[i]                = limit(p[i], c[i] != 0);
      d[i]                = static_cast<float>(unit * (before - p[i]));
      c[i]                = p[i] != 0;
      place[i]            = Place::none; // move() sets that of points in contact
      sums[0] += static_cast<double>(y[i] - s) * d[i];
    });
    const double d_r         = problem.respond(d, d);
    move([=](const std::size_t i) { y[i] = (y[i] - s) - d[i]; });
    gap_is_exact = false;
    truncated    = true;
    energy -= (tolerance.unit * tolerance.unit) * (slope - .5 * d_r);
  }

  /** Call move_point(i) for all points. Then set any_beyond and, from the mean of y on
   *  the points between the limits, all of which are in C, shift. */
  template <class MovePoint>
  void
  DualConjugateGradients::move(const MovePoint &move_point)
  {
    const double *p     = pressure;
    const float  *y     = gap_in_units.data();
    const auto   *c     = active.data();
    Place        *place = places.data();
    const double  limit = constraint.limit;
    const auto [beyond, sum_y, area] =
      weighted_sums<3>(problem, [=](const auto i, auto &sums) {
        move_point(i);
        if (!c[i])
          return;
        place[i]             = place_of(p[i], limit);
        const double is_free = place[i] == Place::free ? 1. : 0.;
        sums[0] += ((p[i] < 0) | (p[i] > limit)) ? 1. : 0.;
        sums[1] += is_free * y[i];
        sums[2] += is_free;
      });
    any_beyond = beyond > 0;
    shift      = constraint.excess(sum_y, area);
    if (area > 0 || !constraint.is_limited())
      return;
    // Every pressure is at a limit. Take the middle between the smallest gap at pressure
    // 0 and the largest at the upper limit.
    double least_open   = std::numeric_limits<double>::infinity();
    double most_pressed = -least_open;
    for (const SlabLayout::Range &range : problem.ranges)
      for (std::size_t i = range.begin; i < range.end; ++i)
        if (place[i] == Place::none)
          least_open = std::min<double>(least_open, y[i]);
        else
          most_pressed = std::max<double>(most_pressed, y[i]);
    shift = .5 * (maximum(problem.communicator, most_pressed) -
                  maximum(problem.communicator, -least_open));
  }
} // namespace strait
