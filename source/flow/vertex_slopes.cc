// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/vertex_slopes.h>

#include <deal.II/dofs/dof_tools.h>

#include <cmath>
#include <vector>

namespace strait
{
  using namespace dealii;

  namespace
  {
    double
    slope_at_vertex(const PotentialProblem::Iterator &cell,
                    const unsigned int                vertex,
                    const std::vector<double>        &values)
    {
      // The two edges that meet at the vertex, which is at (vertex % 2, vertex / 2).
      const unsigned int right = vertex | 1U, left = vertex & 2U;
      const unsigned int upper = vertex | 2U, lower = vertex & 1U;
      const Tensor<1, 2> a       = cell->vertex(right) - cell->vertex(left);
      const Tensor<1, 2> b       = cell->vertex(upper) - cell->vertex(lower);
      const double       along_a = values[right] - values[left];
      const double       along_b = values[upper] - values[lower];
      // The gradient that rises by these along the edges.
      return (along_a * b - along_b * a).norm() / std::abs(a[0] * b[1] - a[1] * b[0]);
    }
  } // namespace

  PotentialProblem::Vector
  vertex_slopes(const PotentialProblem &problem)
  {
    constexpr unsigned int n_vertices = 4;
    const DoFHandler<2>   &dofs       = problem.dof_handler();
    const IndexSet        &owned      = dofs.locally_owned_dofs();
    MPI_Comm               comm       = dofs.get_communicator();
    IndexSet               relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    PotentialProblem::Vector sums, counts;
    sums.reinit(owned, relevant, comm, true);
    counts.reinit(owned, relevant, comm, true);
    std::vector<double>                  values;
    std::vector<types::global_dof_index> indices(dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          problem.cell_values(cell, values);
          cell->get_dof_indices(indices);
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              sums(indices[v]) += slope_at_vertex(cell, v, values);
              counts(indices[v]) += 1.;
            }
        }
    sums.compress(VectorOperation::add);
    counts.compress(VectorOperation::add);
    PotentialProblem::Vector result(owned, comm);
    for (const auto k : owned)
      if (counts(k) > 0)
        result(k) = sums(k) / counts(k);
    result.compress(VectorOperation::insert);
    PotentialProblem::Vector with_ghosts(owned, relevant, comm);
    with_ghosts = result;
    return with_ghosts;
  }
} // namespace strait
