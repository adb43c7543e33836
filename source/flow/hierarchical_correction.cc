// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/element_matrix.h>
#include <strait/flow/hierarchical_correction.h>

#include <deal.II/lac/diagonal_matrix.h>

#include <algorithm>
#include <array>
#include <set>

namespace strait
{
  using namespace dealii;

  namespace
  {
    // The nodes of a cell in the order of FE_Q(2): vertices, edge midpoints, centre.
    constexpr unsigned int n_vertices = 4, n_rim = 8, centre = 8;

    using Nodes = std::array<double, n_rim + 1>;

    /**
     * The equations of the freed nodes, kept cell by cell: of the nine nodes of a cell
     * the centre is eliminated; the others, its rim, depend on at most a few freed nodes.
     */
    class RimSystems
    {
    public:
      using Vector = LinearAlgebra::distributed::Vector<double>;

      explicit RimSystems(const FreedNodes &nodes_)
        : nodes(nodes_)
      {
      }

      /**
       * Append the next cell, and add its contributions to the residual @p r and the
       * diagonal @p d. @p base has the values before correction. A closed cell
       * contributes nothing. Nodes of the rim that are @p fixed keep their values.
       * @return the energy of the cell with these values and the best one at the centre
       */
      double
      append(const FullMatrix<double>      &matrix,
             const Nodes                   &base,
             const bool                     closed,
             const std::array<bool, n_rim> &fixed,
             Vector                        &r,
             Vector                        &d)
      {
        const FreedNodes::Begin begin   = nodes.begins[n_cells++];
        const FreedNodes::Begin end     = nodes.begins[n_cells];
        const unsigned int     *indices = nodes.indices.data() + begin.index;
        const std::size_t       m       = end.index - begin.index;
        matrices.resize(matrices.size() + m * m);
        double *entries = matrices.data() + matrices.size() - m * m;
        if (closed)
          return 0.;
        // Eliminate the centre: residual of the rim with the centre at its optimum.
        double rim[n_rim][n_rim], residual[n_rim];
        double at_centre = 0;
        for (unsigned int j = 0; j < base.size(); ++j)
          at_centre -= matrix(centre, j) * base[j];
        for (unsigned int i = 0; i < n_rim; ++i)
          {
            const double ratio = matrix(i, centre) / matrix(centre, centre);
            residual[i]        = -ratio * at_centre;
            for (unsigned int j = 0; j < base.size(); ++j)
              residual[i] -= matrix(i, j) * base[j];
            for (unsigned int j = 0; j < n_rim; ++j)
              rim[i][j] = matrix(i, j) - ratio * matrix(centre, j);
          }
        for (std::size_t k = begin.dependence; k < end.dependence; ++k)
          {
            const FreedNodes::Dependence &row = nodes.dependences[k];
            if (fixed[row.node])
              continue;
            r.local_element(indices[row.column]) += row.weight * residual[row.node];
            for (std::size_t l = begin.dependence; l < end.dependence; ++l)
              if (const FreedNodes::Dependence &other = nodes.dependences[l];
                  !fixed[other.node])
                entries[row.column * m + other.column] +=
                  row.weight * other.weight * rim[row.node][other.node];
          }
        for (std::size_t k = 0; k < m; ++k)
          d.local_element(indices[k]) += entries[k * m + k];
        return ElementMatrix::energy(matrix, base) -
               at_centre * at_centre / matrix(centre, centre);
      }

      /** Compute the product with x, whose ghost values are set meanwhile. Collective. */
      void
      vmult(Vector &image, const Vector &x) const
      {
        image = 0.;
        x.update_ghost_values();
        const double       *entry   = matrices.data();
        const unsigned int *indices = nodes.indices.data();
        for (std::size_t c = 1; c < nodes.begins.size(); ++c)
          {
            const std::size_t m = nodes.begins[c].index - nodes.begins[c - 1].index;
            for (std::size_t k = 0; k < m; ++k)
              {
                double sum = 0;
                for (std::size_t l = 0; l < m; ++l)
                  sum += *entry++ * x.local_element(indices[l]);
                image.local_element(indices[k]) += sum;
              }
            indices += m;
          }
        x.zero_out_ghost_values();
        image.compress(VectorOperation::add);
      }

    private:
      const FreedNodes   &nodes;
      std::size_t         n_cells = 0; // appended so far
      std::vector<double> matrices;    // cell after cell, row by row
    };

    /** Nodal values of the bilinear function with these vertex values, less the first. */
    Nodes
    interpolate(const std::vector<double> &vertices)
    {
      const double a = vertices[1] - vertices[0], b = vertices[2] - vertices[0],
                   c = vertices[3] - vertices[0];
      return {
        {0., a, b, c, .5 * b, .5 * (a + c), .5 * a, .5 * (b + c), .25 * (a + b + c)}};
    }
  } // namespace

