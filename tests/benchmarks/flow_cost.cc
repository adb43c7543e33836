// SPDX-License-Identifier: GPL-2.0-or-later
// What a leak rate costs on adaptive and on uniform meshes.
//
//   flow_cost [grid points = 1024] [target accuracy = 0.01] [most unknowns = 6e6]
//
// The gap is that of a self-affine surface (H = 0.8, roll-off 1/2, short cut-off
// 8 grid points, rms slope 1) under loads far from and near to its threshold, and
// that of the square saddle near closing. Both kinds of mesh use the same solver.
// The error is that of the leak rate against an adaptive run to a fifth of the
// target accuracy.
#include <strait/contact/contact_solver.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/clusters.h>
#include <strait/percolation/percolating_gap.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/surface/surface.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

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
    FlowResult flow;
    double     seconds;
  };

  Cost
  run(const SlabField &gap,
      FluidParameters  fluid,
      const Refinement refinement,
      const double     accuracy)
  {
    fluid.refinement      = refinement;
    fluid.target_accuracy = accuracy;
    const dealii::Timer timer;
    const Clusters      clusters = find_clusters(gap, fluid.direction);
    const SlabField     open     = percolating_gap(gap, clusters, fluid.direction);
    const auto          paths    = find_flow_paths(open, fluid.direction, 3);
    if (paths.empty())
      return {};
    GapField field(open.layout_pointer(), fluid);
    field.update(open, 1e-8 * field.conductivity_of(paths.front().bottleneck_gap));
    ReynoldsSolver solver(fluid, field, paths);
    FlowResult     flow = solver.run();
    return {flow, timer.wall_time()};
  }

  void
  print(const Case &what, const char *mesh, const Cost &cost, const double reference)
  {
    std::printf("%-22s %-9s %9llu %10.3g %11.2e %11.2e %8.2f  %s\n",
                what.name.c_str(),
                mesh,
                cost.flow.unknowns,
                cost.flow.leak_rate,
                cost.flow.relative_width(),
                std::abs(cost.flow.leak_rate / reference - 1),
                cost.seconds,
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
  load_wisdom(MPI_COMM_WORLD);

  std::printf("%-22s %-9s %9s %10s %11s %11s %8s  %s\n",
              "gap",
              "mesh",
              "unknowns",
              "leak rate",
              "bracket",
              "error",
              "seconds",
              "status");
  for (const Case &what :
       {Case{"rough, p = 0.15 E*", rough(n), 0.15},
        Case{"rough, p = 0.21 E*", rough(n), 0.21},
        Case{"saddle, p = 0.226 p*", saddle(), 0.226 * 2 * 3.14159265358979}})
    {
      ContactParameters contact;
      contact.grid_points    = {{n, n}};
      const auto      layout = make_layout({n, n, 1., 1.}, MPI_COMM_WORLD);
      ContactSolver   solver(contact,
                           make_surface(what.surface, MPI_COMM_WORLD)->heights(layout));
      const SlabField gap = solver.solve(what.pressure).gap;

      FluidParameters fluid;
      fluid.maximum_unknowns =
        argc > 3 ? static_cast<unsigned int>(std::atof(argv[3])) : 6000000;
      const Cost   fine      = run(gap, fluid, Refinement::adaptive, accuracy / 5);
      const double reference = fine.flow.leak_rate;
      print(what, "adaptive", run(gap, fluid, Refinement::adaptive, accuracy), reference);
      print(what, "uniform", run(gap, fluid, Refinement::uniform, accuracy), reference);
    }
  save_wisdom(MPI_COMM_WORLD);
  return 0;
}
