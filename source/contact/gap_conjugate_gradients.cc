// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    /** Step at negative total curvature, over the step that the elastic curvature alone
     *  suggests, which is too cautious. Double of it leaves a saddle sooner but is
     *  shortened more often; a third of it, the elastic step, takes two fifths more FFT
     *  pairs where the range of the adhesion is hardly resolved (random surface, 256²,
     *  Tabor number 2). */
    constexpr double boldness = 3;

    /** Factor by which a step is shortened if the energy does not fall along it; forming
     *  the step anew costs one FFT pair. A step that closes points is taken whole unless
     *  its minimum lies closer than this fraction: a whole step keeps the points closed,
     *  a shorter one opens them again. One step changes the reach by at most this factor.
     *  The reach has no lower bound: with one, a single point that closes and opens in
     *  turns could keep the others from moving. Half of it wastes less on attempts but
     *  goes less far, and a single step can mislead the reach; double of it opens points
     *  again in most steps, and the reach never adapts. */
    constexpr double shorter = .4;

    /** Fraction of the first attempt at which attempts end. */
    constexpr double shortest = std::numeric_limits<double>::epsilon();
  } // namespace

  void
  GapConjugateGradients::begin()
  {
    restarts = true;
    reach    = 1;
  }

  bool
  GapConjugateGradients::descend(double)
  {
    while (true)
      {
        trial = derivative;
        precondition(trial.data());
        const bool falls = go(choose_direction());
        if (falls || restarts) // after a restart only rounding is left
          {
            restarts = !falls;
            return falls;
          }
        restarts = true;
      }
  }

  /** Compute t = −z + β d on the free points. Return the predicted step length. */
  double
  GapConjugateGradients::choose_direction()
  {
    double       *t = trial.data(), *d = step.data();
    const double *r = derivative.data(), *q = response.data();
    if (!restarts)
      project_on_free(d);

    const auto [z_r, z_q, z_local, d_q, d_local, d_r] =
      weighted_sums<6>(problem, [&](const auto i, auto &sums) {
        if (!is_free(i))
          return;
        const double gamma = curvature[i];
        sums[0] += t[i] * r[i];
        sums[1] += t[i] * q[i];
        sums[2] += t[i] * gamma * d[i];
        sums[3] += d[i] * q[i];
        sums[4] += d[i] * gamma * d[i];
        sums[5] += d[i] * r[i];
      });
    const double d_curvature = d_q + d_local;
    double       beta        = 0;
    // Hestenes and Stiefel's beta or, where the energy has negative curvature along d and
    // d is the more worth keeping, Polak and Ribière's unless the last fall was rounding.
    if (!restarts && d_curvature > 0)
      beta = std::max(0., (z_q + z_local) / d_curvature);
    else if (!restarts && last_fall > energy_noise * std::abs(energy()))
      beta = std::max(0., (z_q + z_local) / last_fall);
    if (-z_r + beta * d_r >= 0)
      beta = 0;

    const auto [local] = weighted_sums<1>(problem, [&, beta](const auto i, auto &sums) {
      t[i] = -t[i] + beta * d[i];
      sums[0] += t[i] * curvature[i] * t[i];
    });
    const double slope = -z_r + beta * d_r;
    free_work          = z_r;
    fixed_work         = beta * (beta * d_q - 2 * z_q);
    // At least a tenth of free_work, or the step could become far too long.
    const double predicted = std::max(stiffness * free_work + fixed_work, .1 * free_work);
    const double whole     = predicted + local;
    return -reach * slope / (whole > 0 ? whole : predicted);
  }

  /** Go along the projected direction until the energy falls sufficiently. Return whether
   *  it did. */
  bool
  GapConjugateGradients::go(const double length)
  {
    for (double part = 1; part > shortest; part *= shorter)
      {
        // Too many points close at once; a shorter step closes fewer.
        const double work = form_step(part * length);
        if (search_line(work))
          return true;
        if (!truncated)
          return false;
      }
    return false;
  }

  /** Compute d = max(g + s t, 0) − g, where s is @p length, and K d. Return <d, Kd>. */
  double
  GapConjugateGradients::form_step(const double length)
  {
    double       *d = step.data();
    const double *g = gap, *t = trial.data();
    double        closing = 0;
    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      {
        d[i]    = g[i] + length * t[i];
        closing = d[i] < 0 ? 1. : closing;
      }
    truncated = maximum(problem.communicator, closing) > 0;
    make_admissible(d);
    for (std::size_t i = 0, n = problem.size; i < n; ++i)
      d[i] -= g[i];
    const double work = problem.apply(d, response.data());
    if (free_work > 0)
      {
        const double fraction =
          (work / (length * length) - fixed_work) / free_work; // <z, Kz>/<z, r>
        // A step that closes many points says little about the stiffness of the others.
        stiffness = std::clamp(fraction, .2, 3.);
      }
    return work;
  }

  /** Go along d until the energy falls sufficiently. Return whether it did; if not, the
   *  gap is as before. */
  bool
  GapConjugateGradients::search_line(const double work)
  {
    const double *d = step.data(), *g = gap;
    double        furthest  = INFINITY;
    const auto [d_r, local] = weighted_sums<2>(problem, [&](const auto i, auto &sums) {
      sums[0] += d[i] * derivative[i];
      sums[1] += d[i] * curvature[i] * d[i];
      if (d[i] < 0)
        furthest = std::min(furthest, -g[i] / d[i]);
    });
    furthest                = minimum(problem.communicator, furthest);
    if (!(d_r < 0))
      return false;
    const bool   is_convex = work + local > 0;
    const double bold  = work > 0 ? -boldness * d_r / work : 1.; // d uniform, or noise
    const double ideal = is_convex ? -d_r / (work + local) : bold;
    const double length_of_whole = ideal < shorter ? ideal : 1.;
    const double first  = truncated ? length_of_whole : std::min(ideal, furthest);
    const double before = energy();
    double       gone   = 0;
    for (double part = 1; part > shortest; part *= shorter)
      {
        const double length = part * first;
        move(d, response.data(), work, length - gone);
        gone = length;
        if (energy() <= before + 1e-4 * length * d_r + energy_noise * std::abs(before))
          {
            step_length = length;
            last_fall   = -length * d_r;
            // The predicted length was wrong by the factor `ideal`; where no point
            // closes, the step had the ideal length.
            const double change =
              std::clamp(is_convex ? ideal : INFINITY, shorter, 1 / shorter);
            reach = truncated ? reach * change : 1.;
            return true;
          }
      }
    move(d, response.data(), work, -gone);
    return false;
  }
} // namespace strait
