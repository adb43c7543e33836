// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/gap_optimisation.h>

#include <array>
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

    using Matrix = std::array<std::array<double, 3>, 3>;
    using Vector = std::array<double, 3>;

    /** x with |x| = 1 that makes x·Ax least, by Jacobi's rotations. */
    Vector
    lowest_eigenvector(Matrix a, const int n)
    {
      Matrix v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      for (int sweep = 0; sweep < 30; ++sweep)
        for (int p = 0; p < n; ++p)
          for (int q = p + 1; q < n; ++q)
            if (a[p][q] != 0)
              {
                const double theta  = .5 * std::atan2(2 * a[p][q], a[q][q] - a[p][p]);
                const auto   rotate = [c = std::cos(theta),
                                     s = std::sin(theta)](double &x, double &y) {
                  const double old = x;
                  x                = c * old - s * y;
                  y                = s * old + c * y;
                };
                for (int k = 0; k < n; ++k)
                  {
                    rotate(a[k][p], a[k][q]);
                    rotate(v[k][p], v[k][q]);
                  }
                for (int k = 0; k < n; ++k)
                  rotate(a[p][k], a[q][k]);
              }
      int least = 0;
      for (int k = 1; k < n; ++k)
        least = a[k][k] < a[least][least] ? k : least;
      return {v[0][least], v[1][least], v[2][least]};
    }

    /** The combination of n vectors that makes the quotient of A and B least, by
     *  Gram and Schmidt in the inner product B; 0 for a vector that depends on those
     *  before it. */
    Vector
    best_combination(const Matrix &a, const Matrix &b, const int n)
    {
      std::array<Vector, 3> basis{};
      int                   n_basis = 0;
      const auto product = [n](const Matrix &m, const Vector &x, const Vector &y) {
        double result = 0;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            result += x[i] * m[i][j] * y[j];
        return result;
      };
      for (int k = 0; k < n; ++k)
        {
          Vector x{};
          x[k] = 1;
          for (int twice = 0; twice < 2; ++twice)
            for (int l = 0; l < n_basis; ++l)
              {
                const double share = product(b, basis[l], x);
                for (int i = 0; i < n; ++i)
                  x[i] -= share * basis[l][i];
              }
          const double norm = product(b, x, x);
          if (!(norm > 1e-12 * b[k][k]))
            continue;
          for (double &value : x)
            value /= std::sqrt(norm);
          basis[n_basis++] = x;
        }
      Matrix small{};
      for (int k = 0; k < n_basis; ++k)
        for (int l = 0; l < n_basis; ++l)
          small[k][l] = product(a, basis[k], basis[l]);
      const Vector y = lowest_eigenvector(small, n_basis);
      Vector       x{};
      for (int l = 0; l < n_basis; ++l)
        for (int i = 0; i < n; ++i)
          x[i] += y[l] * basis[l][i];
      return x;
    }

    /** A descent of the quotient at one gap; see GapOptimiser::smallest_curvature(). */
    struct QuotientDescent
    {
      GapProblem   &problem;
      const bool    fixes_mean_gap;
      const double *curvature; // γ''

      std::vector<std::uint8_t> closed; // marks of points that are

      // v, its gradient, its last change; K of each.
      std::array<std::vector<double>, 3> vectors;
      std::array<std::vector<double>, 3> responses = vectors;
      double                             quotient  = 0;

      void
      find_lowest()
      {
        prepare(vectors[0], responses[0]);
        descend(1);
        if (!std::isfinite(quotient)) // no point is free
          {
            problem.fill_with_noise(vectors[0].data());
            quotient = 1;
            return;
          }
        int n_settled = 0;
        for (int k = 0; n_settled < 2; ++k)
          {
            // The gradient of the quotient, preconditioned.
            const auto [mean] =
              weighted_sums<1>(problem, [this](const auto i, auto &sums) {
                sums[0] += vectors[0][i];
              });
            const double uniform = problem.mean_stiffness() * mean;
            for (std::size_t i = 0; i < problem.size; ++i)
              vectors[1][i] = (1 - quotient) * responses[0][i] +
                              curvature[i] * vectors[0][i] - quotient * uniform;
            mask(vectors[1]);
            problem.precondition(vectors[1].data(), closed.data());
            prepare(vectors[1], responses[1]);
            const double before = quotient;
            descend(k == 0 ? 2 : 3);
            n_settled =
              before - quotient > settled * std::abs(quotient) ? 0 : n_settled + 1;
          }
      }

      void
      mask(std::vector<double> &v) const
      {
        project(
          problem,
          [this](const std::size_t i) { return !closed[i]; },
          fixes_mean_gap,
          v.data());
      }

      void
      prepare(std::vector<double> &v, std::vector<double> &stiffness)
      {
        mask(v);
        problem.apply(v.data(), stiffness.data());
      }

      /** Replace v by the best combination of the first @p n vectors. */
      void
      descend(const int n)
      {
        // Of each pair of vectors <v, Kv>, <v, γ''v>; and the means.
        const auto sums = weighted_sums<15>(problem, [&](const auto i, auto &terms) {
          if (closed[i])
            return;
          int term = 0;
          for (int k = 0; k < n; ++k)
            {
              const double v = vectors[k][i];
              for (int l = 0; l <= k; ++l)
                {
                  terms[term++] += v * responses[l][i];
                  terms[term++] += v * curvature[i] * vectors[l][i];
                }
              terms[12 + k] += v;
            }
        });
        Matrix     a{}, b{};
        int        term = 0;
        for (int k = 0; k < n; ++k)
          for (int l = 0; l <= k; ++l)
            {
              const double elastic = sums[term++], local = sums[term++];
              a[k][l] = a[l][k] = elastic + local;
              b[k][l]           = b[l][k] =
                elastic + problem.mean_stiffness() * sums[12 + k] * sums[12 + l];
            }
        const Vector x = best_combination(a, b, n);
        quotient       = 0;
        for (int k = 0; k < n; ++k)
          for (int l = 0; l < n; ++l)
            quotient += x[k] * a[k][l] * x[l];
        if (x == Vector{})
          quotient = NAN;

        // The new v and its change, and K of both.
        for (std::vector<double> *fields : {vectors.data(), responses.data()})
          for (std::size_t i = 0; i < problem.size; ++i)
            {
              double change = 0;
              for (int k = 1; k < n; ++k)
                change += x[k] * fields[k][i];
              fields[2][i] = change;
              fields[0][i] = x[0] * fields[0][i] + change;
            }
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
                            {{field(), field(), field()}}};
    for (std::size_t i = 0; i < problem.size; ++i)
      descent.closed[i] = !(gap[i] > 0);
    if (is_known)
      descent.vectors[0] = std::move(direction);
    else
      {
        problem.fill_with_noise(descent.vectors[0].data());
        descent.mask(descent.vectors[0]);
        problem.precondition(descent.vectors[0].data(), descent.closed.data());
      }
    descent.find_lowest();
    direction = std::move(descent.vectors[0]);
    return descent.quotient;
  }
} // namespace strait
