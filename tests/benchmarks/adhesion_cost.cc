// SPDX-License-Identifier: GPL-2.0-or-later
// What a load step with adhesion costs: FFT pairs and processor time.
//
//   benchmark_adhesion_cost saddle|rough N TABOR [TOLERANCE, default 1e-8]
//
// saddle: the square saddle with γ0 = 0.1 E*Δ, loads 0.9 … 1.1 … 0.9 E*Δ/λ in steps of
// 0.02. rough: self-affine, H = 0.8, λs/a = 32 on 512² points, γ0 of matched_energy(),
// loads 0.05 … 0.14 … 0.05 E* in steps of 0.01. Prints the number of FFT pairs for the
// first load, their mean and largest number for the others, the mean number of iterations
// for these, and seconds of processor time for the first load and for each other one.
#include <strait/base/collective.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/surface/make_surface.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace
{
  using namespace strait;

  double
  seconds()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }

  SurfaceParameters
  surface_of(const bool is_rough)
  {
    SurfaceParameters surface;
    surface.kind = is_rough ? SurfaceKind::self_affine : SurfaceKind::square_saddle;
    if (is_rough)
      {
        surface.seed                     = 1;
        surface.hurst_exponent           = .8;
        surface.roll_off_wavelength      = .5;
        surface.short_cut_off_wavelength = .0625;
        surface.amplitudes               = Amplitudes::fixed;
      }
    return surface;
  }

  /** γ0/(E* × side of the box) that doubles the contact area of the rough surface under a
   *  load of 0.07 E* (doc/adhesion.md). */
  double
  matched_energy(const double tabor)
  {
    return tabor < .3 ? 3.82e-3 : tabor < .7 ? 2.09e-3 : tabor < 1.5 ? 1.61e-3 : 1.48e-3;
  }

  std::vector<double>
  there_and_back(const double from, const double step, const int n)
  {
    std::vector<double> loads;
    for (int k = 0; k <= 2 * n; ++k)
      loads.push_back(from + step * std::min(k, 2 * n - k));
    return loads;
  }

  void
  run(const bool is_rough, const int n, const double tabor, const double tolerance)
  {
    const SlabField heights =
      make_surface(surface_of(is_rough), make_layout({n, n, 1., 1.}, MPI_COMM_WORLD));
    ContactParameters contact;
    contact.tolerance                  = tolerance;
    contact.maximum_iterations         = 5000;
    contact.adhesion.enabled           = true;
    contact.adhesion.surface_energy    = is_rough ? matched_energy(tabor) : .1;
    contact.adhesion.tabor_number      = tabor;
    contact.adhesion.accept_unresolved = true;
    AdhesiveContactSolver     solver(contact,
                                 adhesion_of_scene(contact, heights).law,
                                 LoadPath::loading,
                                 heights);
    const std::vector<double> loads =
      is_rough ? there_and_back(.05, .01, 9) : there_and_back(.9, .02, 10);

    long         first = 0, pairs = 0, most = 0;
    int          iterations = 0;
    double       start = seconds(), first_seconds = 0;
    ContactState state;
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        state = solver.solve(loads[k], k > 0 ? &state : nullptr);
        if (!state.converged)
          std::printf("load %g: residual %g\n", loads[k], state.residual);
        if (k == 0)
          {
            first         = state.fft_pairs;
            first_seconds = seconds() - start;
            start         = seconds();
            continue;
          }
        pairs += state.fft_pairs;
        iterations += state.iterations;
        most = std::max(most, state.fft_pairs);
      }
    const double n_steps = static_cast<double>(loads.size() - 1);
    if (rank_in(MPI_COMM_WORLD) == 0)
      std::printf(
        "%-6s %5d %5.2f  first %4ld  steps %6.1f at most %4ld  iterations %5.1f  "
        "%7.3f s first %7.3f s a step\n",
        is_rough ? "rough" : "saddle",
        n,
        tabor,
        first,
        static_cast<double>(pairs) / n_steps,
        most,
        iterations / n_steps,
        first_seconds,
        (seconds() - start) / n_steps);
  }
} // namespace

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (argc > 3)
    run(std::string(argv[1]) == "rough",
        std::stoi(argv[2]),
        std::stod(argv[3]),
        argc > 4 ? std::stod(argv[4]) : 1e-8);
  MPI_Finalize();
}
