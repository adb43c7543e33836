// SPDX-License-Identifier: GPL-2.0-or-later
// Flow on seal meshes, which cover a part of the box.
#include <strait/flow/solution_on_grid.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <fstream>

#include "seal_fixture.h"

namespace strait
{
  namespace
  {
    constexpr double inner_radius = .2, outer_radius = .4; // of meshes/ring.geo

    double
    ring_conductance(const double conductivity)
    {
      return 2 * pi * conductivity / std::log(outer_radius / inner_radius);
    }

    TEST(FlowSealMesh, FilesAreReadByDealIIAsWell)
    {
      for (const std::string name : {"box", "strip", "ring", "u_gasket"})
        {
          dealii::Triangulation<2> tria;
          dealii::GridIn<2>        reader(tria);
          std::ifstream            in(mesh_path(name));
          reader.read_msh(in);
          const SealMesh mesh =
            read_seal_mesh(mesh_path(name), {64, 64, 1., 1.}, MPI_COMM_WORLD);
          EXPECT_EQ(tria.n_active_cells(), mesh.cells.size()) << name;
          unsigned int n_inlets = 0, n_outlets = 0, n_here[2] = {0, 0};
          for (const auto &face : tria.active_face_iterators())
            if (face->at_boundary())
              {
                n_inlets += face->boundary_id() == 0 ? 1 : 0;
                n_outlets += face->boundary_id() == 1 ? 1 : 0;
              }
          for (const SealMesh::Edge &edge : mesh.edges)
            {
              n_here[0] += edge.kind == OutlineKind::inlet ? 1 : 0;
              n_here[1] += edge.kind == OutlineKind::outlet ? 1 : 0;
            }
          EXPECT_EQ(n_inlets, n_here[0]) << name;
          EXPECT_EQ(n_outlets, n_here[1]) << name;
        }
    }

    // Brackets of a ring of uniform gap on meshes that are refined uniformly in turn.
    std::vector<Bracket>
    ring_brackets(const unsigned int degree, const int n_meshes)
    {
      FluidParameters fluid = plain_fluid();
      fluid.element_degree  = degree;
      const SlabField  gap  = sample([](double, double) { return 1.; }, 32, 32);
      const GapInSeal  given(gap, fluid, "ring");
      FlowMesh         mesh(given.field, fluid.direction, &given.seal);
      const MomentSet &set = given.field.moment_set();
      PotentialProblem pressure(mesh, set, GapField::Coefficient::conductivity);
      PotentialProblem stream(mesh, set, GapField::Coefficient::resistivity);

      std::vector<Bracket> brackets;
      for (int m = 0; m < n_meshes; ++m)
        {
          for (PotentialProblem *problem : {&pressure, &stream})
            {
              problem->take_coefficient(given.field);
              EXPECT_TRUE(problem->solve({fluid.preconditioner, 1e-13}).converged);
            }
          brackets.push_back(plain_bracket(pressure, stream));
          pressure.prepare_for_refinement();
          stream.prepare_for_refinement();
          mesh.triangulation().refine_global(1);
        }
      return brackets;
    }

    TEST(FlowSealMesh, RingOfUniformGapConvergesToTheLogarithmParallel)
    {
      const double exact = ring_conductance(1.);
      for (const unsigned int degree : {1U, 2U})
        {
          const std::vector<Bracket> brackets = ring_brackets(degree, 4);
          for (const Bracket &bracket : brackets)
            {
              EXPECT_GT(bracket.upper, exact);
              EXPECT_LT(bracket.lower, exact);
              // The shares of the cells sum to the width.
              const double sum =
                dealii::Utilities::MPI::sum(bracket.contributions.l1_norm(),
                                            MPI_COMM_WORLD);
              EXPECT_NEAR(sum * bracket.upper / (bracket.upper - bracket.lower),
                          1.,
                          1e-3);
            }
          const Bracket &coarse = brackets[2], &fine = brackets[3];
          const double   order_upper =
            std::log2((coarse.upper - exact) / (fine.upper - exact));
          const double order_lower =
            std::log2((exact - coarse.lower) / (exact - fine.lower));
          EXPECT_NEAR(order_upper, 2. * degree, .1 * degree) << degree;
          EXPECT_NEAR(order_lower, 2. * degree, .1 * degree) << degree;
        }
    }

