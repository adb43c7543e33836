// SPDX-License-Identifier: GPL-2.0-or-later
// What a leak rate costs on adaptive and on uniform meshes.
//
//   benchmark_flow_cost [points = 1024] [target accuracy = 0.01] [most unknowns = 6e6]
//
// The gap is that of a self-affine surface (H = 0.8, roll-off 1/2, short cut-off
// 8 grid points, rms slope 1; closes at 0.2422 E* on 1024² points) at 0.9 and 0.62 of
// that load, and that of the square saddle near closing. All meshes use the same solver.
//
//   adaptive, uniform   lower and upper bound, until the bracket is as narrow as asked
//   volumes             the pressure alone, by finite volumes around the points of the
//                       contact grid with harmonic means of K between them, as in most
//                       other programs; a sparse direct factorisation, which on these
//                       gaps is several times faster than Trilinos' ML. No bracket.
//
// Errors are relative to the reference, an adaptive run to a fifth of the target
// accuracy. `seconds` count from the gap of the contact on, `solver` only meshes,
// matrices and solves: preparing the gap costs the same for all.
#include <strait/contact/contact_solver.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/channel.h>
#include <strait/surface/make_surface.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "../verification/flow_fixture.h"

namespace
{
  using namespace strait;

  struct Case
  {
    std::string       name;
    SurfaceParameters surface;
    double            pressure;
  };

  SurfaceParameters
  rough(const int n)
  {
    SurfaceParameters surface;
    surface.short_cut_off_wavelength = 8. / n;
    return surface;
  }

  SurfaceParameters
  saddle()
  {
    SurfaceParameters surface;
    surface.kind = SurfaceKind::square_saddle;
    return surface;
  }

  struct Cost
  {
    Leakage flow;
    double  seconds = 0.;
    double  solver  = 0.; // without the preparation of the gap
  };

  Cost
  bracket(const SlabField &gap,
          FluidParameters  fluid,
          const bool       uniform,
          const double     accuracy)
  {
    fluid.uniform_refinement = uniform;
    fluid.target_accuracy    = accuracy;
    Cost                cost;
    const dealii::Timer timer;
    const GivenGap      prepared(gap, fluid);
    if (!prepared.channel.percolates())
      return cost;
    const double   ready = timer.wall_time();
    ReynoldsSolver solver(fluid, prepared.field);
    cost.flow    = solver.run(prepared.channel);
    cost.seconds = timer.wall_time();
    cost.solver  = cost.seconds - ready;
    return cost;
  }

