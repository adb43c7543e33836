// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_constrictions_h
#define strait_flow_constrictions_h

#include <strait/percolation/channel.h>

namespace strait
{
  class ReynoldsSolver;

  /** Where the pressure drops, along the path of least resistance. */
  struct ConstrictionReport
  {
    double points_along      = 0.; // points of its level on one length of the throat
    double fraction_at_worst = 0.; // of the pressure drop, at one constriction
    int    n_for_90_percent  = 0;  // constrictions that carry 90 % of the drop
    int    n_constrictions   = 0;
  };

  /** @p solver has solved for the flow in @p channel. Collective. */
  ConstrictionReport report_constrictions(const Channel        &channel,
                                          const ReynoldsSolver &solver);
} // namespace strait

#endif
