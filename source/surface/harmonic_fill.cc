// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/map_processing.h>

#include <array>
#include <cmath>
#include <numeric>

namespace strait
{
  namespace
  {
    using Vector = std::vector<double>;

    double
    dot(const Vector &a, const Vector &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }

    /** The equations of the missing points: Σ over neighbours w (u − u_neighbour) = 0
     * with w = 1/d² of their distance d. */
    struct Equations
    {
      explicit Equations(const HeightMap &map)
      {
        std::vector<long> row_of(map.values.size(), -1);
        for (std::size_t k = 0; k < map.values.size(); ++k)
          if (std::isnan(map.values[k]))
            {
              row_of[k] = static_cast<long>(points.size());
              points.push_back(k);
            }
        if (map.size) // in units of the spacing along x
          {
            const double ratio = (*map.size)[0] * map.ny / ((*map.size)[1] * map.nx);
            weights            = {{1., 1., ratio * ratio, ratio * ratio}};
          }
        for (const std::size_t k : points)
          {
            const int           ix   = static_cast<int>(k % map.nx);
            const int           iy   = static_cast<int>(k / map.nx);
            std::array<long, 4> rows = {{-1, -1, -1, -1}};
            double              n = 0, known = 0;
            const auto          visit = [&](const int side, const int jx, const int jy) {
              if (jx < 0 || jy < 0 || jx >= map.nx || jy >= map.ny)
                return;
              const std::size_t j = static_cast<std::size_t>(jy) * map.nx + jx;
              n += weights[side];
              if (row_of[j] >= 0)
                rows[side] = row_of[j];
              else
                known += weights[side] * map.values[j];
            };
            visit(0, ix - 1, iy);
            visit(1, ix + 1, iy);
            visit(2, ix, iy - 1);
            visit(3, ix, iy + 1);
            neighbours.push_back(rows);
            diagonal.push_back(n);
            rhs.push_back(known);
          }
      }

      Vector
      apply(const Vector &u) const
      {
        Vector result(u.size());
        for (std::size_t i = 0; i < u.size(); ++i)
          {
            result[i] = diagonal[i] * u[i];
            for (int side = 0; side < 4; ++side)
              if (const long row = neighbours[i][side]; row >= 0)
                result[i] -= weights[side] * u[row];
          }
        return result;
      }

      std::array<double, 4>            weights = {{1., 1., 1., 1.}};
      std::vector<std::size_t>         points;     // positions in the map
      std::vector<std::array<long, 4>> neighbours; // numbers of their equations, or −1
      Vector                           diagonal;
      Vector                           rhs;
    };

    /**
     * Replace NaN by the solution of the discrete Laplace equation with the valid points
     * as boundary values, and no flux through the edges of the map. At least one point
     * must be valid.
     */
    void
    fill_harmonically(HeightMap &map)
    {
      // Heights count from the mean, so that the tolerance is one of the roughness.
      double            mean      = 0;
      const std::size_t n_missing = map.n_missing();
      for (const double value : map.values)
        if (!std::isnan(value))
          mean += value / static_cast<double>(map.values.size() - n_missing);
      for (double &value : map.values)
        value -= mean;

      const Equations equations(map);
      // Of the residual of zero. Half of it takes less than an iteration more, and double
      // of it saves as much: either is far below the digits of a measured height.
      constexpr double tolerance = 1e-10;
      Vector           u(n_missing, 0.), residual = equations.rhs, direction(n_missing);
      const double     scale   = std::sqrt(dot(residual, residual));
      double           product = 0;
      // Conjugate gradients, preconditioned by the diagonal.
      const auto is_solved = [&]() {
        return std::sqrt(dot(residual, residual)) <= tolerance * scale;
      };
      for (std::size_t k = 0; k < 10 * n_missing + 100 && !is_solved(); ++k)
        {
          Vector z(residual);
          for (std::size_t i = 0; i < n_missing; ++i)
            z[i] /= equations.diagonal[i];
          const double next = dot(z, residual);
          for (std::size_t i = 0; i < n_missing; ++i)
            direction[i] = z[i] + (k > 0 ? next / product : 0.) * direction[i];
          product            = next;
          const Vector image = equations.apply(direction);
          const double step  = product / dot(direction, image);
          for (std::size_t i = 0; i < n_missing; ++i)
            {
              u[i] += step * direction[i];
              residual[i] -= step * image[i];
            }
        }
      for (std::size_t i = 0; i < n_missing; ++i)
        map.values[equations.points[i]] = u[i];
      for (double &value : map.values)
        value += mean;
    }
  } // namespace

  void
  fill_missing_points(HeightMap         &map,
                      const double       largest_share,
                      const std::string &file,
                      Remarks           &remarks)
  {
    const std::size_t n_missing = map.n_missing();
    if (n_missing == 0)
      return;
    const double share =
      static_cast<double>(n_missing) / static_cast<double>(map.values.size());
    if (share > largest_share)
      reject_height_map(
        file,
        format("lacks %zu of its points, a share of %.3g: fill them in, or set "
               "Surface/Largest missing share to that or more.",
               n_missing,
               share));
    fill_harmonically(map);
    remarks.notes.push_back(
      format("%zu missing points (%.3g %%) filled harmonically", n_missing, 100 * share));
  }
} // namespace strait
