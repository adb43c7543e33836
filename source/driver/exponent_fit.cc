// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/driver/exponent_fit.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  std::vector<ExponentFit>
  local_slopes(std::vector<ScalingPoint> points)
  {
    std::sort(points.begin(),
              points.end(),
              [](const ScalingPoint &a, const ScalingPoint &b) {
                return a.reduced_load > b.reduced_load;
              });
    std::vector<ExponentFit> slopes;
    for (std::size_t k = 1; k < points.size(); ++k)
      if (points[k].reduced_load < points[k - 1].reduced_load)
        slopes.push_back(fit_exponent({points[k - 1], points[k]}, 1.));
    return slopes;
  }

  ExponentFit
  fit_exponent(const std::vector<ScalingPoint> &points, const double largest)
  {
    ExponentFit fit;
    double      sum_x = 0, sum_y = 0;
    for (const auto &[epsilon, value] : points)
      if (epsilon <= largest * (1 + 1e-9))
        {
          fit.from = fit.n_points == 0 ? epsilon : std::min(fit.from, epsilon);
          fit.to   = std::max(fit.to, epsilon);
          sum_x += std::log(epsilon);
          sum_y += std::log(value);
          ++fit.n_points;
        }
    if (fit.n_points < 2)
      return fit;
    const double mean_x = sum_x / fit.n_points, mean_y = sum_y / fit.n_points;
    double       xx = 0, xy = 0, yy = 0;
    for (const auto &[epsilon, value] : points)
      if (epsilon <= largest * (1 + 1e-9))
        {
          const double x = std::log(epsilon) - mean_x, y = std::log(value) - mean_y;
          xx += x * x;
          xy += x * y;
          yy += y * y;
        }
    fit.exponent = xy / xx;
    if (fit.n_points > 2)
      fit.error = std::sqrt(std::max(yy - xy * xy / xx, 0.) / ((fit.n_points - 2) * xx));
    return fit;
  }
} // namespace strait
