// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/flow/seal_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

namespace strait
{
  namespace
  {
    std::string
    text_of(const std::string &name)
    {
      std::ifstream in(std::string(STRAIT_TEST_DATA) + "/../meshes/" + name + ".msh");
      std::ostringstream text;
      text << in.rdbuf();
      return text.str();
    }

    std::string
    replaced(std::string text, const std::string &what, const std::string &by)
    {
      const std::size_t at = text.find(what);
      EXPECT_NE(at, std::string::npos) << what;
      return text.replace(at, what.size(), by);
    }

    std::string
    message_of(const std::function<void()> &action)
    {
      try
        {
          action();
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "";
    }

    TEST(MeshFile, AStripAsGmshWritesIt)
    {
      const MeshFile file = parse_mesh_file(text_of("strip"), "strip");
      EXPECT_EQ(file.points.size(), 15U);
      EXPECT_EQ(file.quadrilaterals.size(), 8U);
      EXPECT_EQ(file.lines.size(), 12U);
      const SealMesh mesh = make_seal_mesh(file, "strip");
      EXPECT_FALSE(mesh.is_ring);
      EXPECT_TRUE(mesh.circles.empty());
      // The flow is along x, so that the right wall is the lower one.
      for (const SealMesh::Edge &edge : mesh.edges)
        {
          const double y = .5 * (mesh.points[edge.from][1] + mesh.points[edge.to][1]);
          EXPECT_EQ(edge.kind == OutlineKind::right_wall, y == .25);
          EXPECT_EQ(edge.kind == OutlineKind::left_wall, y == .75);
        }
    }

    TEST(MeshFile, ACurveMayRunTheOtherWayRoundInItsGroup)
    {
      const std::string text           = replaced(text_of("strip"),
                                        "1 0.25 0 1 0.75 0 1 1 2 2 -3",
                                        "1 0.25 0 1 0.75 0 1 -1 2 2 -3");
      const auto        n_outlet_edges = [](const std::string &of) {
        const SealMesh mesh = make_seal_mesh(parse_mesh_file(of, "strip"), "strip");
        return std::count_if(mesh.edges.begin(),
                             mesh.edges.end(),
                             [](const SealMesh::Edge &edge) {
                               return edge.kind == OutlineKind::outlet;
                             });
      };
      EXPECT_GT(n_outlet_edges(text), 0);
      EXPECT_EQ(n_outlet_edges(text), n_outlet_edges(text_of("strip")));
    }

    TEST(MeshFile, ARingAndItsCircles)
    {
      const SealMesh mesh =
        make_seal_mesh(parse_mesh_file(text_of("ring"), "ring"), "ring");
      EXPECT_TRUE(mesh.is_ring);
      EXPECT_TRUE(mesh.flows_outwards);
      EXPECT_LT(mesh.pole.distance({.5, .5}), .1);
      EXPECT_EQ(mesh.circles.size(), 8U); // four arcs of each circle
      for (const SealMesh::Circle &circle : mesh.circles)
        EXPECT_LT(circle.centre.distance({.5, .5}), 1e-9);
      double area = 0.;
      for (const OutlineEdge &e : mesh.outline(1e-3))
        area += .5 * (e.x0 * e.y1 - e.x1 * e.y0);
      EXPECT_NEAR(area / (std::acos(-1.) * (.16 - .04)), 1., 1e-5);
    }

    TEST(MeshFile, TheOtherWayRoundWallsAndSenseAreSwapped)
    {
      const std::string text = text_of("ring");
      const SealMesh    mesh = make_seal_mesh(parse_mesh_file(text, "ring"), "ring");
      MeshFile          file = parse_mesh_file(text, "ring");
      for (MeshFile::Line &line : file.lines)
        line.boundary_id = 1 - line.boundary_id;
      EXPECT_FALSE(make_seal_mesh(file, "inwards").flows_outwards);
      // The corners of a cell may be numbered clockwise.
      for (auto &corners : file.quadrilaterals)
        std::swap(corners[1], corners[3]);
      EXPECT_EQ(make_seal_mesh(file, "clockwise").cells.size(), mesh.cells.size());
    }

    TEST(MeshFile, WhatIsWrongIsSaid)
    {
      const std::string good  = text_of("strip");
      const auto        parse = [](const std::string &text) {
        return message_of([&]() { make_seal_mesh(parse_mesh_file(text, "m"), "m"); });
      };
      EXPECT_EQ(parse(good), "");
      EXPECT_NE(parse("").find("is no Gmsh file"), std::string::npos);
      EXPECT_NE(parse(replaced(good, "4.1 0 8", "4.1 1 8")).find("binary"),
                std::string::npos);
      EXPECT_NE(parse(replaced(good, "\n1 0.75 0\n0 4", "\n0 4")).find("mesh 'm'"),
                std::string::npos);
      EXPECT_NE(parse(replaced(good, "$EndNodes", "$EndNode")).find("$Nodes"),
                std::string::npos);
      EXPECT_NE(
        parse(replaced(good, "\n0 0.25 0\n0 2", "\n0 0.25 0.1\n0 2")).find("z = 0"),
        std::string::npos);
      EXPECT_NE(
        parse(replaced(good, "\n0 0.25 0\n0 2", "\n0.3 0.6 0\n0 2")).find("convex"),
        std::string::npos);
      // A file that ends early, anywhere, is refused and not misread.
      for (std::size_t n = 0; n + 20 < good.size(); n += 7)
        EXPECT_NE(parse(good.substr(0, n)), "") << n;
    }

    TEST(CircleFit, FindsCirclesAndNothingElse)
    {
      std::vector<dealii::Point<2>> points;
      for (const double t : {.3, .4, .5, .7})
        points.emplace_back(2. + 3. * std::cos(t), 1. + 3. * std::sin(t));
      const auto circle = fit_circle(points);
      ASSERT_TRUE(circle.has_value());
      EXPECT_NEAR(circle->radius, 3., 1e-9);
      EXPECT_NEAR(circle->centre[0], 2., 1e-9);
      points[1] += dealii::Point<2>(1e-3, 0.);
      EXPECT_FALSE(fit_circle(points).has_value());
      EXPECT_FALSE(fit_circle({{0., 0.}, {1., 1.}, {2., 2.}}).has_value());
      EXPECT_FALSE(fit_circle({{0., 0.}, {1., 1.}}).has_value());
    }

    /** A ring of @p n_layers layers of cells, from the radius 1 to 1 + @p width. */
    MeshFile
    ring(const unsigned int n_around, const unsigned int n_layers, const double width)
    {
      MeshFile   file;
      const auto number = [n_around](const unsigned int layer, const unsigned int k) {
        return layer * n_around + k % n_around;
      };
      for (unsigned int layer = 0; layer <= n_layers; ++layer)
        for (unsigned int k = 0; k < n_around; ++k)
          {
            const double angle = 2 * M_PI * k / n_around,
                         r     = 1. + width * layer / n_layers;
            file.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
            if (layer < n_layers)
              file.quadrilaterals.push_back({number(layer, k),
                                             number(layer + 1, k),
                                             number(layer + 1, k + 1),
                                             number(layer, k + 1)});
            if (layer == 0 || layer == n_layers)
              file.lines.push_back({{number(layer, k), number(layer, k + 1)},
                                    layer == 0 ? 1 : 2,
                                    layer == 0 ? 0 : 1});
          }
      return file;
    }

    /** A strip of 32 cells in a row and 0.2 wide that winds up, by @p rise each turn,
     * with the inlet at its inner end. */
    MeshFile
    spiral(const double turns, const double rise)
    {
      MeshFile               file;
      constexpr unsigned int n = 32;
      for (unsigned int k = 0; k <= n; ++k)
        for (const double side : {0., .2})
          {
            const double turned = turns * k / n, r = 1. + rise * turned + side;
            file.points.emplace_back(r * std::cos(2 * M_PI * turned),
                                     r * std::sin(2 * M_PI * turned));
          }
      for (unsigned int k = 0; k < 2 * n; k += 2)
        file.quadrilaterals.push_back({k, k + 1, k + 3, k + 2});
      file.lines.push_back({{0, 1}, 1, 0});
      file.lines.push_back({{2 * n, 2 * n + 1}, 2, 1});
      return file;
    }

    TEST(MeshFile, TurnsOfASpiralMustNotCrossEachOther)
    {
      for (const double rise : {.05, .1, .19})
        EXPECT_NE(message_of([&]() {
                    make_seal_mesh(spiral(1.3, rise), "s");
                  }).find("a boundary that crosses itself at the edges from ("),
                  std::string::npos)
          << rise;
      EXPECT_FALSE(make_seal_mesh(spiral(1.3, .25), "turns apart").is_ring);
      make_seal_mesh(spiral(.9, 0.), "less than a turn");
      make_seal_mesh(spiral(1., 0.), "a slit between both ends");
      make_seal_mesh(spiral(2., .2), "a slit between the turns");
    }

    // With eight cells around it the inner circle reaches 1/cos(22.5°) − 1 = 0.08 beyond
    // the straight sides between two layers of equal radius. Refined cells are thinner.
    TEST(MeshFile, SidesOnACircleMustNotCutThroughCells)
    {
      for (const double width : {.1, .15, .17, .2})
        EXPECT_NE(message_of([&]() {
                    make_seal_mesh(ring(8, 2, width), "r");
                  }).find("turns inside out, now or refined, where its side is bent"),
                  std::string::npos)
          << width;
      make_seal_mesh(ring(8, 2, .3), "wide");
      make_seal_mesh(ring(8, 1, .1), "one layer");
      make_seal_mesh(ring(64, 1, .01), "thin");
      make_seal_mesh(ring(16, 2, .1), "more cells");
    }
  } // namespace
} // namespace strait