    // If the background of the stream function, the angle, jumped at hanging nodes, it
    // would not conform, and the bounds and the sum of the shares would be wrong.
    TEST(FlowSealMesh, StreamFunctionOfARingIsContinuousWhereNodesHangParallel)
    {
      const double          exact = ring_conductance(1.);
      const FluidParameters fluid = plain_fluid();
      const GapInSeal       given(sample([](double, double) { return 1.; }, 32, 32),
                            fluid,
                            "ring");
      FlowMesh              mesh(given.field, fluid.direction, &given.seal);
      const MomentSet      &set = given.field.moment_set();
      PotentialProblem      pressure(mesh, set, GapField::Coefficient::conductivity);
      PotentialProblem      stream(mesh, set, GapField::Coefficient::resistivity);
      for (int m = 0; m < 3; ++m)
        {
          for (const auto &cell : mesh.triangulation().active_cell_iterators())
            if (cell->is_locally_owned() && cell->center()[0] + cell->center()[1] > 1.)
              cell->set_refine_flag();
          mesh.triangulation().execute_coarsening_and_refinement();
        }
      for (PotentialProblem *problem : {&pressure, &stream})
        {
          problem->take_coefficient(given.field);
          EXPECT_TRUE(problem->solve({fluid.preconditioner, 1e-13}).converged);
        }
      const Bracket          plain = plain_bracket(pressure, stream);
      HierarchicalCorrection correction(mesh);
      const double           upper = correction.relax(pressure, given.field);
      const double           lower = 1. / correction.relax(stream, given.field);
      const double           sum =
        dealii::Utilities::MPI::sum(plain.contributions.l1_norm(), MPI_COMM_WORLD);
      EXPECT_NEAR(sum * plain.upper / (plain.upper - plain.lower), 1., 1e-3);
      EXPECT_LT(upper, plain.upper);
      EXPECT_GT(lower, plain.lower);
      EXPECT_GT(upper, exact);
      EXPECT_LT(lower, exact);
    }

    TEST(FlowSealMesh, PlatesAreExactInStripAndBoxParallel)
    {
      const SlabField plates = sample([](double, double) { return .3; }, 64, 48);
      for (const auto &[name, aspect] :
           {std::pair<std::string, double>("strip", .5), {"box", 1.}})
        {
          const Leakage flow  = leak_in_seal(plates, plain_fluid(), name);
          const double  exact = .3 * .3 * .3 * aspect;
          EXPECT_EQ(flow.status, "ok");
          EXPECT_NEAR(flow.upper / exact, 1., 1e-9) << name;
          EXPECT_NEAR(flow.lower / exact, 1., 1e-9) << name;
        }
    }

    TEST(FlowSealMesh, SeparableGapInAStrip)
    {
      // K = A(x)³ B(y)³, so that the pressure depends on x alone.
      const double    a = .4, b = .3;
      const SlabField gap = sample(
        [=](const double x, const double y) {
          return (1 + a * std::cos(2 * pi * x)) * (1 + b * std::sin(2 * pi * y));
        },
        256,
        256);
      const Leakage flow   = leak_in_seal(gap, plain_fluid(2e-3), "strip");
      double        across = 0.; // ∫ B³ dy from 1/4 to 3/4
      constexpr int n      = 20000;
      for (int k = 0; k < n; ++k)
        across +=
          .5 / n * std::pow(1 + b * std::sin(2 * pi * (.25 + .5 * (k + .5) / n)), 3);
      const double along = (1 + a * a / 2) / std::pow(1 - a * a, 2.5); // ∫ A⁻³ dx
      const double exact = across / along, slack = 1e-4; // for the interpolation
      EXPECT_EQ(flow.status, "ok");
      EXPECT_LT(flow.lower, exact * (1 + slack));
      EXPECT_GT(flow.upper, exact * (1 - slack));
    }

