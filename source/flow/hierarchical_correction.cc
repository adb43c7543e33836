// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/hierarchical_correction.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/diagonal_matrix.h>

#include <algorithm>

namespace strait
{
  using namespace dealii;

  namespace
  {
    // The nodes of a cell in the order of FE_Q(2): vertices, middles of edges, centre.
    constexpr unsigned int n_vertices = 4, n_rim = 8, centre = 8;

    /**
     * The equations of the freed nodes, kept cell by cell: of its nine nodes the centre
     * is eliminated and the rest, the rim, depends on at most a few freed ones.
     */
    class RimSystems
    {
    public:
      using Vector = LinearAlgebra::distributed::Vector<double>;

      explicit RimSystems(const CorrectionNodes &nodes_)
        : nodes(nodes_)
      {
        first_entry.reserve(nodes.cells.size() + 1);
        first_entry.push_back(0);
      }

      /**
       * Append the next cell, and add what it contributes to the residual @p r and the
       * diagonal @p d. @p base are the values before correction; a closed cell
       * contributes nothing. The nodes of @p fixed_faces, bit f for face f, are kept.
       */
      void
      append(const FullMatrix<double>       &matrix,
             const CorrectedSolution::Nodes &base,
             const bool                      closed,
             const unsigned int              fixed_faces,
             Vector                         &r,
             Vector                         &d)
      {
        const CorrectionNodes::Cell &here = nodes.cells[first_entry.size() - 1];
        const unsigned int           m    = here.n_indices;
        first_entry.push_back(first_entry.back() + m * m);
        entries.resize(first_entry.back(), 0.);
        if (closed)
          return;
        // Eliminate the centre; residual of the rim with the centre at its optimum.
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
        const CorrectionNodes::Dependence *first =
          nodes.dependences.data() + here.first_dependence;
        double             *entry = entries.data() + first_entry[first_entry.size() - 2];
        const unsigned int *index = nodes.indices.data() + here.first_index;
        const auto          is_fixed = [&](const unsigned int node) {
          return node >= n_vertices && (fixed_faces >> (node - n_vertices) & 1U) != 0;
        };
        for (unsigned int k = 0; k < here.n_dependences; ++k)
          {
            const CorrectionNodes::Dependence &row = first[k];
            if (is_fixed(row.node))
              continue;
            r.local_element(index[row.column]) += row.weight * residual[row.node];
            for (unsigned int l = 0; l < here.n_dependences; ++l)
              if (!is_fixed(first[l].node))
                entry[row.column * m + first[l].column] +=
                  row.weight * first[l].weight * rim[row.node][first[l].node];
          }
        for (unsigned int k = 0; k < m; ++k)
          d.local_element(index[k]) += entry[k * m + k];
      }

      /** The product with x, whose ghost values come and go. Collective. */
      void
      vmult(Vector &image, const Vector &x) const
      {
        image = 0.;
        x.update_ghost_values();
        for (std::size_t c = 0; c + 1 < first_entry.size(); ++c)
          {
            const CorrectionNodes::Cell &here  = nodes.cells[c];
            const unsigned int           m     = here.n_indices;
            const unsigned int          *index = nodes.indices.data() + here.first_index;
            const double                *entry = entries.data() + first_entry[c];
            for (unsigned int k = 0; k < m; ++k)
              {
                double sum = 0;
                for (unsigned int l = 0; l < m; ++l)
                  sum += entry[k * m + l] * x.local_element(index[l]);
                image.local_element(index[k]) += sum;
              }
          }
        x.zero_out_ghost_values();
        image.compress(VectorOperation::add);
      }

    private:
      const CorrectionNodes   &nodes;
      std::vector<std::size_t> first_entry;
      std::vector<double>      entries;
    };

    std::vector<double>
    child_values(const CorrectedSolution::Nodes &nodes, const unsigned int child)
    {
      std::vector<double> values(n_vertices);
      for (unsigned int v = 0; v < n_vertices; ++v)
        values[v] = nodes[child_corners[child][v]];
      return values;
    }

    /** The bilinear function with the given values at the vertices, less the first. */
    CorrectedSolution::Nodes
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
    , element(MomentSet(1))
    , fe(2)
    , dofs(mesh.triangulation())
  {
  }

  void
  HierarchicalCorrection::set_up()
  {
    dofs.distribute_dofs(fe);
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    constraints.clear();
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dofs, constraints);
    mesh.constrain_periodic(dofs, constraints);
    // The vertices of the mesh keep their values. A vertex that hangs on an edge is
    // the new node of that edge and follows it.
    std::vector<types::global_dof_index> local(fe.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(local);
          for (unsigned int v = 0; v < n_vertices; ++v)
            if (!constraints.is_constrained(local[v]))
              constraints.add_line(local[v]);
        }
    constraints.close();
    layout.reinit(dofs.locally_owned_dofs(),
                  relevant,
                  mesh.triangulation().get_communicator());
    list_nodes();
  }

