// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/rounding.h>
#include <strait/base/text.h>
#include <strait/surface/map_processing.h>

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

    /** Minus the Laplacian at the @p points of @p map: Σ w (u − u_neighbour) over the
     *  neighbours in it, with w = 1/d² of their distance d in spacings along x. */
    Vector
    differences(const HeightMap                &map,
                const std::vector<std::size_t> &points,
                const Vector                   &u)
    {
      const std::size_t nx    = map.nx;
      const double      ratio = (*map.size)[0] * map.ny / ((*map.size)[1] * map.nx);
      Vector            result;
      result.reserve(points.size());
      for (const std::size_t k : points)
        {
          double along_x = 0., along_y = 0.;
          if (k % nx > 0)
            along_x += u[k] - u[k - 1];
          if ((k + 1) % nx > 0)
            along_x += u[k] - u[k + 1];
          if (k >= nx)
            along_y += u[k] - u[k - nx];
          if (k + nx < u.size())
            along_y += u[k] - u[k + nx];
          result.push_back(along_x + ratio * ratio * along_y);
        }
      return result;
    }

    /**
     * Replace NaN by the solution of the discrete Laplace equation, with the valid points
     * as boundary values and no flux through the edges of the map. At least one point
     * must be valid.
     */
    void
    fill_harmonically(HeightMap &map)
    {
      std::vector<std::size_t> points; // that are missing
      double                   mean = 0;
      for (std::size_t k = 0; k < map.values.size(); ++k)
        if (std::isnan(map.values[k]))
          points.push_back(k);
        else
          mean += map.values[k];
      mean /= static_cast<double>(map.values.size() - points.size());
      // Heights count from the mean, so that the tolerance is relative to the roughness.
      for (double &value : map.values)
        value = std::isnan(value) ? 0. : value - mean;

      // Conjugate gradients, to far below the digits of a measured height. Residual and
      // direction have the sign of the differences, so that steps are subtracted. The
      // direction is zero at valid points.
      Vector       residual = differences(map, points, map.values);
      Vector       direction(map.values.size(), 0.);
      double       square = dot(residual, residual), last = square;
      const double enough = rounding * rounding * square;
      for (std::size_t n = 0; n < 10 * points.size() + 100 && square > enough; ++n)
        {
          for (std::size_t i = 0; i < points.size(); ++i)
            direction[points[i]] = residual[i] + square / last * direction[points[i]];
          const Vector image     = differences(map, points, direction);
          double       curvature = 0;
          for (std::size_t i = 0; i < points.size(); ++i)
            curvature += direction[points[i]] * image[i];
          const double step = square / curvature;
          for (std::size_t i = 0; i < points.size(); ++i)
            {
              map.values[points[i]] -= step * direction[points[i]];
              residual[i] -= step * image[i];
            }
          last   = square;
          square = dot(residual, residual);
        }
      for (double &value : map.values)
        value += mean;
    }
  } // namespace

  void
  fill_missing_points(HeightMap &map, const double largest_share, Remarks &remarks)
  {
    const std::size_t n_missing = map.n_missing();
    if (n_missing == 0)
      return;
    const double share =
      static_cast<double>(n_missing) / static_cast<double>(map.values.size());
    if (share > largest_share)
      reject_height_map(
        map.file,
        format("lacks %zu of its points, a share of %.3g: fill them in, or set "
               "Surface/Largest missing share to that or more.",
               n_missing,
               share));
    fill_harmonically(map);
    remarks.notes.push_back(
      format("%zu missing points (%.3g %%) filled harmonically", n_missing, 100 * share));
  }
} // namespace strait
