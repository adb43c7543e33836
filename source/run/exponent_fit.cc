// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/scaling.h>
#include <strait/run/step.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

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

  namespace
  {
    /** The slope of y against x by least squares, and its standard error. */
    std::pair<double, double>
    fit_line(const std::vector<double> &x, const std::vector<double> &y)
    {
      const auto   n      = static_cast<double>(x.size());
      const double mean_x = std::accumulate(x.begin(), x.end(), 0.) / n;
      const double mean_y = std::accumulate(y.begin(), y.end(), 0.) / n;
      double       xx = 0, xy = 0, yy = 0;
      for (std::size_t k = 0; k < x.size(); ++k)
        {
          xx += (x[k] - mean_x) * (x[k] - mean_x);
          xy += (x[k] - mean_x) * (y[k] - mean_y);
          yy += (y[k] - mean_y) * (y[k] - mean_y);
        }
      const double left_over = std::max(yy - xy * xy / xx, 0.);
      return {xy / xx, n > 2 ? std::sqrt(left_over / ((n - 2) * xx)) : 0.};
    }
  } // namespace

  ExponentFit
  fit_exponent(const std::vector<ScalingPoint> &points, const double largest)
  {
    ExponentFit         fit;
    std::vector<double> x, y;
    for (const auto &[epsilon, value, status] : points)
      if (LoadWindow{0., largest}.contains(epsilon))
        {
          add_words(fit.status, status);
          fit.from = x.empty() ? epsilon : std::min(fit.from, epsilon);
          fit.to   = std::max(fit.to, epsilon);
          x.push_back(std::log(epsilon));
          y.push_back(std::log(value));
        }
    fit.n_points = static_cast<int>(x.size());
    if (fit.from == fit.to) // of the same load again nothing is learnt
      fit.n_points = std::min(fit.n_points, 1);
    if (fit.n_points < 2)
      return fit;
    std::tie(fit.exponent, fit.error) = fit_line(x, y);
    return fit;
  }

  double
  decay_rate(const std::vector<ScalingPoint> &points)
  {
    std::vector<double> x, y;
    for (const auto &[epsilon, value, status] : points)
      if (exponential_decay.contains(epsilon))
        {
          x.push_back(epsilon);
          y.push_back(std::log(value));
        }
    return x.size() < 2 ? std::nan("") : fit_line(x, y).first;
  }

  double
  crossover_reduced_load(const std::vector<ScalingPoint> &points)
  {
    const double rate = decay_rate(points);
    return rate >= leak_rate_exponent ? leak_rate_exponent / rate : std::nan("");
  }
} // namespace strait
