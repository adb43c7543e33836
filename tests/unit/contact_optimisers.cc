// SPDX-License-Identifier: GPL-2.0-or-later
// The optimisers on a problem without a grid: points of different areas, all on the first
// rank, with a dense matrix G and preconditioners M of any quality.
#include <strait/base/collective.h>
#include <strait/contact/optimisers.h>

#include <gtest/gtest.h>

#include "contact_tools.h"

namespace
{
  using namespace contact_tests;

  enum class Quality
  {
    none,    // M = 1
    uneven,  // positive, but far from the inverse of G
    negative // M = −1, which DualProblem forbids
  };

  /** 60 points on the first rank, of which the first 20 have nine times the area. */
  struct DensePoints
  {
    DensePoints()
    {
      n = rank_in(MPI_COMM_WORLD) == 0 ? 60 : 0;
      for (std::size_t i = 0; i < n; ++i)
        {
          position.push_back(std::fmod(0.6180339887 * static_cast<double>(i + 1), 1.));
          height.push_back(std::cos(2 * pi * position[i]) +
                           0.3 * std::sin(9. * position[i]));
        }
      // Areas of 1 and 1/9 in a unit such that they sum to one.
      const double unit = 1. / (20. + 40. / 9.);
      if (n > 0)
        parts = {{0, 20, unit}, {20, 60, unit / 9}};
    }

    std::size_t                    n = 0;
    std::vector<double>            position, height;
    std::vector<SlabLayout::Range> parts;
  };

  class DenseProblem
    : private DensePoints
    , public DualProblem
  {
  public:
    explicit DenseProblem(const Quality quality)
      : DualProblem({MPI_COMM_WORLD, n, height.data(), parts, 1.})
      , quality(quality)
      , room(n)
    {
    }

    double
    weight(const std::size_t i) const
    {
      return parts[i < 20 ? 0 : 1].area;
    }

    double
    apply(const double *p, double *u) override
    {
      return act(p, u);
    }

    double
    respond(const float *step, float *response) override
    {
      return act(step, response);
    }

    void
    precondition(float *values, const std::uint8_t * /* marks */) override
    {
      for (std::size_t i = 0; i < n; ++i)
        values[i] *= quality == Quality::negative ? -1.f
                     : quality == Quality::uneven ? 1.f + 50.f * static_cast<float>(i % 7)
                                                  : 1.f;
    }

    float *
    scratch() override
    {
      return room.data();
    }

    long
    n_applications() const override
    {
      return applications;
    }

  private:
    /** Return the work <step, G step>. Both arrays may be the same. */
    template <class Number>
    double
    act(const Number *step, Number *response)
    {
      const std::vector<double> p(step, step + n);
      double                    work = 0;
      for (std::size_t i = 0; i < n; ++i)
        {
          double u = 0;
          for (std::size_t j = 0; j < n; ++j)
            u += std::exp(-8 * std::abs(position[i] - position[j])) * weight(j) * p[j];
          response[i] = static_cast<Number>(u);
          work += weight(i) * p[i] * u;
        }
      work = sum(MPI_COMM_WORLD, work);
      ++applications;
      return work;
    }

    Quality            quality;
    std::vector<float> room;
    long               applications = 0;
  };

  /** Solve, check the conditions that define the solution, and return the gaps. */
  std::vector<double>
  solved(const ContactMethod      method,
         const Quality            quality,
         const ContactConstraint &constraint,
         const double             mean)
  {
    // Where M is rejected, steps follow the gradient and many are needed. With an M that
    // is off by a factor of 300 it takes up to 2105, as points join the contact only
    // after steps without truncation.
    const double          tolerance = quality == Quality::negative ? 1e-5 : 1e-10;
    DenseProblem          problem(quality);
    std::vector<double>   p(problem.size, 1.), g(problem.size), u(problem.size);
    const ContactSolution solution =
      find_pressure(method,
                    {problem, constraint, {tolerance, 1., 3000}, p.data(), g.data()});
    EXPECT_TRUE(solution.converged) << solution.residual;

    problem.apply(p.data(), u.data());
    double total = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      {
        EXPECT_GE(p[i], 0.);
        EXPECT_LE(p[i], constraint.limit);
        if (p[i] < constraint.limit)
          {
            EXPECT_GE(g[i], -tolerance);
          }
        if (p[i] > 0)
          {
            EXPECT_LT(g[i], tolerance);
          }
        const double u0 = g[i] - u[i] + problem.heights[i];
        EXPECT_NEAR(u0, g[0] - u[0] + problem.heights[0], 1e-9);
        total += problem.weight(i) * p[i];
      }
    if (mean > 0)
      {
        EXPECT_NEAR(sum(MPI_COMM_WORLD, total), mean, 1e-12);
      }
    return g;
  }

