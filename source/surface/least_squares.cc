// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/map_processing.h>

#include <cmath>

namespace strait
{
  namespace
  {
    constexpr int most_terms = 6;
    using Terms              = std::array<double, most_terms>;

    /** The terms at a point, in coordinates from −1 to 1. */
    Terms
    terms_at(const HeightMap &map, const std::size_t k)
    {
      const double x = (2. * static_cast<double>(k % map.nx) + 1) / map.nx - 1;
      const double y = (2. * static_cast<double>(k / map.nx) + 1) / map.ny - 1;
      return {{1., x, y, x * x, x * y, y * y}};
    }

    /** Gauss–Jordan with pivots; terms that the points do not determine are zero. */
    Terms
    solve(std::array<Terms, most_terms> a, Terms b, const int n)
    {
      std::array<int, most_terms>  row_of{};
      std::array<bool, most_terms> used{};
      row_of.fill(-1);
      for (int column = 0; column < n; ++column)
        {
          int pivot = -1;
          for (int row = 0; row < n; ++row)
            if (!used[row] &&
                (pivot < 0 || std::abs(a[row][column]) > std::abs(a[pivot][column])))
              pivot = row;
          if (pivot < 0 || std::abs(a[pivot][column]) < 1e-12 * a[0][0])
            continue;
          used[pivot]    = true;
          row_of[column] = pivot;
          for (int row = 0; row < n; ++row)
            if (row != pivot)
              {
                const double factor = a[row][column] / a[pivot][column];
                for (int k = 0; k < n; ++k)
                  a[row][k] -= factor * a[pivot][k];
                b[row] -= factor * b[pivot];
              }
        }
      Terms result{};
      for (int column = 0; column < n; ++column)
        if (row_of[column] >= 0)
          result[column] = b[row_of[column]] / a[row_of[column]][column];
      return result;
    }
  } // namespace

  void
  subtract_polynomial(HeightMap &map, const int n_terms)
  {
    std::array<Terms, most_terms> matrix{};
    Terms                         rhs{};
    for (std::size_t k = 0; k < map.values.size(); ++k)
      if (!std::isnan(map.values[k]))
        {
          const Terms terms = terms_at(map, k);
          for (int i = 0; i < n_terms; ++i)
            {
              rhs[i] += terms[i] * map.values[k];
              for (int j = 0; j < n_terms; ++j)
                matrix[i][j] += terms[i] * terms[j];
            }
        }
    const Terms coefficients = solve(matrix, rhs, n_terms);
    for (std::size_t k = 0; k < map.values.size(); ++k)
      {
        const Terms terms = terms_at(map, k);
        for (int i = 0; i < n_terms; ++i)
          map.values[k] -= coefficients[i] * terms[i];
      }
  }
} // namespace strait
