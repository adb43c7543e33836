// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/interface/moment_set.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace strait
{
  /**
   * Stiffness matrices of the Lagrange element FE_Q(p) on rectangles,
   *   A_ij = ∫ c ∇φ_i·∇φ_j,
   * from the moments of the coefficient c. They are exact for the quadrature that made
   * the moments; nodes are in deal.II's order.
   */
  class ElementMatrix
  {
  public:
    explicit ElementMatrix(const MomentSet &set);

    /** Compute A for a cell of size @p hx × @p hy from its @p moments. */
    void stiffness(const double               *moments,
                   double                      hx,
                   double                      hy,
                   dealii::FullMatrix<double> &matrix) const;

    /**
     * Return uᵀAu. It is formed from differences to the first value, so that a small
     * gradient on top of a large constant loses no digits.
     */
    template <class Values>
    static double
    energy(const dealii::FullMatrix<double> &matrix, const Values &u)
    {
      double sum = 0;
      for (unsigned int i = 1; i < matrix.m(); ++i)
        for (unsigned int j = 1; j < matrix.n(); ++j)
          sum += matrix(i, j) * (u[i] - u[0]) * (u[j] - u[0]);
      return sum;
    }

    /** Return ∫ ∇u·curl v with curl v = (∂v/∂y, −∂v/∂x), the same on any rectangle. */
    double gradient_times_curl(const std::vector<double> &u,
                               const std::vector<double> &v) const;

  private:
    unsigned int n;
    // The factors of the moments in A_ij for j <= i, row by row: those of ∂x∂x, to be
    // scaled by hy/hx, and those of ∂y∂y, to be scaled by hx/hy.
    dealii::FullMatrix<double> along_x, along_y;
    dealii::FullMatrix<double> curl_matrix;
  };
} // namespace strait
