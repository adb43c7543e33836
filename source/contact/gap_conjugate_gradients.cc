// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    /** Where the attraction wins, the elastic curvature alone is too cautious. Double of
     *  it leaves a saddle sooner, and is shortened more often; a third of it, the elastic
     *  step, takes two fifths more FFT pairs where the range of the adhesion is hardly
     *  resolved (a random surface of 256² at a Tabor number of 2). */
    constexpr double boldness = 3;

    /** What a step is shortened by if the energy does not fall along it, at one FFT pair
     *  if it must be formed anew. A step that closes points is shortened only if the line
     *  asks for at least as much: a whole step keeps what it closes, a shorter one opens
     *  it again. By no more the reach of steps that close points changes at once; it has
     *  no least value, for with one a single point that each step closes and opens again
     *  would keep the others from moving. Half of it wastes less on attempts and goes
     *  less far, and the reach is misled by a single step; double of it opens points
     *  again in most steps, and the reach never learns. */
    constexpr double shorter = .4;

    /** Attempts end where a step is all but nothing. */
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
        if (falls || restarts) // or rounding is all that is left
          {
            restarts = !falls;
            return falls;
          }
        restarts = true;
      }
  }

  /** t = −z + β d on the free points. Return how far to go. */
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
    // Hestenes and Stiefel's beta or, where the energy curves down along d and d is
    // worth keeping all the more, Polak and Ribière's; not where all is rounding.
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
    // Not less than a tenth of that of the free points, or the step would be wild.
    const double foretold = std::max(stiffness * free_work + fixed_work, .1 * free_work);
    const double whole    = foretold + local;
    return -reach * slope / (whole > 0 ? whole : foretold);
  }

  /** Follow the projected direction as far as the energy falls well. Return whether
   *  it did. */
  bool
  GapConjugateGradients::go(const double length)
  {
    for (double part = 1; part > shortest; part *= shorter)
      {
        // Too many points close at once: a shorter arc has fewer of them.
        const double work = form_step(part * length);
        if (search_line(work))
          return true;
        if (!truncated)
          return false;
      }
    return false;
  }

  /** d = max(g + s t, 0) − g and K d. Return <d, Kd>. */
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
        // A step that closes many points says little of the stiffness of the others.
        stiffness = std::clamp(fraction, .2, 3.);
      }
    return work;
  }

  /** Go along d as far as the energy falls well. Return whether it did; if not, the
   *  gap is as it was. */
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
            // The length that was foretold was wrong by the factor `ideal`; where nothing
            // closes, the step went as far as was ideal.
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