  void
  HierarchicalCorrection::list_nodes()
  {
    nodes                                            = {};
    const auto                          &partitioner = *layout.get_partitioner();
    std::vector<types::global_dof_index> local(fe.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          CorrectionNodes::Cell here;
          here.first_index      = nodes.indices.size();
          here.first_dependence = nodes.dependences.size();
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary())
              {
                if (cell->face(f)->boundary_id() <= FlowMesh::outlet)
                  here.at_reservoir |= 1U << f;
                else if (mesh.seal() != nullptr)
                  here.at_wall |= 1U << f;
              }
          const auto add = [&](const unsigned int            node,
                               const types::global_dof_index dof,
                               const double                  weight) {
            const unsigned int k      = partitioner.global_to_local(dof);
            const auto         begin  = nodes.indices.begin() + here.first_index;
            const auto         found  = std::find(begin, nodes.indices.end(), k);
            const auto         column = static_cast<unsigned int>(found - begin);
            if (found == nodes.indices.end())
              nodes.indices.push_back(k);
            nodes.dependences.push_back({node, column, weight});
          };
          cell->get_dof_indices(local);
          for (unsigned int node = 0; node < n_rim; ++node)
            if (!constraints.is_constrained(local[node]))
              add(node, local[node], 1.);
            else if (const auto *line = constraints.get_constraint_entries(local[node]))
              for (const auto &[dof, weight] : *line)
                add(node, dof, weight);
          here.n_indices =
            static_cast<unsigned int>(nodes.indices.size() - here.first_index);
          here.n_dependences =
            static_cast<unsigned int>(nodes.dependences.size() - here.first_dependence);
          nodes.cells.push_back(here);
        }
  }

  CellCoefficient &
  HierarchicalCorrection::coefficient_on_children(const GapField::Coefficient kind)
  {
    std::unique_ptr<CellCoefficient> &result = on_children[kind];
    if (!result)
      result = make_child_coefficient(mesh, fe, kind);
    return *result;
  }

  CorrectedSolution
  HierarchicalCorrection::relax(const PotentialProblem &problem, const GapField &gap)
  {
    // Half as many steps leave a wider bracket and hence more cells, twice as many cost
    // more than the cells that they save; each costs about as much as the one before.
    constexpr unsigned int n_steps = 4;
    const bool       is_pressure   = problem.kind() == PotentialProblem::Kind::pressure;
    CellCoefficient &coefficient   = coefficient_on_children(problem.coefficient_kind());
    coefficient.update(gap);
    CorrectedSolution   result;
    Vector              x(layout), r(layout), diagonal(layout);
    RimSystems          systems(nodes);
    std::vector<double> vertices;
    const auto is_open = [&](const std::size_t c) { return coefficient.mean(c) > 0; };
    FullMatrix<double> matrix(n_rim + 1, n_rim + 1);
    const auto         find_matrix = [&](const std::size_t c) {
      coefficient.stiffness(c, matrix);
      matrix *= problem.coefficient_weight(c);
    };
    result.values.reserve(nodes.cells.size());
    for (const auto &cell : problem.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const std::size_t c = result.values.size();
          problem.cell_values(cell, vertices);
          result.values.push_back(interpolate(vertices));
          if (is_open(c))
            find_matrix(c);
          systems.append(matrix,
                         result.values.back(),
                         !is_open(c),
                         is_pressure ? nodes.cells[c].at_reservoir
                                     : nodes.cells[c].at_wall,
                         r,
                         diagonal);
        }
    r.compress(VectorOperation::add);
    diagonal.compress(VectorOperation::add);
    for (double &entry : diagonal)
      entry = entry > 0 ? 1. / entry : 0.;
    const DiagonalMatrix<Vector> inverse_diagonal(diagonal);
    solve_by_conjugate_gradients(systems, x, r, inverse_diagonal, 0., n_steps);
    constraints.distribute(x);
    x.update_ghost_values();

    result.cell_energies.assign(nodes.cells.size(), 0.);
    std::vector<types::global_dof_index> local(fe.n_dofs_per_cell());
    std::size_t                          c = 0;
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          if (is_open(c))
            {
              Nodes &values = result.values[c];
              cell->get_dof_indices(local);
              for (unsigned int node = 0; node < n_rim; ++node)
                values[node] += x(local[node]);
              find_matrix(c);
              double at_centre = 0;
              for (unsigned int node = 0; node < n_rim; ++node)
                at_centre -= matrix(centre, node) * values[node];
              values[centre]          = at_centre / matrix(centre, centre);
              result.cell_energies[c] = ElementMatrix::energy(matrix, values);
              result.energy += result.cell_energies[c];
            }
          ++c;
        }
    result.energy =
      Utilities::MPI::sum(result.energy, mesh.triangulation().get_communicator());
    return result;
  }

  double
  HierarchicalCorrection::gradient_times_curl(const Nodes &u, const Nodes &v) const
  {
    double sum = 0;
    for (unsigned int child = 0; child < 4; ++child)
      sum += element.gradient_times_curl(child_values(u, child), child_values(v, child));
    return sum;
  }
} // namespace strait
