// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_picture_data_h
#define strait_run_picture_data_h

#include <strait/base/fluid_parameters.h>
#include <strait/run/step.h>

#include <string>

namespace strait
{
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
