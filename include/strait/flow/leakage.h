// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace strait
{
  struct Channel;
  class ReynoldsSolver;

  /** The leak rate of one gap, its bounds, and the effort it took to compute them. */
  struct Leakage
  {
    double rate  = 0.; // Q, the best estimate within the bounds [volume/time]
    double lower = 0.; // bounds of |Q|: from the stream function, best of all meshes …
    double upper = 0.; // … and from the pressure; for a rarefied gas see RarefiedFlow
    double mesh_lower = 0.; // the same on the last mesh alone
    double mesh_upper = 0.;

    /** K Δp/|Q| for a uniform conductivity K; of the box, its length over its width. */
    double aspect = 1.;

    /** Only for a rarefied gas that leaks: relative width of the bracket on the last mesh
     *  for the weights that were found, mean free path over gap in the throat, and which
     *  of the two lower bounds is the larger one, `any-order` or `two-gases`. */
    double      mesh_width = std::numeric_limits<double>::quiet_NaN();
    double      knudsen    = std::numeric_limits<double>::quiet_NaN();
    std::string bound      = "none";

    /** Relative error of the energies at which the linear solver stops. */
    double linear_error = 0.;

    unsigned long long cells       = 0;
    unsigned long long unknowns    = 0; // of both problems, on the last mesh
    unsigned int       refinements = 0;
    unsigned int       iterations  = 0; // of the linear solver, all meshes
    std::string        status      = "ok";
    std::string        reason; // why the target accuracy was missed

    /** Relative width of the bracket. */
    double
    relative_width() const
    {
      return upper > 0 ? (upper - lower) / upper : 0.;
    }

    /** Relative distance of the rate from the bound that is further away. */
    double
    relative_error() const
    {
      const double size = std::abs(rate);
      return size > 0 ? std::max(upper - size, size - lower) / size : 0.;
    }
  };

  /** Return the uniform gap that would leak as much [length]: (12 η Q · aspect/Δp)^(1/3),
   *  less for a rarefied gas. Not a number without a pressure drop. */
  double effective_gap(const Leakage &leakage, const FluidParameters &fluid);

  /** How the pressure drop is shared out along the path of least resistance. */
  struct ConstrictionReport
  {
    double points_along      = 0.; // points, of its level, on one Throat::length
    double fraction_at_worst = 0.; // largest share of the drop at one constriction
    int    n_for_90_percent  = 0;  // fewest constrictions with 90 % of the drop
    int    n_constrictions   = 0;
  };

  /** Report on the first path of @p channel, whose flow @p solver has solved for.
   *  Collective. */
  ConstrictionReport report_constrictions(const Channel        &channel,
                                          const ReynoldsSolver &solver);
} // namespace strait
