// SPDX-License-Identifier: GPL-2.0-or-later
// What a leak rate costs on the uniform grids of other programs, and in this one.
//
//   benchmark_uniform_baselines [grid points = 1024] [finest cells a side = 2048]
//
// Finite volumes: five points, harmonic means of K, hypre's structured grids, PCG or
// GMRES with one PFMG cycle; relative residual 1e-10. Q1: this program's elements and
// BoomerAMG on an adaptive or uniform mesh, refined until the bracket is as narrow as
// asked. The gap is the same interpolated contact gap for all. The error is relative to
// an adaptive run to 2e-4. Run on one rank.
#include <strait/contact/contact_solver.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/channel.h>
#include <strait/surface/make_surface.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <HYPRE.h>
#include <HYPRE_struct_ls.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{
  using namespace strait;

  constexpr double pi = 3.14159265358979323846;

  /** K = g³/12 at the centres of m × m cells, from the interpolated gap. */
  std::vector<double>
  conductivities(const SlabField &gap, const int m)
  {
    const int            n = gap.grid().nx;
    const GapInterpolant interpolant{GapInterpolation::monotone_cubic, FlowDirection::x};
    std::vector<double>  result(static_cast<std::size_t>(m) * m, 0.);
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i)
        {
          const double x = (i + .5) * n / m, y = (j + .5) * n / m;
          const int    ix = static_cast<int>(x), iy = static_cast<int>(y);
          GapStencil   stencil;
          for (int b = 0; b < 4; ++b)
            for (int a = 0; a < 4; ++a)
              stencil[b][a] = gap((ix + a - 1 + n) % n, (iy + b - 1 + n) % n);
          const double s = x - ix, t = y - iy;
          double       g = 0.;
          if (GapInterpolant::may_be_open(stencil))
            CellGap(interpolant, stencil).evaluate(1, &s, &t, &g);
          result[static_cast<std::size_t>(j) * m + i] = g * g * g / 12.;
        }
    return result;
  }

  /** Five-point finite volumes on m × m cells, inlet and outlet in x, periodic in y. */
  class FiniteVolumes
  {
  public:
    FiniteVolumes(const SlabField &gap, const int m_)
      : m(m_)
      , k(conductivities(gap, m))
    {
      int lower[2] = {0, 0}, upper[2] = {m - 1, m - 1}, periodic[2] = {0, m};
      HYPRE_StructGridCreate(MPI_COMM_WORLD, 2, &grid);
      HYPRE_StructGridSetExtents(grid, lower, upper);
      HYPRE_StructGridSetPeriodic(grid, periodic);
      HYPRE_StructGridAssemble(grid);
      int offsets[5][2] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}};
      HYPRE_StructStencilCreate(2, 5, &stencil);
      for (int e = 0; e < 5; ++e)
        HYPRE_StructStencilSetElement(stencil, e, offsets[e]);
      HYPRE_StructMatrixCreate(MPI_COMM_WORLD, grid, stencil, &matrix);
      HYPRE_StructMatrixInitialize(matrix);
      for (HYPRE_StructVector *vector : {&right, &solution})
        {
          HYPRE_StructVectorCreate(MPI_COMM_WORLD, grid, vector);
          HYPRE_StructVectorInitialize(*vector);
        }
      assemble(lower, upper);
    }

    ~FiniteVolumes()
    {
      HYPRE_StructVectorDestroy(solution);
      HYPRE_StructVectorDestroy(right);
      HYPRE_StructMatrixDestroy(matrix);
      HYPRE_StructStencilDestroy(stencil);
      HYPRE_StructGridDestroy(grid);
    }

    FiniteVolumes(const FiniteVolumes &)            = delete;
    FiniteVolumes &operator=(const FiniteVolumes &) = delete;

    /** Solve for the pressure. @return the number of iterations. */
    int
    solve(const bool gmres)
    {
      HYPRE_StructSolver solver = nullptr, cycle = nullptr;
      HYPRE_StructPFMGCreate(MPI_COMM_WORLD, &cycle);
      HYPRE_StructPFMGSetMaxIter(cycle, 1);
      HYPRE_StructPFMGSetTol(cycle, 0.);
      HYPRE_StructPFMGSetZeroGuess(cycle);
      HYPRE_StructPFMGSetRelaxType(cycle, 2); // red-black Gauss–Seidel, symmetric
      int           iterations = 0;
      constexpr int most       = 500;
      const double  tolerance  = 1e-10;
      if (gmres)
        {
          HYPRE_StructGMRESCreate(MPI_COMM_WORLD, &solver);
          HYPRE_StructGMRESSetTol(solver, tolerance);
          HYPRE_StructGMRESSetMaxIter(solver, most);
          HYPRE_StructGMRESSetPrecond(solver,
                                      HYPRE_StructPFMGSolve,
                                      HYPRE_StructPFMGSetup,
                                      cycle);
          HYPRE_StructGMRESSetup(solver, matrix, right, solution);
          HYPRE_StructGMRESSolve(solver, matrix, right, solution);
          HYPRE_StructGMRESGetNumIterations(solver, &iterations);
          HYPRE_StructGMRESDestroy(solver);
        }
      else
        {
          HYPRE_StructPCGCreate(MPI_COMM_WORLD, &solver);
          HYPRE_StructPCGSetTol(solver, tolerance);
          HYPRE_StructPCGSetTwoNorm(solver, 1);
          HYPRE_StructPCGSetMaxIter(solver, most);
          HYPRE_StructPCGSetPrecond(solver,
                                    HYPRE_StructPFMGSolve,
                                    HYPRE_StructPFMGSetup,
                                    cycle);
          HYPRE_StructPCGSetup(solver, matrix, right, solution);
          HYPRE_StructPCGSolve(solver, matrix, right, solution);
          HYPRE_StructPCGGetNumIterations(solver, &iterations);
          HYPRE_StructPCGDestroy(solver);
        }
      HYPRE_StructPFMGDestroy(cycle);
      HYPRE_ClearAllErrors();
      return iterations;
    }

    /** Dissipated power for a pressure drop of 1, which is the leak rate. */
    double
    leak_rate() const
    {
      int                 lower[2] = {0, 0}, upper[2] = {m - 1, m - 1};
      std::vector<double> p(k.size());
      HYPRE_StructVectorGetBoxValues(solution, lower, upper, p.data());
      const auto at = [this](const int i, const int j) {
        return static_cast<std::size_t>((j + m) % m) * m + i;
      };
      double power = 0;
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < m; ++i)
          {
            const std::size_t here = at(i, j);
            if (i == 0)
              power += 2. * k[here] * std::pow(1. - p[here], 2);
            if (i == m - 1)
              power += 2. * k[here] * std::pow(p[here], 2);
            else
              power += mean(here, at(i + 1, j)) * std::pow(p[here] - p[at(i + 1, j)], 2);
            power += mean(here, at(i, j + 1)) * std::pow(p[here] - p[at(i, j + 1)], 2);
          }
      return power;
    }

    unsigned long long
    n_unknowns() const
    {
      unsigned long long n = 0;
      for (const double value : k)
        n += value > 0 ? 1 : 0;
      return n;
    }

  private:
    double
    mean(const std::size_t a, const std::size_t b) const
    {
      return k[a] > 0 && k[b] > 0 ? 2. * k[a] * k[b] / (k[a] + k[b]) : 0.;
    }

    void
    assemble(int *lower, int *upper)
    {
      std::vector<double> values(5 * k.size(), 0.), b(k.size(), 0.), zero(k.size(), 0.);
      const auto          at = [this](const int i, const int j) {
        return static_cast<std::size_t>((j + m) % m) * m + i;
      };
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < m; ++i)
          {
            const std::size_t here = at(i, j);
            double           *row  = values.data() + 5 * here;
            if (i > 0)
              row[1] = -mean(here, at(i - 1, j));
            if (i < m - 1)
              row[2] = -mean(here, at(i + 1, j));
            row[3] = -mean(here, at(i, j - 1));
            row[4] = -mean(here, at(i, j + 1));
            row[0] = -(row[1] + row[2] + row[3] + row[4]);
            if (i == 0 || i == m - 1)
              row[0] += 2. * k[here];
            if (i == 0)
              b[here] = 2. * k[here];
            if (!(row[0] > 0))
              row[0] = 1.;
          }
      int entries[5] = {0, 1, 2, 3, 4};
      HYPRE_StructMatrixSetBoxValues(matrix, lower, upper, 5, entries, values.data());
      HYPRE_StructMatrixAssemble(matrix);
      HYPRE_StructVectorSetBoxValues(right, lower, upper, b.data());
      HYPRE_StructVectorAssemble(right);
      HYPRE_StructVectorSetBoxValues(solution, lower, upper, zero.data());
      HYPRE_StructVectorAssemble(solution);
    }

    int                 m;
    std::vector<double> k;
    HYPRE_StructGrid    grid     = nullptr;
    HYPRE_StructStencil stencil  = nullptr;
    HYPRE_StructMatrix  matrix   = nullptr;
    HYPRE_StructVector  right    = nullptr;
    HYPRE_StructVector  solution = nullptr;
  };

  struct Cost
  {
    Leakage flow;
    double  seconds = 0.;
  };

  /** This program, from the gap to the leak rate, on an adaptive or uniform mesh. */
  Cost
  elements(const SlabField &gap, const bool uniform, const double accuracy)
  {
    const dealii::Timer timer;
    FluidParameters     fluid;
    fluid.uniform_refinement = uniform;
    fluid.target_accuracy    = accuracy;
    fluid.maximum_unknowns   = 1500000;
    const Channel channel    = make_channel(gap, 0., fluid.direction, 1);
    GapField      field(gap.layout_pointer(), fluid);
    field.update(channel.gap,
                 1e-8 * field.conductivity_of(channel.paths.front().bottleneck_gap));
    ReynoldsSolver solver(fluid, field);
    Leakage        flow = solver.run(channel);
    return {flow, timer.wall_time()};
  }

  void
  print(const std::string       &gap,
        const std::string       &method,
        const unsigned long long unknowns,
        const double             leak,
        const double             reference,
        const double             seconds,
        const std::string       &remark)
  {
    std::printf("%-20s %-22s %9llu %12.5g %10.2e %8.2f  %s\n",
                gap.c_str(),
                method.c_str(),
                unknowns,
                leak,
                std::abs(leak / reference - 1),
                seconds,
                remark.c_str());
    std::fflush(stdout);
  }

  void
  compare(const std::string &name, const SlabField &contact_gap, const int finest)
  {
    const Channel channel = make_channel(contact_gap, 0., FlowDirection::x, 0);
    if (!channel.percolates())
      return;
    const SlabField &gap       = channel.gap;
    const double     reference = elements(gap, false, 2e-4).flow.rate;
    for (const bool uniform : {false, true})
      for (const double accuracy : {1e-2, 1e-3})
        {
          const Cost cost = elements(gap, uniform, accuracy);
          print(name,
                std::string(uniform ? "uniform" : "adaptive") +
                  (accuracy == 1e-2 ? " Q1, 1 %" : " Q1, 0.1 %"),
                cost.flow.unknowns,
                cost.flow.rate,
                reference,
                cost.seconds,
                cost.flow.status);
        }
    for (int m = 128; m <= finest; m *= 2)
      for (const bool gmres : {false, true})
        {
          const dealii::Timer timer;
          FiniteVolumes       volumes(gap, m);
          const int           iterations = volumes.solve(gmres);
          print(name,
                std::string("volumes, PFMG-") + (gmres ? "GMRES" : "PCG"),
                volumes.n_unknowns(),
                volumes.leak_rate(),
                reference,
                timer.wall_time(),
                std::to_string(iterations) + " iterations");
        }
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const int                                      n = argc > 1 ? std::atoi(argv[1]) : 1024;
  const int finest                                 = argc > 2 ? std::atoi(argv[2]) : 2048;
  HYPRE_Init();
  std::printf("%-20s %-22s %9s %12s %10s %8s\n",
              "gap",
              "method",
              "unknowns",
              "leak rate",
              "error",
              "seconds");
  const auto layout = make_layout({n, n, 1., 1.}, MPI_COMM_WORLD);
  SlabField  smooth(layout);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      smooth(i, j) = 1. + .5 * std::cos(2 * pi * i / n) * std::cos(2 * pi * j / n);
  compare("smooth, open", smooth, finest);

  SurfaceParameters surface;
  surface.short_cut_off_wavelength = 8. / n;
  ContactParameters contact;
  contact.grid_points = {{n, n}};
  ContactSolver solver(contact, make_surface(surface, layout));
  for (const double pressure : {.05, .15, .218})
    {
      char name[32];
      std::snprintf(name, sizeof name, "rough, p = %g E*", pressure);
      compare(name, solver.solve(pressure).gap, finest);
    }
  return 0;
}