  /**
   * Two pressures that solve the problem to the residual ε differ by d with
   * <d, Gd> <= 2 ε <p + p'>. Thus |G d| <= sqrt(4 ε max <p>), 4.5e-5 for ε = 1e-10.
   */
  void
  expect_equal(const std::vector<double> &a, const std::vector<double> &b)
  {
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], b[i], 4.5e-5) << "at point " << i;
  }

  constexpr auto textbook = ContactMethod::polonsky_keer;
  constexpr auto dual_cg  = ContactMethod::dual_cg;

  TEST(Optimisers, KnowNoGridAndSurviveAnyPreconditioner)
  {
    for (const double load : {0.05, 0.5, 5.})
      {
        const ContactConstraint constraint{true, load};
        const auto expected = solved(textbook, Quality::none, constraint, load);
        for (const Quality quality : {Quality::none, Quality::uneven, Quality::negative})
          expect_equal(solved(dual_cg, quality, constraint, load), expected);
      }
  }

  TEST(Optimisers, ShiftAPressureToTheNearestWithinLimits)
  {
    constexpr double   limit = 1.;
    const DenseProblem problem(Quality::none);
    for (const double mean : {1e-3, .3, .999})
      for (const bool shifts_all : {true, false})
        {
          std::vector<double>       before(problem.size);
          std::vector<std::uint8_t> is_active(problem.size, 1);
          for (std::size_t i = 0; i < before.size(); ++i)
            {
              before[i] = .7 + 2 * std::sin(17. * static_cast<double>(i));
              if (!shifts_all && i % 9 == 0)
                {
                  is_active[i] = 0;
                  before[i]    = i % 2 == 0 ? 0. : limit;
                }
            }
          std::vector<double> p = before;
          const WithinLimits  within =
            within_limits(problem, {true, mean, limit}, is_active, p.data());
          for (std::size_t i = 0; i < p.size(); ++i)
            p[i] = within(p[i], is_active[i] != 0);
          // Points between the limits share one shift; truncation makes that of the
          // others smaller at the upper limit, and larger at 0.
          double least = -INFINITY, most = INFINITY, total = 0;
          int    n_held = 0;
          for (std::size_t i = 0; i < p.size(); ++i)
            {
              const double shift = p[i] - before[i];
              total += problem.weight(i) * p[i];
              n_held += is_active[i] == 0 && p[i] == before[i];
              EXPECT_TRUE(p[i] >= 0 && p[i] <= limit);
              if (is_active[i] == 0 && mean == .3)
                continue;
              least = p[i] > 0 ? std::max(least, shift) : least;
              most  = p[i] < limit ? std::min(most, shift) : most;
            }
          EXPECT_LE(least, most + 1e-15);
          EXPECT_NEAR(sum(MPI_COMM_WORLD, total) / mean, 1., 1e-13);
          // With this mean alone the points that are not active can be held.
          if (!shifts_all && mean == .3 && !p.empty())
            {
              EXPECT_EQ(n_held, 7);
            }
        }
  }

  TEST(Optimisers, HoldTheLimitOfThePressure)
  {
    // The ratio of load to limit. With .2 every pressure can be 0 or at the limit, which
    // leaves the gap undetermined by a small shift.
    for (const double load : {.05, .5, 5.})
      for (const double part : {.23, .61, .97})
        {
          const double            limit = load / part;
          const ContactConstraint constraint{true, load, limit};
          const auto expected = solved(dual_cg, Quality::none, constraint, load);
          for (const Quality quality : {Quality::uneven, Quality::negative})
            expect_equal(solved(dual_cg, quality, constraint, load), expected);
        }
  }

  TEST(Optimisers, HoldTheRigidDisplacement)
  {
    for (const double displacement : {0.9, 0., -2.})
      {
        const ContactConstraint constraint{false, displacement};
        const auto expected = solved(textbook, Quality::none, constraint, 0.);
        for (const Quality quality : {Quality::none, Quality::uneven})
          expect_equal(solved(dual_cg, quality, constraint, 0.), expected);
        solved(dual_cg, Quality::negative, constraint, 0.);
      }
  }
} // namespace
