// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_state_h
#define strait_contact_contact_state_h

#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * The solution of one contact problem, in the scene's units.
   *
   * gap is 0 exactly where pressure > 0, and >= 0 everywhere: a point is open
   * where its gap is positive. pressure is >= 0 everywhere.
   */
  struct ContactState
  {
    SlabField pressure;
    SlabField gap;
    double    nominal_pressure       = 0; // mean of pressure
    double    mean_gap               = 0; // mean of gap
    double    contact_area           = 0; // fraction of the points with pressure > 0
    double    contact_area_corrected = 0; // the same for the continuum, see ContactArea
    double    residual   = 0; // see ContactResidual, in units of the rms height
    int       iterations = 0; // on the grid itself, without coarser ones
    long      fft_pairs  = 0; // likewise
    bool      converged  = false;
  };
} // namespace strait

#endif
