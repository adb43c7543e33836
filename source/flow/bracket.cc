// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/bracket.h>

#include <algorithm>

namespace strait
{
  Bracket
  plain_bracket(const PotentialProblem &pressure, const PotentialProblem &stream_function)
  {
    Bracket bracket;
    bracket.upper = pressure.energy();
    bracket.lower = 1. / stream_function.energy();
    bracket.contributions.reinit(
      pressure.dof_handler().get_triangulation().n_active_cells());
    std::vector<double> p, psi;
    for (std::size_t c = 0; c < pressure.cells().size(); ++c)
      {
        pressure.cell_values(c, p);
        stream_function.cell_values(c, psi);
        const bool   open            = pressure.is_active(c);
        const double pressure_energy = open ? pressure.cell_energy(c, p) : 0.;
        const double stream_energy   = stream_function.cell_energy(c, psi);
        const double mixed =
          open ? pressure.element_matrix().gradient_times_curl(p, psi) : 0.;
        const double contribution =
          pressure_energy + bracket.lower * (bracket.lower * stream_energy + 2. * mixed);
        bracket.contributions(pressure.cells()[c]->active_cell_index()) =
          static_cast<float>(std::max(contribution / bracket.upper, 0.));
      }
    return bracket;
  }
} // namespace strait
