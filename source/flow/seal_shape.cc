// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/flow/seal_mesh.h>

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace strait
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Loop = std::vector<SealMesh::Edge>;

    /** Return the closed boundaries, the edges of each in their sequence. */
    std::vector<Loop>
    find_loops(std::map<unsigned int, SealMesh::Edge> left)
    {
      std::vector<Loop> loops;
      while (!left.empty())
        {
          Loop loop;
          for (auto edge = left.begin(); edge != left.end();)
            {
              loop.push_back(edge->second);
              left.erase(edge);
              edge = left.find(loop.back().to);
            }
          loops.push_back(std::move(loop));
        }
      return loops;
    }

    bool
    consists_of(const Loop &loop, const OutlineKind kind)
    {
      return std::all_of(loop.begin(), loop.end(), [kind](const SealMesh::Edge &e) {
        return e.kind == kind;
      });
    }

    double
    enclosed_area(const SealMesh &mesh, const Loop &loop)
    {
      double area = 0.;
      for (const SealMesh::Edge &e : loop)
        area += .5 * mesh.points[e.from] * dealii::cross_product_2d(mesh.points[e.to]);
      return area;
    }

    /** Walls are right of the flow after the inlet, left after the outlet.
     * @return whether it is a strip. */
    bool
    name_walls_of_strip(Loop &loop)
    {
      // Begin at the first edge of the inlet.
      const auto is_inlet = [](const SealMesh::Edge &e) {
        return e.kind == OutlineKind::inlet;
      };
      std::rotate(loop.begin(),
                  std::find_if_not(loop.begin(), loop.end(), is_inlet),
                  loop.end());
      std::rotate(loop.begin(),
                  std::find_if(loop.begin(), loop.end(), is_inlet),
                  loop.end());
      OutlineKind              last     = OutlineKind::inlet;
      std::vector<OutlineKind> sequence = {last};
      for (SealMesh::Edge &edge : loop)
        {
          if (edge.kind != OutlineKind::inlet && edge.kind != OutlineKind::outlet)
            edge.kind = last == OutlineKind::inlet || last == OutlineKind::right_wall
                          ? OutlineKind::right_wall
                          : OutlineKind::left_wall;
          if (edge.kind != last)
            sequence.push_back(edge.kind);
          last = edge.kind;
        }
      return sequence == std::vector<OutlineKind>{OutlineKind::inlet,
                                                  OutlineKind::right_wall,
                                                  OutlineKind::outlet,
                                                  OutlineKind::left_wall};
    }

    /** Return the middle of the widest stretch of the hole at half its height. */
    Point<2>
    point_in_hole(const SealMesh &mesh, const Loop &loop)
    {
      double low = mesh.points[loop.front().from][1], high = low;
      for (const SealMesh::Edge &e : loop)
        {
          low  = std::min(low, mesh.points[e.from][1]);
          high = std::max(high, mesh.points[e.from][1]);
        }
      const double        y = .5 * (low + high);
      std::vector<double> crossings;
      for (const SealMesh::Edge &e : loop)
        {
          const Point<2> &a = mesh.points[e.from], &b = mesh.points[e.to];
          if ((a[1] <= y) != (b[1] <= y))
            crossings.push_back(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
        }
      std::sort(crossings.begin(), crossings.end());
      std::size_t widest = 0;
      for (std::size_t c = 2; c + 1 < crossings.size(); c += 2)
        if (crossings[c + 1] - crossings[c] > crossings[widest + 1] - crossings[widest])
          widest = c;
      return {.5 * (crossings[widest] + crossings[widest + 1]), y};
    }

    /** @return whether it is a ring. */
    bool
    recognise_ring(SealMesh &mesh, std::vector<Loop> &loops)
    {
      if (loops.size() != 2)
        return false;
      if (enclosed_area(mesh, loops[0]) < 0)
        std::swap(loops[0], loops[1]);
      // The mesh is to the left of its edges, so that a hole is traversed clockwise.
      if (!(enclosed_area(mesh, loops[0]) > 0 && enclosed_area(mesh, loops[1]) < 0))
        return false;
      mesh.is_ring        = true;
      mesh.flows_outwards = consists_of(loops[1], OutlineKind::inlet);
      mesh.pole           = point_in_hole(mesh, loops[1]);
      return mesh.flows_outwards ? consists_of(loops[0], OutlineKind::outlet)
                                 : consists_of(loops[0], OutlineKind::inlet) &&
                                     consists_of(loops[1], OutlineKind::outlet);
    }

    /** Return points on the shorter arc of @p circle between two points on it, in steps
     * of at most @p longest; @p from is included, @p to is not. */
    std::vector<Point<2>>
    divide_arc(const SealMesh::Circle &circle,
               const Point<2>         &from,
               const Point<2>         &to,
               const double            longest)
    {
      const double r      = circle.radius;
      const double length = 2 * r * std::asin(std::min(1., from.distance(to) / (2 * r)));
      const int    n      = std::max(1, static_cast<int>(std::ceil(length / longest)));
      const dealii::SphericalManifold<2> arc(circle.centre);
      std::vector<Point<2>>              chain = {from};
      for (int k = 1; k < n; ++k)
        chain.push_back(arc.get_intermediate_point(from, to, double(k) / n));
      return chain;
    }
  } // namespace

  void
  recognise_shape(SealMesh                                     &mesh,
                  const std::map<unsigned int, SealMesh::Edge> &edges,
                  const std::string                            &name)
  {
    for (const OutlineKind kind : {OutlineKind::inlet, OutlineKind::outlet})
      if (std::none_of(edges.begin(), edges.end(), [kind](const auto &e) {
            return e.second.kind == kind;
          }))
        throw InputError("The mesh '" + name + "' has no boundary edge with the id " +
                         (kind == OutlineKind::inlet ? "0, the inlet" : "1, the outlet") +
                         "; in the .geo file of Gmsh write Physical Curve(0) = {...} and "
                         "Physical Curve(1) = {...}, without names.");
    std::vector<Loop> loops = find_loops(edges);
    if (!(loops.size() == 1 && name_walls_of_strip(loops.front())) &&
        !recognise_ring(mesh, loops))
      throw InputError(
        "The mesh '" + name +
        "' is neither a strip (one closed boundary: inlet, wall, outlet, wall) nor a ring "
        "(two closed boundaries, one the inlet and the other the outlet); of other shapes "
        "the leak rate cannot be bounded.");
    for (const Loop &loop : loops)
      mesh.edges.insert(mesh.edges.end(), loop.begin(), loop.end());
  }

  std::optional<SealMesh::Circle>
  fit_circle(const std::vector<Point<2>> &points)
  {
    if (points.size() < 3)
      return {};
    // Three points far from each other: the first, the one farthest from it, and the one
    // farthest from the line through both.
    const auto farthest = [&points](const auto &distance) {
      return *std::max_element(points.begin(),
                               points.end(),
                               [&](const Point<2> &p, const Point<2> &q) {
                                 return distance(p) < distance(q);
                               });
    };
    const Point<2>    &a  = points.front();
    const Tensor<1, 2> ab = farthest([&](const auto &p) { return a.distance(p); }) - a;
    const Tensor<1, 2> ac = farthest([&](const auto &p) {
                              return std::abs(ab * dealii::cross_product_2d(p - a));
                            }) -
                            a;
    const double area = ab * dealii::cross_product_2d(ac);
    if (std::abs(area) <= precision_of_meshes * ab.norm_square())
      return {};
    const double       bb = ab.norm_square(), cc = ac.norm_square();
    const Tensor<1, 2> to_centre(
      {(ac[1] * bb - ab[1] * cc) / (2 * area), (ab[0] * cc - ac[0] * bb) / (2 * area)});
    const SealMesh::Circle circle{a + to_centre, to_centre.norm()};
    for (const Point<2> &p : points)
      if (std::abs(p.distance(circle.centre) - circle.radius) >
          precision_of_meshes * circle.radius)
        return {};
    return circle;
  }

  std::vector<OutlineEdge>
  SealMesh::outline(const double longest) const
  {
    std::vector<OutlineEdge> result;
    for (const Edge &edge : edges)
      {
        const Point<2>       &to    = points[edge.to];
        std::vector<Point<2>> chain = {points[edge.from]};
        if (edge.circle >= 0)
          chain = divide_arc(circles[edge.circle], points[edge.from], to, longest);
        chain.push_back(to);
        for (std::size_t k = 0; k + 1 < chain.size(); ++k)
          result.push_back(
            {chain[k][0], chain[k][1], chain[k + 1][0], chain[k + 1][1], edge.kind});
      }
    return result;
  }
} // namespace strait
