// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_optimisation.h>

#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** Relative change of the quotient below which an iteration counts as settled. The
     *  check takes 4 to 6 FFT pairs. Half of it costs more at each load and finds
     *  shallower directions downhill; double of it costs fewer and misses them. */
    constexpr double settled = .03;

    /** Scalar products in the numerator and the denominator of the quotient. */
    struct Products
    {
      double numerator, denominator;
    };

    /** Return the s at which the quotient of v + s d is smallest: of the two roots of a
     *  s² + b s + c = 0 the one with a plus before the square root. */
    double
    lowest_on_line(const Products &vv, const Products &vd, const Products &dd)
    {
      const double a = dd.numerator * vd.denominator - vd.numerator * dd.denominator,
                   b = dd.numerator * vv.denominator - vv.numerator * dd.denominator,
                   c = vd.numerator * vv.denominator - vv.numerator * vd.denominator;
      return -2 * c / (b + std::sqrt(std::max(0., b * b - 4 * a * c)));
    }

    /** Set @p d to the preconditioned descent direction for @p gradient, conjugate to the
     *  last d. @p fall is <gradient, z> of the last call, at first 0, and of this one on
     *  return, with z the preconditioned gradient. */
    template <class Precondition>
    void
    descend_direction(const ContactProblem      &problem,
                      const std::vector<double> &gradient,
                      const Precondition        &precondition,
                      std::vector<double>       &d,
                      double                    &fall)
    {
      std::vector<double> z = gradient;
      precondition(z);
      const auto [g_z]    = weighted_sums<1>(problem, [&](const auto i, auto &sums) {
        sums[0] += gradient[i] * z[i];
      });
      const double before = std::exchange(fall, g_z);
      const double beta   = before > 0 ? g_z / before : 0.;
      for (std::size_t i = 0; i < problem.size; ++i)
        d[i] = beta * d[i] - z[i];
    }
  } // namespace

  double
  GapOptimiser::smallest_curvature(std::vector<double> &v)
  {
    // A rank without points has none in either case.
    const bool is_known          = maximum(problem.communicator, v.empty() ? 0. : 1.) > 0;
    const auto precondition_free = [this](std::vector<double> &values) {
      project_on_free(values.data());
      precondition(values.data());
    };
    const auto products = [&](const auto &x, const auto &k_x, const auto &y) {
      const auto [elastic_part, local, mean_x, mean_y] =
        weighted_sums<4>(problem, [&](const auto i, auto &sums) {
          if (!is_free(i))
            return;
          sums[0] += k_x[i] * y[i];
          sums[1] += curvature[i] * x[i] * y[i];
          sums[2] += x[i];
          sums[3] += y[i];
        });
      return Products{elastic_part + local,
                      elastic_part + problem.mean_stiffness() * mean_x * mean_y};
    };
    if (is_known)
      project_on_free(v.data());
    else
      {
        v = field();
        problem.fill_with_noise(v.data());
        precondition_free(v);
      }
    std::vector<double> k_v = field(), d = field(), k_d = field(); // K v, d, K d
    problem.apply(v.data(), k_v.data());
    Products vv = products(v, k_v, v);
    if (!(vv.denominator > 0)) // no point is free
      {
        problem.fill_with_noise(v.data());
        return 1;
      }
    double quotient = vv.numerator / vv.denominator, fall = 0;
    for (int n_settled = 0; n_settled < 2;)
      {
        const auto [mean] =
          weighted_sums<1>(problem, [&](const auto i, auto &sums) { sums[0] += v[i]; });
        const double uniform  = problem.mean_stiffness() * mean;
        auto        &gradient = k_d; // uses its memory until K d is computed
        for (std::size_t i = 0; i < problem.size; ++i)
          gradient[i] =
            ((1 - quotient) * k_v[i] + curvature[i] * v[i] - quotient * uniform) /
            vv.denominator;
        descend_direction(problem, gradient, precondition_free, d, fall);
        problem.apply(d.data(), k_d.data());
        const Products dd = products(d, k_d, d), vd = products(v, k_v, d);
        const double   s = lowest_on_line(vv, vd, dd);
        if (!std::isfinite(s)) // no direction is left
          break;
        for (std::size_t i = 0; i < problem.size; ++i)
          {
            v[i] += s * d[i];
            k_v[i] += s * k_d[i];
          }
        vv                  = {vv.numerator + s * (2 * vd.numerator + s * dd.numerator),
                               vv.denominator + s * (2 * vd.denominator + s * dd.denominator)};
        const double before = std::exchange(quotient, vv.numerator / vv.denominator);
        n_settled = before - quotient > settled * std::abs(quotient) ? 0 : n_settled + 1;
      }
    return quotient;
  }
} // namespace strait
