// SPDX-License-Identifier: GPL-2.0-or-later
// What it costs to find the channel through a gap: seconds of processor time of all ranks
// together, and the most bytes, per grid point, that any rank held besides the gap.
//
//   mpirun -n RANKS benchmark_path_cost [N ..., default 1024 2048]
//
// The gap is a self-affine surface (H = 0.8, roll-off at half the box, cut-off at 16 grid
// spacings) above a plane; two fifths of the surface lie below the plane.
#include <strait/base/collective.h>
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/channel.h>
#include <strait/surface/self_affine_surface.h>

#include <deal.II/base/mpi.h>

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace
{
  using namespace strait;

  SlabField
  rough_gap(const int n)
  {
    SurfaceParameters parameters;
    parameters.short_cut_off_wavelength = 16. / n;
    SlabField gap                       = SelfAffineSurface(parameters, MPI_COMM_WORLD)
                      .heights(make_layout({n, n, 1., 1.}, MPI_COMM_WORLD));
    const double two_fifths = -.2533 * rms(gap); // quantile of a normal distribution
    for (double &value : gap)
      value -= two_fifths;
    return gap;
  }

  double
  peak_bytes()
  {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024. * static_cast<double>(usage.ru_maxrss);
  }

  /** Seconds of processor time that @p action takes on all ranks together. */
  template <class Action>
  double
  time_of(const Action &action)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    const std::clock_t start = std::clock();
    action();
    MPI_Barrier(MPI_COMM_WORLD);
    return sum(MPI_COMM_WORLD,
               static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::vector<std::string>                       sizes(argv + 1, argv + argc);
  if (sizes.empty())
    sizes = {"1024", "2048"};
  const bool on_root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  if (on_root)
    std::printf("%6s %9s %9s %9s %9s %11s %9s\n",
                "N",
                "clusters",
                "closed",
                "path",
                "six",
                "bottleneck",
                "bytes");
  for (const std::string &size : sizes)
    {
      const int             n      = std::stoi(size);
      const double          points = static_cast<double>(n) * n;
      SlabField             gap    = rough_gap(n);
      const FlowDomain      domain = FlowDirection::x;
      Clusters              clusters;
      SlabField             open;
      std::vector<FlowPath> paths;
      Bottleneck            bottleneck;
      const double          before = peak_bytes();
      const double find = time_of([&]() { clusters = find_clusters(gap, domain); });
      const double close =
        time_of([&]() { open = percolating_gap(gap, clusters, domain); });
      const double path   = time_of([&]() { paths = find_flow_paths(open, domain, 1); });
      const double six    = time_of([&]() { paths = find_flow_paths(open, domain, 6); });
      const double widest = time_of([&]() { bottleneck = find_bottleneck(gap, domain); });
      const double bytes  = maximum(MPI_COMM_WORLD, peak_bytes() - before);
      if (on_root)
        std::printf(
          "%6d %9.3f %9.3f %9.3f %9.3f %11.3f %9.1f   R = %.12g, %zu points, %.12g\n",
          n,
          find,
          close,
          path,
          six,
          widest,
          bytes / points,
          paths.empty() ? 0. : paths.front().resistance(),
          paths.empty() ? 0 : paths.front().points.size(),
          bottleneck.value);
    }
}