  HierarchicalCorrection::HierarchicalCorrection(const FlowMesh &mesh_)
    : mesh(mesh_)
    , fe(2)
  {
    DoFHandler<2> dofs(mesh.triangulation());
    dofs.distribute_dofs(fe);
    AffineConstraints<double> constraints = mesh.continuity(dofs);
    // The vertices of the mesh keep their values. A hanging vertex is the new node of the
    // coarser edge and follows that, or the node follows the vertex, as may be the case
    // across the seam of a periodic mesh on several ranks.
    std::vector<types::global_dof_index> local(fe.n_dofs_per_cell());
    std::set<types::global_dof_index>    followed;
    for (const auto &cell : dofs.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(local);
          for (unsigned int node = n_vertices; node < n_rim; ++node)
            if (const auto *line = constraints.get_constraint_entries(local[node]);
                line != nullptr && line->size() == 1)
              followed.insert(line->front().first);
        }
    for (const auto &cell : dofs.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(local);
          for (unsigned int v = 0; v < n_vertices; ++v)
            if (!constraints.is_constrained(local[v]) && followed.count(local[v]) == 0)
              constraints.add_line(local[v]);
        }
    constraints.close();
    layout.reinit(dofs.locally_owned_dofs(),
                  constraints.get_local_lines(),
                  dofs.get_communicator());
    nodes.begins.emplace_back();
    const auto &partitioner = *layout.get_partitioner();
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const std::size_t first = nodes.indices.size();
          const auto        add   = [&](const unsigned int            node,
                               const types::global_dof_index dof,
                               const double                  weight) {
            const unsigned int k     = partitioner.global_to_local(dof);
            const auto         begin = nodes.indices.begin() + first;
            const auto         found = std::find(begin, nodes.indices.end(), k);
            nodes.dependences.push_back(
              {node, static_cast<unsigned int>(found - begin), weight});
            if (found == nodes.indices.end())
              nodes.indices.push_back(k);
          };
          cell->get_dof_indices(local);
          for (unsigned int node = 0; node < n_rim; ++node)
            if (!constraints.is_constrained(local[node]))
              add(node, local[node], 1.);
            else if (const auto *line = constraints.get_constraint_entries(local[node]))
              for (const auto &[dof, weight] : *line)
                add(node, dof, weight);
          nodes.begins.push_back({nodes.indices.size(), nodes.dependences.size()});
        }
  }

  double
  HierarchicalCorrection::relax(const PotentialProblem &problem,
                                const GapField         &gap) const
  {
    // Half as many steps leave a wider bracket and hence need more cells; twice as many
    // cost more than the cells that they save. All steps cost about the same.
    constexpr unsigned int n_steps = 4;
    const CellCoefficient  coefficient =
      coefficient_on_cells(mesh, 1, fe, problem.coefficient_kind(), gap);
    Vector              x(layout), r(layout), diagonal(layout);
    RimSystems          systems(nodes);
    double              energy = 0.;
    std::vector<double> vertices;
    FullMatrix<double>  matrix(n_rim + 1, n_rim + 1);
    for (std::size_t c = 0; c < problem.cells().size(); ++c)
      {
        const auto             &cell  = problem.cells()[c];
        std::array<bool, n_rim> fixed = {};
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              const bool at_reservoir = cell->face(f)->boundary_id() <= FlowMesh::outlet;
              fixed[n_vertices + f]   = problem.is_pressure()
                                          ? at_reservoir
                                          : !at_reservoir && mesh.seal() != nullptr;
            }
        const bool is_closed = !(coefficient.means[c] > 0);
        if (!is_closed)
          {
            coefficient.stiffness(c, matrix);
            matrix *= problem.coefficient_weight(c);
          }
        problem.cell_values(c, vertices);
        energy +=
          systems.append(matrix, interpolate(vertices), is_closed, fixed, r, diagonal);
      }
    r.compress(VectorOperation::add);
    diagonal.compress(VectorOperation::add);
    for (double &entry : diagonal)
      entry = entry > 0 ? 1. / entry : 0.;
    const DiagonalMatrix<Vector> inverse_diagonal(diagonal);
    const Vector                 b(r);
    solve_by_conjugate_gradients(systems, x, r, inverse_diagonal, 0., n_steps);
    // The energy falls by 2 x·b − x·Ax, with Ax = b − r.
    return Utilities::MPI::sum(energy, x.get_mpi_communicator()) - (x * b + x * r);
  }
} // namespace strait
