// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/base/timers.h>
#include <strait/run/guards.h>
#include <strait/run/output_directory.h>
#include <strait/run/simulation.h>
#include <strait/run/theory_prediction.h>
#include <strait/run/validity.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/read_scene.h>
#include <strait/surface/self_affine_surface.h>

#include <cmath>

namespace strait
{
  namespace
  {
    TheoryPrediction
    make_theory(const Scene &scene, Log &log, MPI_Comm comm)
    {
      for (const std::string &warning : scene.warnings())
        log.warn(warning);
      for (const std::string &warning : implausible_numbers(scene))
        log.warn(warning);
      if (!scene.theory.spectrum_of_surface)
        return {scene, nullptr};
      for (const std::string &warning : check_resolution(scene.surface, grid_of(scene)))
        log.warn(warning);
      const SlabField heights =
        make_surface(scene.surface, make_layout(grid_of(scene), comm));
      return {scene, &heights};
    }

    void
    report_spectrum(const RadialSpectrum &spectrum, Log &log)
    {
      log.line(
        format("theory of the spectrum from q = %.5g to %.5g: rms height %.5g, rms "
               "slope %.5g",
               spectrum.smallest_wave_number(),
               spectrum.largest_wave_number(),
               std::sqrt(spectrum.height_square()),
               std::sqrt(spectrum.slope_square())));
    }
  } // namespace

  RunSummary
  run_theory(const Scene &scene, Log &log, MPI_Comm comm)
  {
    Timers                 timers;
    const TheoryPrediction theory = make_theory(scene, log, comm);
    report_spectrum(theory.spectrum(), log);
    OutputDirectory output(scene, comm, log);
    const auto      n_steps = static_cast<int>(scene.programme.pressures.size() *
                                          scene.fluid.slip_lengths.size());
    Step            step;
    for (const double pressure : scene.programme.pressures)
      for (const double slip_length : scene.fluid.slip_lengths)
        {
          ++step.number;
          step.state.control.slip_length = slip_length;
          {
            const auto scope = timers.scope("theory");
            step.theory      = theory.predict(pressure, slip_length, nullptr, nullptr);
          }
          judge_validity(step, scene, std::sqrt(theory.spectrum().slope_square()), log);
          report_step(step, n_steps, log);
          const auto scope = timers.scope("output");
          output.write(step, step.number == n_steps);
        }
    return output.finish({}, timers, 0.);
  }

  void
  describe_theory(const Scene &scene, Log &log)
  {
    report_spectrum(make_theory(scene, log, MPI_COMM_WORLD).spectrum(), log);
    log.line(format("theory alone, %s; contact off, fluid off; %zu steps",
                    scene.theory.spectrum_of_surface ? "for the heights on the grid"
                                                     : "without a grid",
                    scene.programme.pressures.size() * scene.fluid.slip_lengths.size()));
  }
} // namespace strait