    // If the gap is even in y, nothing crosses y = 0, and a wall there changes nothing.
    TEST(FlowSealMesh, WalledBoxEqualsThePeriodicOneByMirrorSymmetry)
    {
      const SlabField gap = sample(
        [](const double x, const double y) {
          return .15 + std::cos(2 * pi * (x + .13)) * std::cos(2 * pi * y) +
                 .4 * std::cos(2 * pi * (3 * x + .4)) * std::cos(4 * pi * y) +
                 .3 * std::cos(4 * pi * (x - .2));
        },
        128,
        128);
      const FluidParameters fluid    = plain_fluid(.01);
      const Leakage         periodic = leak(gap, fluid);
      const Leakage         walled   = leak_in_seal(gap, fluid, "box");
      EXPECT_EQ(periodic.status, "ok");
      EXPECT_EQ(walled.status, "ok");
      EXPECT_LT(walled.lower, periodic.upper);
      EXPECT_GT(walled.upper, periodic.lower);
      EXPECT_NEAR(walled.rate / periodic.rate, 1., .01);
    }

    /** Contact all around the ring, except for a notch at the angle 0 that is @p notch
     *  radians wide to either side. */
    SlabField
    wall_with_notch(const double notch)
    {
      return sample(
        [=](const double x, const double y) {
          const double r     = std::hypot(x - .5, y - .5);
          const double angle = std::abs(std::atan2(y - .5, x - .5));
          const double gap   = .1 + 20. * std::pow(r - .3, 2);
          return angle < notch ? gap : std::abs(r - .3) < .03 ? -.1 : gap;
        },
        128,
        128);
    }

    TEST(FlowSealMesh, PictureOfARingIsThatOfItsOwnCellsParallel)
    {
      const SlabField       gap   = sample([](double, double) { return 1.; }, 96, 96);
      const FluidParameters fluid = plain_fluid(.001);
      const GapInSeal       given(gap, fluid, "ring");
      ReynoldsSolver        solver(fluid, given.field, &given.seal);
      solver.run(given.channel);
      const PointRows    rows    = rows_of_grid(gap.grid(), 1);
      const FlowAtPoints picture = flow_at_points(solver, rows);
      int                n       = 0;
      for (int iy = 0; iy < rows.ny; ++iy)
        for (int ix = 0; ix < rows.nx; ++ix)
          {
            const double r = std::hypot(ix / 96. - .5, iy / 96. - .5);
            if (r <= inner_radius || r >= outer_radius)
              continue;
            ++n;
            const std::size_t k = static_cast<std::size_t>(iy) * rows.nx + ix;
            EXPECT_NEAR(picture.pressure[k],
                        std::log(outer_radius / r) /
                          std::log(outer_radius / inner_radius),
                        .03)
              << ix << ' ' << iy;
            EXPECT_NEAR(picture.current[k] * 2 * pi * r, 1., .1) << ix << ' ' << iy;
          }
      EXPECT_GT(n, 3000);
    }

    TEST(FlowSealMesh, VerdictAndFlowAgreeOnARingParallel)
    {
      const GapInSeal closed(wall_with_notch(0.), plain_fluid(), "ring");
      EXPECT_FALSE(closed.channel.percolates());
      EXPECT_TRUE(closed.channel.paths.empty());

      const SlabField       notched = wall_with_notch(.3);
      const FluidParameters fluid   = plain_fluid(.03);
      const GapInSeal       open(notched, fluid, "ring");
      EXPECT_TRUE(open.channel.percolates());
      EXPECT_GT(find_bottleneck(notched, open.domain).value, 0.);
      EXPECT_LT(find_bottleneck(wall_with_notch(0.), closed.domain).value, 0.);
      std::vector<Leakage> meshes;
      ReynoldsSolver       solver(fluid, open.field, &open.seal);
      const Leakage        flow =
        solver.run(open.channel, [&](const Leakage &now) { meshes.push_back(now); });
      EXPECT_EQ(flow.status, "ok");
      // No bracket contradicts the last one.
      for (const Leakage &now : meshes)
        {
          EXPECT_LE(now.mesh_lower, flow.upper * (1 + 1e-3));
          EXPECT_GE(now.mesh_upper, flow.lower * (1 - 1e-3));
        }
      // Between the notch with its narrowest gap and the whole ring with its widest.
      const double share = .3 / pi;
      EXPECT_GT(flow.rate, share * ring_conductance(1e-3));
      EXPECT_LT(flow.rate, ring_conductance(.027));
    }
  } // namespace
} // namespace strait
