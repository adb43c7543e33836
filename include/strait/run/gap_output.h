// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_gap_output_h
#define strait_run_gap_output_h

#include <strait/run/step.h>

#include <string>

namespace strait
{
  /**
   * Add the group gap_distribution to fields-STEP.h5 in @p directory, or begin that file
   * where nothing was simulated: the edges of the bins, and the shares of the nominal
   * area in them, persson and simulated; attributes persson_contact_area and
   * simulated_contact_area, the shares without a gap. What the step does not know is
   * absent. Nothing without a theory. Collective.
   */
  void
  write_gap_distributions(const std::string &directory, const Step &step, MPI_Comm comm);
} // namespace strait

#endif
