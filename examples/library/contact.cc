// SPDX-License-Identifier: GPL-2.0-or-later
// Contact only: a self-affine surface, the contact area at three loads.
#include <strait/contact/contact_solver.h>
#include <strait/surface/make_surface.h>

#include <deal.II/base/mpi.h>

#include <iostream>

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  strait::SurfaceParameters surface; // as in a scene without a section Surface
  surface.short_cut_off_wavelength = 1. / 16;
  const auto layout  = strait::make_layout({128, 128, 1., 1.}, MPI_COMM_WORLD);
  const auto heights = strait::make_surface(surface, layout);

  strait::ContactSolver contact(strait::ContactParameters(), heights);
  strait::ContactState  state;
  for (const double pressure : {0.05, 0.1, 0.2})
    {
      state = contact.solve(pressure, &state); // starts from the state at the last load
      if (layout->rank() == 0)
        std::cout << "pressure " << pressure << ", contact area " << state.contact_area
                  << ", mean gap " << state.mean_gap << std::endl;
    }
  return 0;
}
