// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/circle_fit.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }
  } // namespace

  std::optional<SealMesh::Circle>
  fit_circle(const std::vector<Point<2>> &points)
  {
    constexpr double tolerance = 1e-6, straight = 1e-6;
    if (points.size() < 3)
      return {};
    // Three points far from each other: the first, the farthest from it, and the one
    // that is farthest from the line through both.
    const Point<2>    &a  = points.front();
    const Point<2>     b  = *std::max_element(points.begin(),
                                         points.end(),
                                         [&a](const Point<2> &p, const Point<2> &q) {
                                           return a.distance(p) < a.distance(q);
                                         });
    const Tensor<1, 2> ab = b - a;
    const Point<2>     c =
      *std::max_element(points.begin(),
                        points.end(),
                        [&](const Point<2> &p, const Point<2> &q) {
                          return std::abs(cross(ab, p - a)) < std::abs(cross(ab, q - a));
                        });
    const Tensor<1, 2> ac   = c - a;
    const double       area = cross(ab, ac);
    if (std::abs(area) <= straight * ab.norm_square())
      return {};
    const double       bb = ab.norm_square(), cc = ac.norm_square();
    const Tensor<1, 2> to_centre(
      {(ac[1] * bb - ab[1] * cc) / (2 * area), (ab[0] * cc - ac[0] * bb) / (2 * area)});
    const SealMesh::Circle circle{a + to_centre, to_centre.norm()};
    for (const Point<2> &p : points)
      if (std::abs(p.distance(circle.centre) - circle.radius) > tolerance * circle.radius)
        return {};
    return circle;
  }

  std::vector<Point<2>>
  divide_arc(const SealMesh::Circle &circle,
             const Point<2>         &from,
             const Point<2>         &to,
             const double            longest)
  {
    const Tensor<1, 2>    first = from - circle.centre, last = to - circle.centre;
    const double          angle  = std::atan2(cross(first, last), first * last);
    const double          length = std::abs(angle) * circle.radius;
    const int             n = std::max(1, static_cast<int>(std::ceil(length / longest)));
    std::vector<Point<2>> chain = {from};
    for (int k = 1; k < n; ++k)
      {
        const double t = angle * k / n;
        chain.push_back(circle.centre +
                        Tensor<1, 2>({std::cos(t) * first[0] - std::sin(t) * first[1],
                                      std::sin(t) * first[0] + std::cos(t) * first[1]}));
      }
    return chain;
  }
} // namespace strait
