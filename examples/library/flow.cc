// SPDX-License-Identifier: GPL-2.0-or-later
// Flow only: the bracketed leak rate through a given gap, g = 1 + cos(2πx)/2 between
// wavy plates. Exact for flow along x: g0³ (1 − ε²)^(5/2)/(1 + ε²/2)/(12 η), ε = 1/2.
#include <strait/base/timers.h>
#include <strait/run/load_sweep.h>
#include <strait/spectral/slab_field.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  strait::Scene scene; // as an empty scene file
  scene.contact.enabled       = false;
  scene.fluid.viscosity       = 1. / 12;
  scene.fluid.target_accuracy = 1e-3;

  const double pi     = std::acos(-1.);
  const auto   layout = strait::make_layout({64, 64, 1., 1.}, MPI_COMM_WORLD);
  const auto   gap    = strait::sample(layout, [pi](const double x, const double) {
    return 1 + std::cos(2 * pi * x) / 2;
  });

  strait::Log       log(MPI_COMM_WORLD, true);
  strait::Timers    timers;
  strait::LoadSweep sweep(scene, gap, log, timers);
  sweep.run([](const strait::Step &step) {
    const strait::Leakage &leakage = step.flow->leakage;
    std::cout << "leak rate " << leakage.rate << ", between " << leakage.lower << " and "
              << leakage.upper << std::endl;
    return true; // go on to the next step, if there is one
  });
  std::cout << "exact     " << std::pow(0.75, 2.5) / 1.125 << std::endl;
  return 0;
}
