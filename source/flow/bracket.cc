// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/bracket.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    Bracket
    bracket_of(const double pressure_energy, const double stream_energy)
    {
      Bracket bracket;
      bracket.upper = pressure_energy;
      bracket.lower = 1. / stream_energy;
      return bracket;
    }

    // A cell's energies and ∫ ∇p·curl ψ, combined.
    float
    contribution_of(const Bracket &bracket,
                    const double   pressure_energy,
                    const double   stream_energy,
                    const double   mixed)
    {
      const double contribution =
        pressure_energy + bracket.lower * (bracket.lower * stream_energy + 2. * mixed);
      return static_cast<float>(std::max(contribution / bracket.upper, 0.));
    }
  } // namespace

  void
  for_each_owned_cell(const PotentialProblem                           &pressure,
                      const PotentialProblem                           &stream_function,
                      const std::function<void(const CellSolutions &)> &visit)
  {
    CellSolutions here;
    auto          cell_of_psi = stream_function.dof_handler().begin_active();
    for (const auto &cell : pressure.dof_handler().active_cell_iterators())
      {
        if (cell->is_locally_owned())
          {
            here.cell = cell;
            pressure.cell_values(cell, here.p);
            stream_function.cell_values(cell_of_psi, here.psi);
            visit(here);
            ++here.number;
          }
        ++cell_of_psi;
      }
  }

  Bracket
  plain_bracket(const FlowMesh         &mesh,
                const PotentialProblem &pressure,
                const PotentialProblem &stream_function)
  {
    Bracket bracket = bracket_of(pressure.energy(), stream_function.energy());
    bracket.contributions.reinit(mesh.triangulation().n_active_cells());
    for_each_owned_cell(pressure, stream_function, [&](const CellSolutions &here) {
      const auto &[cell, c, p, psi] = here;
      const bool open               = pressure.is_active(c);
      bracket.contributions(cell->active_cell_index()) =
        contribution_of(bracket,
                        open ? pressure.cell_energy(c, p) : 0.,
                        stream_function.cell_energy(c, psi),
                        open ? pressure.element_matrix().gradient_times_curl(p, psi)
                             : 0.);
    });
    return bracket;
  }

  Bracket
  corrected_bracket(const FlowMesh         &mesh,
                    const GapField         &gap,
                    const PotentialProblem &pressure,
                    const PotentialProblem &stream_function,
                    HierarchicalCorrection &correction)
  {
    correction.set_up();
    const CorrectedSolution p       = correction.relax(pressure, gap);
    const CorrectedSolution psi     = correction.relax(stream_function, gap);
    Bracket                 bracket = bracket_of(p.energy, psi.energy);
    bracket.contributions.reinit(mesh.triangulation().n_active_cells());
    std::size_t c = 0;
    for (const auto &cell : pressure.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const bool open = pressure.is_active(c);
          bracket.contributions(cell->active_cell_index()) =
            contribution_of(bracket,
                            p.cell_energies[c],
                            psi.cell_energies[c],
                            open
                              ? correction.gradient_times_curl(p.values[c], psi.values[c])
                              : 0.);
          ++c;
        }
    return bracket;
  }
} // namespace strait
