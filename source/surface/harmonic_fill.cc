// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/harmonic_fill.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <vector>

namespace strait
{
  void
  fill_harmonically(HeightMap &map)
  {
    // The missing points, and which row of the equations each has.
    std::vector<std::size_t> points;
    std::vector<int>         row_of(map.values.size(), -1);
    for (std::size_t k = 0; k < map.values.size(); ++k)
      if (std::isnan(map.values[k]))
        {
          row_of[k] = static_cast<int>(points.size());
          points.push_back(k);
        }

    // Σ over neighbours (u − u_neighbour) = 0.
    const auto                     n = static_cast<unsigned int>(points.size());
    dealii::DynamicSparsityPattern pattern(n, n);
    const auto visit_neighbours = [&map](const std::size_t k, const auto &visit) {
      const auto ix = static_cast<int>(k % map.nx), iy = static_cast<int>(k / map.nx);
      if (ix > 0)
        visit(k - 1);
      if (ix + 1 < map.nx)
        visit(k + 1);
      if (iy > 0)
        visit(k - map.nx);
      if (iy + 1 < map.ny)
        visit(k + map.nx);
    };
    for (unsigned int row = 0; row < n; ++row)
      {
        pattern.add(row, row);
        visit_neighbours(points[row], [&](const std::size_t j) {
          if (row_of[j] >= 0)
            pattern.add(row, row_of[j]);
        });
      }
    dealii::SparsityPattern sparsity;
    sparsity.copy_from(pattern);
    dealii::SparseMatrix<double> matrix(sparsity);
    dealii::Vector<double>       heights(n);
    for (unsigned int row = 0; row < n; ++row)
      visit_neighbours(points[row], [&](const std::size_t j) {
        matrix.add(row, row, 1.);
        if (row_of[j] >= 0)
          matrix.add(row, row_of[j], -1.);
        else
          heights[row] += map.values[j];
      });
    dealii::SparseDirectUMFPACK().solve(matrix, heights);
    for (unsigned int row = 0; row < n; ++row)
      map.values[points[row]] = heights[row];
  }
} // namespace strait
