// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/bracket.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    Bracket
    bracket_of(const double pressure_energy, const double stream_energy)
    {
      Bracket bracket;
      bracket.upper = bracket.safe_upper = pressure_energy;
      bracket.lower = bracket.safe_lower = 1. / stream_energy;
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

    /** Of both problems: energies of the owned cells, of the whole, and with the finer
     *  quadrature. */
    struct CellEnergies
    {
      std::vector<double> standard, finer;
      double              total;
    };

    /** The largest energy that the quadrature leaves possible. Collective. */
    double
    safe_energy(const CellEnergies &energies, MPI_Comm communicator)
    {
      double sum = 0;
      for (std::size_t c = 0; c < energies.finer.size(); ++c)
        {
          const double change = energies.finer[c] - energies.standard[c];
          sum += change + std::abs(change);
        }
      return energies.total + dealii::Utilities::MPI::sum(sum, communicator);
    }

    void
    set_safe_bounds(Bracket            &bracket,
                    const FlowMesh     &mesh,
                    const CellEnergies &pressure,
                    const CellEnergies &stream_function)
    {
      MPI_Comm communicator = mesh.triangulation().get_communicator();
      bracket.safe_upper    = safe_energy(pressure, communicator);
      bracket.safe_lower    = 1. / safe_energy(stream_function, communicator);
      bracket.quadrature_errors.reinit(mesh.triangulation().n_active_cells());
      std::size_t c = 0;
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            double error = 0;
            for (const CellEnergies *energies : {&pressure, &stream_function})
              error +=
                std::abs(energies->finer[c] - energies->standard[c]) / energies->total;
            bracket.quadrature_errors(cell->active_cell_index()) =
              static_cast<float>(error);
            ++c;
          }
    }

    /** Of a solution as it is. */
    CellEnergies
    energies_of(const PotentialProblem &problem, const GapField &gap)
    {
      return {problem.cell_energies(), problem.finer_energies(gap), problem.energy()};
    }
  } // namespace

  Bracket
  plain_bracket(const FlowMesh         &mesh,
                const PotentialProblem &pressure,
                const PotentialProblem &stream_function)
  {
    Bracket bracket = bracket_of(pressure.energy(), stream_function.energy());
    bracket.contributions.reinit(mesh.triangulation().n_active_cells());
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
            bracket.contributions(cell->active_cell_index()) =
              contribution_of(bracket,
                              open ? pressure.cell_energy(c, p) : 0.,
                              stream_function.cell_energy(c, psi),
                              open ? pressure.element_matrix().gradient_times_curl(p, psi)
                                   : 0.);
            ++c;
          }
        ++cell_of_psi;
      }
    return bracket;
  }

  Bracket
  corrected_bracket(const FlowMesh         &mesh,
                    const GapField         &gap,
                    const PotentialProblem &pressure,
                    const PotentialProblem &stream_function,
                    HierarchicalCorrection &correction)
  {
    // Half as many steps leave a wider bracket and hence more cells, twice as many cost
    // more than the cells that they save; each costs about as much as the one before.
    constexpr unsigned int n_steps = 4;
    correction.set_up();
    const CorrectedSolution p       = correction.relax(pressure, gap, n_steps);
    const CorrectedSolution psi     = correction.relax(stream_function, gap, n_steps);
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
    if (!gap.is_rigorous())
      set_safe_bounds(bracket,
                      mesh,
                      CellEnergies{p.cell_energies,
                                   correction.finer_energies(pressure, p, gap),
                                   p.energy},
                      CellEnergies{psi.cell_energies,
                                   correction.finer_energies(stream_function, psi, gap),
                                   psi.energy});
    return bracket;
  }

  void
  allow_for_quadrature(Bracket                &bracket,
                       const FlowMesh         &mesh,
                       const GapField         &gap,
                       const PotentialProblem &pressure,
                       const PotentialProblem &stream_function)
  {
    if (!gap.is_rigorous())
      set_safe_bounds(bracket,
                      mesh,
                      energies_of(pressure, gap),
                      energies_of(stream_function, gap));
  }
} // namespace strait
