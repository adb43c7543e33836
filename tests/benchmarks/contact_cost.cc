// SPDX-License-Identifier: GPL-2.0-or-later
// What a contact solve costs: FFT pairs, time in units of bare FFT pairs, memory.
//
//   benchmark_contact_cost [N[:POINTS] ..., default 512 1024]
//
// Self-affine surfaces of rms slope 1, H = 0.8, roll-off at half the box, cut-off
// at POINTS (default 8) grid spacings on N × N points; nominal pressures over E*.
// Cold starts by dual conjugate gradients and, for comparison, by the textbook method
// of Polonsky and Keer, to the same residual; the last column is the ratio of times.
#include <strait/base/collective.h>
#include <strait/contact/contact_solver.h>
#include <strait/contact/optimisers.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/surface/self_affine_surface.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "../allocated_memory.h"

namespace
{
  using namespace strait;

  double
  seconds()
  {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
  }

  SlabField
  rough_heights(const int n, const double points)
  {
    SurfaceParameters parameters;
    parameters.short_cut_off_wavelength = points / n;
    return SelfAffineSurface(parameters, MPI_COMM_WORLD)
      .heights(make_layout({n, n, 1., 1.}, MPI_COMM_WORLD));
  }

  /** Seconds for one forward and one inverse transform alone, the best of seven. */
  double
  bare_pair(const int n)
  {
    SlabField        values(make_layout({n, n, 1., 1.}, MPI_COMM_WORLD));
    FourierTransform transform(values.layout_pointer());
    double           best = 1e300;
    for (int repetition = 0; repetition < 7; ++repetition)
      {
        const double start = seconds();
        transform.multiply(values.data(), values.data(), [](int, int) { return 1.; });
        best = std::min(best, seconds() - start);
      }
    return best;
  }

  struct Cost
  {
    long   pairs   = 0;
    double seconds = 0;
  };

  Cost
  cold(const ContactMethod method,
       const SlabField    &heights,
       const double        load,
       const double        tolerance)
  {
    HalfSpaceProblem problem(heights, 1.);
    SlabField        p(heights.layout_pointer(), load), g(heights.layout_pointer());
    const double     start    = seconds();
    const auto       solution = find_pressure(
      method,
      {problem, {true, load}, {tolerance, rms(heights), 5000}, p.data(), g.data()});
    if (!solution.converged)
      std::printf("not converged: %g\n", solution.residual);
    return {problem.n_applications(), seconds() - start};
  }

  ContactParameters
  contact_parameters(const double tolerance)
  {
    ContactParameters parameters;
    parameters.tolerance = tolerance;
    return parameters;
  }

  /** The cost of a first state, which starts from coarser grids. */
  Cost
  nested(const SlabField &heights, const double load, const double tolerance)
  {
    ContactSolver      solver(contact_parameters(tolerance), heights);
    const double       start = seconds();
    const ContactState state = solver.solve(load);
    return {state.fft_pairs, seconds() - start};
  }

  /** The mean cost of three load steps of 2 %, after two other loads. */
  Cost
  continued(const SlabField &heights,
            const double     load,
            const double     tolerance,
            double          &bytes_per_point)
  {
    forget_most_allocated_memory();
    const std::size_t before = allocated_memory();
    ContactSolver     solver(contact_parameters(tolerance), heights);
    Cost              cost;
    ContactState      state;
    double            step = load;
    for (int k = 0; k < 5; ++k, step *= 1.02)
      {
        const double start = seconds();
        state              = solver.solve(step, k > 0 ? &state : nullptr);
        if (k < 2)
          continue;
        cost.pairs += state.fft_pairs;
        cost.seconds += (seconds() - start) / 3;
      }
    cost.pairs      = (cost.pairs + 1) / 3;
    bytes_per_point = static_cast<double>(most_allocated_memory() - before) /
                      static_cast<double>(heights.size());
    return cost;
  }

  void
  print_rows(const int n, const double points)
  {
    const int       rank    = rank_in(MPI_COMM_WORLD);
    const SlabField heights = rough_heights(n, points);
    const double    bare    = bare_pair(n);
    for (const double load : {0.01, 0.05, 0.1, 0.2, 0.3})
      {
        double     bytes  = 0;
        const Cost cold6  = cold(ContactMethod::dual_cg, heights, load, 1e-6);
        const Cost cold8  = cold(ContactMethod::dual_cg, heights, load, 1e-8);
        const Cost text6  = cold(ContactMethod::polonsky_keer, heights, load, 1e-6);
        const Cost text8  = cold(ContactMethod::polonsky_keer, heights, load, 1e-8);
        const Cost nest6  = nested(heights, load, 1e-6);
        const Cost nest8  = nested(heights, load, 1e-8);
        const Cost steps6 = continued(heights, load, 1e-6, bytes);
        const Cost steps8 = continued(heights, load, 1e-8, bytes);
        if (rank == 0)
          std::printf(
            "%5d %5.2f %5ld %5ld %6ld %5ld %6ld %5ld %6ld %5ld %9.3f %9.3f %7.2f %7.2f "
            "%7.1f %6.2f\n",
            n,
            load,
            text6.pairs,
            text8.pairs,
            cold6.pairs,
            cold8.pairs,
            nest6.pairs,
            nest8.pairs,
            steps6.pairs,
            steps8.pairs,
            1e3 * bare,
            nest8.seconds,
            cold8.seconds / (static_cast<double>(cold8.pairs) * bare),
            nest8.seconds / (static_cast<double>(nest8.pairs) * bare),
            bytes,
            text8.seconds / cold8.seconds);
        std::fflush(stdout);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  const int rank = rank_in(MPI_COMM_WORLD);
  if (rank == 0)
    std::printf(
      "                        FFT pairs to 1e-6, 1e-8             bare      nested    "
      "time over bare pairs       textbook\n"
      "            textbook      cold      nested     2 %% steps  pair/ms   1e-8/s   "
      " cold  nested  B/point   over cold\n");
  std::vector<std::string> cases(argv + 1, argv + argc);
  if (cases.empty())
    cases = {"512", "1024"};
  for (const std::string &text : cases)
    {
      const std::size_t colon = text.find(':');
      print_rows(std::stoi(text),
                 colon == std::string::npos ? 8. : std::stod(text.substr(colon + 1)));
    }
  MPI_Finalize();
}
