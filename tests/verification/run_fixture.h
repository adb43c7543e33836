// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/run/load_sweep.h>
#include <strait/run/simulation.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/read_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace strait
{
  constexpr double pi = 3.14159265358979323846;

  /** What the tests read from a step. */
  struct Row
  {
    double pressure, contact_area, mean_gap, worst_gap, leak_rate, lower, upper;
    double slip_length, reduced_load;
    Throat throat;

    double      error, points; // relative, of the leak rate; along the throat
    std::string status;
  };

  struct Sweep
  {
    std::vector<Transition> thresholds;
    std::vector<Row>        rows;
  };

  inline SlabField
  heights_of(const Scene &scene, const MPI_Comm comm = MPI_COMM_WORLD)
  {
    return make_surface(scene.surface, make_layout(grid_of(scene), comm));
  }

  /** The sweep of @p scene, which must outlive it, without output. */
  struct SilentSweep
  {
    explicit SilentSweep(const Scene &scene, const MPI_Comm comm = MPI_COMM_WORLD)
      : log(comm, true)
      , loads(scene, heights_of(scene, comm), log, timers)
    {
    }

    Log       log;
    Timers    timers;
    LoadSweep loads;
  };

  inline Sweep
  run_sweep(const Scene &scene, const MPI_Comm comm = MPI_COMM_WORLD)
  {
    SilentSweep silent(scene, comm);
    Sweep       result;
    if (scene.programme.find_threshold)
      result.thresholds = silent.loads.find_thresholds();
    EXPECT_TRUE(silent.loads.run([&result](const Step &step) {
      const Leakage &flow = step.flow->leakage;
      result.rows.push_back({step.state.contact->nominal_pressure,
                             step.state.contact->contact_area_corrected,
                             step.state.mean_gap,
                             step.flow->channel.paths.empty()
                               ? 0.
                               : step.flow->channel.paths[0].bottleneck_gap,
                             flow.rate,
                             flow.lower,
                             flow.upper,
                             step.state.control.slip_length,
                             step.reduced_load.value_or(0.),
                             step.flow->channel.throat,
                             step.errors.sum(),
                             step.flow->channel.throat.points,
                             step.status()});
    }));
    return result;
  }

  inline std::vector<Row>
  sweep(const Scene &scene)
  {
    return run_sweep(scene).rows;
  }

  inline Scene
  saddle_scene(const int n = 512)
  {
    Scene scene;
    scene.surface.kind          = SurfaceKind::square_saddle;
    scene.contact.grid_points   = {{n, n}};
    scene.fluid.viscosity       = 1. / 12;
    scene.fluid.target_accuracy = 1e-3;
    scene.programme.pressures   = {.18 * 2 * pi, .20 * 2 * pi, .22 * 2 * pi};
    return scene;
  }
} // namespace strait
