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
      const double      x   = (2. * static_cast<double>(k % map.nx) + 1) / map.nx - 1;
      const std::size_t row = k / map.nx;
      const double      y   = (2. * static_cast<double>(row) + 1) / map.ny - 1;
      return {{1., x, y, x * x, x * y, y * y}};
    }

    /** Gauss–Jordan of a matrix of products of terms, which needs no pivots; terms that
     *  the points do not determine are zero. */
    Terms
    solve(std::array<Terms, most_terms> a, Terms b, const int n)
    {
      std::array<bool, most_terms> is_determined{};
      for (int k = 0; k < n; ++k)
        {
          is_determined[k] = a[k][k] > 1e-12 * a[0][0];
          for (int row = 0; row < n; ++row)
            if (is_determined[k] && row != k)
              {
                const double factor = a[row][k] / a[k][k];
                for (int column = 0; column < n; ++column)
                  a[row][column] -= factor * a[k][column];
                b[row] -= factor * b[k];
              }
        }
      Terms result{};
      for (int k = 0; k < n; ++k)
        if (is_determined[k])
          result[k] = b[k] / a[k][k];
      return result;
    }
  } // namespace

  void
  detrend(HeightMap &map, const Detrend what)
  {
    if (what == Detrend::none)
      return;
    // The first of 1, x, y, x², xy, y².
    const int                     n_terms = what == Detrend::mean   ? 1
                                            : what == Detrend::tilt ? 3
                                                                    : most_terms;
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
