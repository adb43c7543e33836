// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/seal/fixed_point.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace strait
{
  FixedPoint::FixedPoint(MPI_Comm comm_, const int history_, const double relaxation)
    : comm(comm_)
    , history(history_)
    , share(relaxation)
  {
  }

  void
  FixedPoint::advance(double           *x,
                      const double     *image,
                      const std::size_t n,
                      const bool        combines)
  {
    // Slower than it falls: doubled, the share would stay as it is where the residual
    // turns round in every other round. With half of the growth it recovers later from
    // turns on the way, with double of it takes longer to settle in circles.
    constexpr double growth     = 1.25;
    const bool       has_before = has_last; // never without history
    remember(x, image, n);
    if (has_before && !combines)
      {
        const double now    = product(comm, last_residual, last_residual);
        const double change = product(comm, last_residual, differences.back().residual);
        damping = now < change ? .5 * damping : std::min(growth * damping, 1.);
      }
    const double              part    = combines ? share : damping * share;
    const std::vector<double> weights = combines ? best_weights() : std::vector<double>();
    const bool                leads_on = along_residual(weights) > 0.;
    for (std::size_t i = 0; i < n; ++i)
      {
        double from = x[i], change = image[i] - x[i];
        for (std::size_t k = 0; leads_on && k < weights.size(); ++k)
          {
            from -= weights[k] * differences[k].x[i];
            change -= weights[k] * differences[k].residual[i];
          }
        x[i] = from + part * change;
      }
  }

  double
  FixedPoint::along_residual(const std::vector<double> &weights) const
  {
    double result = share * product(comm, last_residual, last_residual);
    for (std::size_t k = 0; k < weights.size(); ++k)
      result -=
        weights[k] * (product(comm, differences[k].x, last_residual) +
                      share * product(comm, differences[k].residual, last_residual));
    return result;
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
    const std::size_t      m = differences.size();
    dealii::Vector<double> b(m), weights(m);
    if (m > 0)
      {
        dealii::LAPACKFullMatrix<double> A(m, m);
        for (std::size_t i = 0; i < m; ++i)
          {
            for (std::size_t j = 0; j <= i; ++j)
              A(i, j) = A(j, i) =
                product(comm, differences[i].residual, differences[j].residual);
            b(i) = product(comm, differences[i].residual, last_residual);
          }
        // Rounds that say almost the same as others must not fight each other.
        A.compute_inverse_svd(std::numeric_limits<float>::epsilon());
        A.vmult(weights, b);
      }
    return {weights.begin(), weights.end()};
  }

  void
  FixedPoint::restart(const double relaxation)
  {
    differences.clear();
    move_on(relaxation);
  }

  void
  FixedPoint::move_on(const double relaxation)
  {
    share = relaxation;
    last_residual.clear();
    last_x.clear();
    has_last = false;
    damping  = 1.;
  }
} // namespace strait
