// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace strait
{
  namespace
  {
    /** unmarked(begin, end) or some(begin, end) for eight points of a range at a time. As
     *  contact lies in patches, most of these are marked alike. */
    template <class Unmarked, class Some>
    void
    by_eights(const std::uint8_t          *marks,
              const ContactProblem::Block &range,
              const Unmarked              &unmarked,
              const Some                  &some)
    {
      std::size_t i = range.begin;
      for (; i + 8 <= range.end; i += 8)
        {
          std::uint64_t eight;
          std::memcpy(&eight, marks + i, 8);
          if (eight == 0)
            unmarked(i, i + 8);
          else
            some(i, i + 8);
        }
      some(i, range.end);
    }

    /** visit(i) for the marked points of a range. */
    template <class Visit>
    void
    for_each_marked(const std::uint8_t          *marks,
                    const ContactProblem::Block &range,
                    const Visit                 &visit)
    {
      by_eights(
        marks,
        range,
        [](std::size_t, std::size_t) {},
        [=, &visit](const std::size_t begin, const std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            if (marks[i])
              visit(i);
        });
    }
  } // namespace

  // The loops here run over all points and are bound by the memory: they are fused
  // into passes over ranges that stay in the cache, and touch p, t and z only in
  // contact. They work on local copies of members because, for all the compiler
  // knows, a write to a field might change a member.

  /**
   * C: the points between the limits of the pressure or beyond and, unless the pressure
   * was just truncated, those that penetrate without pressure or part under the largest.
   * Set y, the gap on C and 0 elsewhere. Return the largest gap that should be none.
   */
  double
  DualConjugateGradients::choose_contact(const Block &range)
  {
    const double *p = pressure, *g = gap;
    float        *y = problem.scratch();
    std::uint8_t *c = in_contact.data();
    const double  s = shift, unit = 1. / tolerance.unit;
    const double  limit  = constraint.limit;
    const bool    grows  = !truncated;
    const auto    choose = [=](const std::size_t begin, const std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        {
          const double centred  = g[i] - s;
          const bool   is_free  = (p[i] != 0) & (p[i] != limit);
          const bool   is_wrong = is_free | (p[i] == 0 ? centred < 0 : centred > 0);
          c[i]                  = is_wrong;
          y[i]                  = is_wrong ? static_cast<float>(unit * centred) : 0.f;
        }
    };
    const bool limited     = constraint.is_limited();
    const auto choose_open = [=](const std::size_t begin, const std::size_t end) {
      bool any = limited; // for these points may bear the largest pressure
      for (std::size_t i = begin; i < end; ++i)
        any |= g[i] < s;
      if (any)
        return choose(begin, end);
      std::fill(y + begin, y + end, 0.f);
    };
    by_eights(c, range, choose_open, choose);
    double worst = 0;
    for_each_marked(c, range, [=, &worst](const std::size_t i) {
      worst = std::max(worst, std::abs(g[i] - s));
      if (!grows && (p[i] == 0 || p[i] == limit))
        {
          c[i] = 0;
          y[i] = 0.f;
        }
    });
    return worst;
  }

  void
  DualConjugateGradients::measure(const Block &range)
  {
    const double *g = gap;
    const float  *z = problem.scratch(), *t = direction.data(), *r = response.data();
    const std::uint8_t   *c = in_contact.data();
    std::array<double, 9> sums{};
    for_each_marked(
      c, range, [=, &sums, s = shift, unit = 1. / tolerance.unit](const std::size_t i) {
        const double z_i = z[i], t_i = t[i], r_i = r[i], y_i = unit * (g[i] - s);
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
    on_contact.add(range, sums);
  }

  /** Write the next direction to @p next, which is that of before or z. */
  void
  DualConjugateGradients::form_direction(const Block &range, float *next)
  {
    const float        *z = problem.scratch(), *t = direction.data();
    const std::uint8_t *c  = in_contact.data();
    const auto          z0 = static_cast<float>(mean_z), b = static_cast<float>(beta),
               t0 = static_cast<float>(mean_t);
    by_eights(
      c,
      range,
      [=](const std::size_t begin, const std::size_t end) {
        std::fill(next + begin, next + end, 0.f);
      },
      [=](const std::size_t begin, const std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          next[i] = c[i] ? (z[i] - z0) + b * (t[i] - t0) : 0.f;
      });
  }

  /** p −= length t, g −= length r. */
  void
  DualConjugateGradients::move(const Block &range, const double length)
  {
    double             *p   = pressure;
    const float        *t   = direction.data();
    const std::uint8_t *c   = in_contact.data();
    const double        far = tolerance.unit * length;
    for_each_marked(c, range, [=](const std::size_t i) { p[i] -= far * t[i]; });
    follow(range, response.data(), length);
  }

  /** g −= length r; absorb the shift, and measure the free points. */
  void
  DualConjugateGradients::follow(const Block &range, const float *r, const double length)
  {
    double      *g   = gap;
    const double s   = shift;
    const double far = tolerance.unit * length;
    for (std::size_t i = range.begin, end = range.end; i < end; ++i)
      g[i] = (g[i] - s) - far * r[i];
    measure_free(range);
  }

  /** Sums over points between the limits of the pressure or beyond these, which are all
   *  marked: how many are beyond, their gaps, and how many they are. */
  void
  DualConjugateGradients::measure_free(const Block &range)
  {
    const double         *g = gap, *p = pressure;
    const double          limit = constraint.limit;
    std::array<double, 3> sums{};
    for_each_marked(in_contact.data(), range, [=, &sums](const std::size_t i) {
      const double is_free = ((p[i] != 0) & (p[i] != limit)) ? 1. : 0.;
      sums[0] += ((p[i] < 0) | (p[i] > limit)) ? 1. : 0.;
      sums[1] += is_free * g[i];
      sums[2] += is_free;
    });
    free_points.add(range, sums);
  }

  /**
   * Bring the pressure within its limits and, on the way, go along the direction: one
   * step for the price of one response. A minimum is not sought, as truncation is not
   * straight: of @p length, that of the last step or 0, one half is gone. (All of it
   * takes a tenth to a sixth more responses at 2048² points and as many at 1024², a
   * quarter a tenth more at both.) Direction and response of before remain, for what
   * follows is to be conjugate to them.
   */
  void
  DualConjugateGradients::step_within_limits(const double length)
  {
    double       *p   = pressure;
    const double *g   = gap;
    std::uint8_t *c   = in_contact.data();
    float        *d   = problem.scratch(); // z, the direction, the step, its response
    const double  far = .5 * tolerance.unit * length, unit = 1. / tolerance.unit;
    for (const Block &range : problem.blocks)
      if (length > 0)
        {
          form_direction(range, d);
          for_each_marked(c, range, [=](const std::size_t i) { p[i] -= far * d[i]; });
        }
      else
        std::fill(d + range.begin, d + range.end, 0.f);
    const WithinLimits limit = within_limits(problem, constraint, in_contact, p);
    WeightedSums<1>    gained;
    free_points      = {};
    const auto enter = [=, &limit, &gained, s = shift](const Block &range) {
      std::array<double, 1> sums{};
      const auto            enter_point = [=, &limit, &sums](const std::size_t i) {
        const double before = p[i] + far * d[i];
        p[i]                = limit(p[i], c[i] != 0);
        d[i]                = static_cast<float>(unit * (before - p[i]));
        c[i]                = p[i] != 0;
        sums[0] += unit * (g[i] - s) * d[i];
      };
      if (limit.all_move)
        for (std::size_t i = range.begin; i < range.end; ++i)
          enter_point(i);
      else
        for_each_marked(c, range, enter_point);
      gained.add(range, sums);
    };
    const double d_r   = problem.respond(d, d, enter, [&](const Block &range, double) {
      follow(range, d, 1.);
    });
    const auto [slope] = gained.over_ranks(problem);
    note_free();
    gap_is_exact = false;
    truncated    = true;
    energy -= (tolerance.unit * tolerance.unit) * (slope - .5 * d_r);
  }
} // namespace strait
