// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_constriction_report_h
#define strait_seal_constriction_report_h

#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/throat.h>

namespace strait
{
  /** Where the pressure drops, along the path of least resistance. */
  struct ConstrictionReport
  {
    Throat throat;                // at the bottleneck
    double points_along     = 0.; // grid points on one length of the throat
    double share_of_worst   = 0.; // of the pressure drop, at one constriction
    int    n_for_90_percent = 0;  // constrictions that carry 90 % of the drop
    int    n_constrictions  = 0;
  };

  /** @p gap is the gap that the fluid sees. Collective. */
  ConstrictionReport report_constrictions(const SlabField      &gap,
                                          const FlowPath       &path,
                                          const ReynoldsSolver &solver);
} // namespace strait

#endif
