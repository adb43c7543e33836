// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_field_output_h
#define strait_run_field_output_h

#include <strait/base/scene.h>
#include <strait/run/step.h>

#include <string>

namespace strait
{
  /**
   * Write fields-STEP.h5 to @p directory: the datasets gap, pressure (of the
   * contact) and labels (the values of NodeState) of shape (ny, nx), row 0 at
   * y = 0, with attributes lx, ly, dx, dy and the step's load. A dataset of an
   * effect that is off is absent. Beside it fields-STEP.xmf, which tells ParaView
   * where the points are.
   *
   * With a theory there is the group gap_distribution, by itself where no gap is: the
   * edges of the bins, and the shares of the nominal area in them, persson and simulated;
   * attributes persson_contact_area and simulated_contact_area, the shares without a gap.
   * What the step does not know is absent. Collective.
   */
  void write_grid_fields(const std::string &directory, const Step &step, MPI_Comm comm);

  /**
   * Write flow-STEP.vtu and flow-STEP.pvtu to @p directory for ParaView: the
   * fluid's pressure, and per cell its mean conductivity, refinement level and
   * whether it leaks; where it does not, the pressure has no meaning.
   * Nothing where nothing percolates. flow.pvd lists them as a series, whose time is the
   * number of the step. Collective.
   */
  void write_flow_fields(const std::string &directory, const Step &step);

  /**
   * Write picture-STEP.h5 to @p directory, from which the plotting script draws
   * picture-STEP.png: the fields at grid points, thinned to at most 1024 along a
   * side. Collective.
   */
  void write_picture_data(const std::string     &directory,
                          const Step            &step,
                          const FluidParameters &fluid);
} // namespace strait

#endif
