// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_optimisation.h>

#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** Last relative change of the quotient. The check takes 4 to 6 pairs; half of it
     *  costs more of them in each load and finds shallower ways down, double of it fewer
     *  and misses these. */
    constexpr double settled = .03;

    /** A field and K of it. */
    struct Response
    {
      std::vector<double> of, stiffness;
    };

    /** What stands over and under a quotient. */
    struct Products
    {
      double over, under;
    };

    /** A descent of the quotient at one gap; see GapOptimiser::smallest_curvature(). */
    struct QuotientDescent
    {
      GapProblem   &problem;
      const bool    fixes_mean_gap;
      const double *curvature; // γ''

      std::vector<std::uint8_t> closed;   // marks of points that are not free
      Response                  v, d;     // the eigenvector; the direction, at first 0
      std::vector<double>       z;        // the preconditioned gradient
      double                    fall = 0; // of the quotient along z, at first 0

      void
      mask(std::vector<double> &values) const
      {
        project(
          problem,
          [this](const std::size_t i) { return !closed[i]; },
          fixes_mean_gap,
          values.data());
      }

      /** Find K of the field. */
      void
      respond(Response &x)
      {
        problem.apply(x.of.data(), x.stiffness.data());
      }

      Products
      products(const Response &x, const std::vector<double> &y) const
      {
        const auto [elastic, local, mean_x, mean_y] =
          weighted_sums<4>(problem, [&](const auto i, auto &sums) {
            if (closed[i])
              return;
            sums[0] += x.stiffness[i] * y[i];
            sums[1] += curvature[i] * x.of[i] * y[i];
            sums[2] += x.of[i];
            sums[3] += y[i];
          });
        return {elastic + local, elastic + problem.mean_stiffness() * mean_x * mean_y};
      }

      /** The least quotient found; v is on return where it is. */
      double
      find_lowest()
      {
        mask(v.of);
        respond(v);
        Products vv = products(v, v.of);
        if (!(vv.under > 0)) // no point is free
          {
            problem.fill_with_noise(v.of.data());
            return 1;
          }
        double quotient = vv.over / vv.under;
        for (int n_settled = 0; n_settled < 2;)
          {
            choose_direction(quotient, vv.under);
            respond(d);
            const Products dd = products(d, d.of), vd = products(v, d.of);
            // The quotient at v + s d is least where s² a + s b + c = 0, with a plus
            // before the root.
            const double a = dd.over * vd.under - vd.over * dd.under,
                         b = dd.over * vv.under - vv.over * dd.under,
                         c = vd.over * vv.under - vv.over * vd.under;
            const double s = -2 * c / (b + std::sqrt(std::max(0., b * b - 4 * a * c)));
            if (!std::isfinite(s)) // no direction is left
              break;
            for (std::size_t i = 0; i < problem.size; ++i)
              {
                v.of[i] += s * d.of[i];
                v.stiffness[i] += s * d.stiffness[i];
              }
            vv                  = {vv.over + s * (2 * vd.over + s * dd.over),
                                   vv.under + s * (2 * vd.under + s * dd.under)};
            const double before = std::exchange(quotient, vv.over / vv.under);
            n_settled =
              before - quotient > settled * std::abs(quotient) ? 0 : n_settled + 1;
          }
        return quotient;
      }

      /** Let d go down the preconditioned gradient, conjugate to the last d; @p norm is
       *  the square of v's. */
      void
      choose_direction(const double quotient, const double norm)
      {
        const auto [mean] = weighted_sums<1>(problem, [this](const auto i, auto &sums) {
          sums[0] += v.of[i];
        });
        const double uniform  = problem.mean_stiffness() * mean;
        const auto   gradient = [this, quotient, uniform, norm](const std::size_t i) {
          return ((1 - quotient) * v.stiffness[i] + curvature[i] * v.of[i] -
                  quotient * uniform) /
                 norm;
        };
        for (std::size_t i = 0; i < problem.size; ++i)
          z[i] = gradient(i);
        mask(z);
        problem.precondition(z.data(), closed.data());
        mask(z); // so that d stays among the admissible fields
        const auto [g_z]    = weighted_sums<1>(problem, [&](const auto i, auto &sums) {
          sums[0] += closed[i] ? 0. : gradient(i) * z[i];
        });
        const double before = std::exchange(fall, g_z);
        const double beta   = before > 0 ? g_z / before : 0.;
        for (std::size_t i = 0; i < problem.size; ++i)
          d.of[i] = beta * d.of[i] - z[i];
      }
    };
  } // namespace

  double
  GapOptimiser::smallest_curvature(std::vector<double> &direction) const
  {
    // A rank without points has none in either case.
    const bool is_known = maximum(problem.communicator, direction.empty() ? 0. : 1.) > 0;
    QuotientDescent descent{problem,
                            constraint.fixes_mean_gap,
                            curvature.data(),
                            std::vector<std::uint8_t>(problem.size),
                            {field(), field()},
                            {field(), field()},
                            field()};
    for (std::size_t i = 0; i < problem.size; ++i)
      descent.closed[i] = !(gap[i] > 0);
    if (is_known)
      descent.v.of = std::move(direction);
    else
      {
        problem.fill_with_noise(descent.v.of.data());
        descent.mask(descent.v.of);
        problem.precondition(descent.v.of.data(), descent.closed.data());
      }
    const double curvature_found = descent.find_lowest();
    direction                    = std::move(descent.v.of);
    return curvature_found;
  }
} // namespace strait
