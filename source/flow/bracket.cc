// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/bracket.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    // A cell's energies and ∫ ∇p·curl ψ, combined.
    float
    share_of(const Bracket &bracket,
             const double   pressure_energy,
             const double   stream_energy,
             const double   mixed)
    {
      const double share =
        pressure_energy + bracket.lower * (bracket.lower * stream_energy + 2. * mixed);
      return static_cast<float>(std::max(share / bracket.upper, 0.));
    }
  } // namespace

  Bracket
  plain_bracket(const FlowMesh         &mesh,
                const PotentialProblem &pressure,
                const PotentialProblem &stream_function)
  {
    Bracket bracket{1. / stream_function.energy(), pressure.energy(), {}};
    bracket.shares.reinit(mesh.triangulation().n_active_cells());
    std::vector<double> p, psi;
    std::size_t         c           = 0;
    auto                cell_of_psi = stream_function.dof_handler().begin_active();
    for (const auto &cell : pressure.dof_handler().active_cell_iterators())
      {
        if (cell->is_locally_owned())
          {
            pressure.cell_values(cell, p);
            stream_function.cell_values(cell_of_psi, psi);
            const bool open = pressure.is_active(c);
            bracket.shares(cell->active_cell_index()) =
              share_of(bracket,
                       open ? pressure.cell_energy(c, p) : 0.,
                       stream_function.cell_energy(c, psi),
                       open ? pressure.element_matrix().gradient_times_curl(p, psi) : 0.);
            ++c;
          }
        ++cell_of_psi;
      }
    return bracket;
  }

  Bracket
  enriched_bracket(const FlowMesh         &mesh,
                   const GapField         &gap,
                   const PotentialProblem &pressure,
                   const PotentialProblem &stream_function,
                   Enrichment             &enrichment)
  {
    constexpr unsigned int n_steps = 4;
    enrichment.set_up();
    const EnrichedSolution p   = enrichment.relax(pressure, gap, n_steps);
    const EnrichedSolution psi = enrichment.relax(stream_function, gap, n_steps);
    Bracket                bracket{1. / psi.energy, p.energy, {}};
    bracket.shares.reinit(mesh.triangulation().n_active_cells());
    std::size_t c = 0;
    for (const auto &cell : pressure.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const bool open = pressure.is_active(c);
          bracket.shares(cell->active_cell_index()) =
            share_of(bracket,
                     p.cell_energies[c],
                     psi.cell_energies[c],
                     open ? enrichment.gradient_times_curl(p.values[c], psi.values[c])
                          : 0.);
          ++c;
        }
    return bracket;
  }
} // namespace strait
