// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/fixed_point.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace strait
{
  FixedPoint::FixedPoint(Product product_, const int history_, const double relaxation_)
    : product(std::move(product_))
    , history(history_)
    , relaxation(relaxation_)
    , fraction(relaxation)
  {
  }

  void
  FixedPoint::advance(double           *x,
                      const double     *image,
                      const std::size_t n,
                      const bool        combines)
  {
    // Growth of the fraction per round. A cycle through a jump, of some ten rounds, must
    // still shrink. With half of the growth, the fraction recovers later from turns on
    // the way; with double of it, cycles take twice the rounds to come to rest.
    constexpr double growth     = 1.0625;
    const bool       has_before = has_last; // always false without history
    remember(x, image, n);
    if (!combines && has_before && turns_round())
      fraction *= .5;
    else
      fraction = std::min(growth * fraction, relaxation);
    const std::vector<double> weights = combines ? best_weights() : std::vector<double>();
    for (std::size_t i = 0; i < n; ++i)
      {
        double from = x[i], change = image[i] - x[i];
        for (std::size_t k = 0; k < weights.size(); ++k)
          {
            from -= weights[k] * differences[k].x[i];
            change -= weights[k] * differences[k].residual[i];
          }
        x[i] = from + fraction * change;
      }
  }

  void
  FixedPoint::remember(const double *x, const double *image, const std::size_t n)
  {
    if (history == 0)
      return;
    std::vector<float> residual(n);
    for (std::size_t i = 0; i < n; ++i)
      residual[i] = static_cast<float>(image[i] - x[i]);
    if (has_last)
      {
        if (differences.size() == static_cast<std::size_t>(history))
          differences.erase(differences.begin());
        Difference newest = {std::vector<float>(n), std::vector<float>(n)};
        for (std::size_t i = 0; i < n; ++i)
          {
            newest.x[i]        = static_cast<float>(x[i] - last_x[i]);
            newest.residual[i] = residual[i] - last_residual[i];
          }
        differences.push_back(std::move(newest));
      }
    last_x.assign(x, x + n);
    last_residual = std::move(residual);
    has_last      = true;
  }

  std::vector<double>
  FixedPoint::best_weights() const
  {
    const std::size_t m = differences.size();
    if (m == 0)
      return {};
    dealii::LAPACKFullMatrix<double> A(m, m);
    dealii::Vector<double>           b(m), weights(m);
    for (std::size_t i = 0; i < m; ++i)
      {
        for (std::size_t j = 0; j <= i; ++j)
          A(i, j) = A(j, i) = product(differences[i].residual, differences[j].residual);
        b(i) = product(differences[i].residual, last_residual);
      }
    // Nearly parallel differences must not cancel each other with large weights.
    A.compute_inverse_svd(std::numeric_limits<float>::epsilon());
    A.vmult(weights, b);
    double along_residual = fraction * product(last_residual, last_residual);
    for (std::size_t i = 0; i < m; ++i)
      along_residual -=
        weights(i) * (product(differences[i].x, last_residual) + fraction * b(i));
    if (along_residual <= 0.)
      return {};
    return {weights.begin(), weights.end()};
  }

  bool
  FixedPoint::turns_round() const
  {
    return product(last_residual, last_residual) <
           product(last_residual, differences.back().residual);
  }

  void
  FixedPoint::jump()
  {
    const double before = fraction;
    restart();
    fraction = .5 * before;
  }

  void
  FixedPoint::restart()
  {
    differences.clear();
    move_on();
  }

  void
  FixedPoint::move_on()
  {
    fraction = relaxation;
    last_residual.clear();
    last_x.clear();
    has_last = false;
  }
} // namespace strait
