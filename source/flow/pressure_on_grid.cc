// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/pressure_on_grid.h>

#include <deal.II/fe/fe_tools.h>

namespace strait
{
  GridDeposit::Sums
  pressure_on_grid(const ReynoldsSolver &solver, const SlabLayoutPtr &layout)
  {
    const PotentialProblem         &pressure = solver.pressure();
    const dealii::FiniteElement<2> &fe       = pressure.dof_handler().get_fe();
    const std::vector<unsigned int> row_by_row =
      dealii::FETools::lexicographic_to_hierarchic_numbering<2>(fe.degree);

    GridDeposit         deposit(layout, fe.degree);
    std::vector<double> values, sorted(fe.n_dofs_per_cell());
    std::size_t         owned = 0;
    for (const auto &cell : pressure.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() && pressure.is_active(owned++))
        {
          pressure.cell_values(cell, values);
          for (unsigned int i = 0; i < sorted.size(); ++i)
            sorted[i] = values[row_by_row[i]];
          deposit.add(solver.mesh().grid_cell(*cell), sorted);
        }
    return deposit.collect();
  }
} // namespace strait