  /** Finite volumes with a five-point stencil at each point that percolates. The pressure
   *  is 1 at the inlet, x = 0, and 0 at the outlet, its periodic copy. */
  Cost
  volumes(const SlabField &gap, const FluidParameters &fluid)
  {
    using namespace dealii;
    Cost           cost;
    const Timer    timer;
    const Clusters clusters = find_clusters(gap, FlowDirection::x);
    if (!clusters.percolates)
      return cost;
    const double     ready = timer.wall_time();
    const int        nx = gap.grid().nx, ny = gap.grid().ny;
    std::vector<int> number(gap.size(), -1);
    int              n = 0;
    for (int iy = 0; iy < ny; ++iy)
      for (int ix = 1; ix < nx; ++ix)
        if (const std::size_t k = static_cast<std::size_t>(iy) * nx + ix;
            clusters.states[k] == NodeState::percolating)
          number[k] = n++;
    const auto conductivity = [&](const std::size_t k) {
      return std::pow(std::max(gap[k], 0.), 3) / (12. * fluid.viscosity);
    };
    // Call visit(point, neighbour, to_outlet, conductance) for steps to the right and up.
    const auto for_each_face = [&](const auto &visit) {
      for (int iy = 0; iy < ny; ++iy)
        for (int ix = 0; ix < nx; ++ix)
          for (const auto &[jx, jy] : {std::pair(ix + 1, iy), std::pair(ix, iy + 1)})
            {
              const std::size_t a    = static_cast<std::size_t>(iy) * nx + ix;
              const std::size_t b    = static_cast<std::size_t>(jy % ny) * nx + jx % nx;
              const double      here = conductivity(a), there = conductivity(b);
              const bool        along_reservoir = ix == 0 && jx == 0;
              if (here > 0 && there > 0 && !along_reservoir)
                visit(a, b, jx == nx, 2. * here * there / (here + there));
            }
    };
    DynamicSparsityPattern pattern(n);
    for (int i = 0; i < n; ++i)
      pattern.add(i, i);
    for_each_face([&](const std::size_t a, const std::size_t b, bool, double) {
      if (number[a] >= 0 && number[b] >= 0)
        {
          pattern.add(number[a], number[b]);
          pattern.add(number[b], number[a]);
        }
    });
    SparsityPattern compressed;
    compressed.copy_from(pattern);
    SparseMatrix<double> matrix(compressed);
    Vector<double>       load(n), pressure(n);
    for_each_face([&](const std::size_t a,
                      const std::size_t b,
                      const bool        to_outlet,
                      const double      conductance) {
      const int i = number[a], j = to_outlet ? -1 : number[b];
      if (i >= 0)
        matrix.add(i, i, conductance);
      if (j >= 0)
        matrix.add(j, j, conductance);
      if (i >= 0 && j >= 0)
        {
          matrix.add(i, j, -conductance);
          matrix.add(j, i, -conductance);
        }
      else if (j >= 0 && a % nx == 0) // from the inlet
        load(j) += conductance;
    });
    SparseDirectUMFPACK factors;
    factors.initialize(matrix);
    factors.vmult(pressure, load);
    const double total = load.l1_norm(); // inflow if the pressure inside were 0
    cost.flow.rate     = total - load * pressure;
    cost.flow.lower    = 0.;
    cost.flow.upper    = cost.flow.rate;
    cost.flow.unknowns = n;
    cost.seconds       = timer.wall_time();
    cost.solver        = cost.seconds - ready;
    return cost;
  }

  void
  print(const Case &what, const char *mesh, const Cost &cost, const double reference)
  {
    std::printf("%-22s %-9s %9llu %10.4g %11.2e %11.2e %8.2f %8.2f %3u  %s\n",
                what.name.c_str(),
                mesh,
                cost.flow.unknowns,
                cost.flow.rate,
                cost.flow.relative_width(),
                std::abs(cost.flow.rate / reference - 1),
                cost.seconds,
                cost.solver,
                cost.flow.refinements + 1,
                cost.flow.status.c_str());
    std::fflush(stdout);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const int                                      n = argc > 1 ? std::atoi(argv[1]) : 1024;
  const double accuracy                            = argc > 2 ? std::atof(argv[2]) : 0.01;

  std::printf("%-22s %-9s %9s %10s %11s %11s %8s %8s %3s  %s\n",
              "gap",
              "mesh",
              "unknowns",
              "leak rate",
              "bracket",
              "error",
              "seconds",
              "solver",
              "n",
              "status");
  for (const Case &what :
       {Case{"rough, p = 0.218 E*", rough(n), 0.9 * 0.2422},
        Case{"rough, p = 0.15 E*", rough(n), 0.15},
        Case{"saddle, p = 0.226 p*", saddle(), 0.226 * 2 * 3.14159265358979}})
    {
      ContactParameters contact;
      contact.grid_points    = {{n, n}};
      const auto      layout = make_layout({n, n, 1., 1.}, MPI_COMM_WORLD);
      ContactSolver   solver(contact, make_surface(what.surface, layout));
      const SlabField gap = solver.solve(what.pressure).gap;

      FluidParameters fluid;
      fluid.maximum_unknowns =
        argc > 3 ? static_cast<unsigned int>(std::atof(argv[3])) : 6000000;
      const Cost   fine      = bracket(gap, fluid, false, accuracy / 5);
      const double reference = fine.flow.rate;
      print(what, "reference", fine, reference);
      for (const auto &[name, uniform] :
           {std::pair("adaptive", false), std::pair("uniform", true)})
        print(what, name, bracket(gap, fluid, uniform, accuracy), reference);
      print(what, "volumes", volumes(gap, fluid), reference);
    }
  return 0;
}
