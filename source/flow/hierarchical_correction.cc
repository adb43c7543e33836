// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/hierarchical_correction.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>

namespace strait
{
  using namespace dealii;

  namespace
  {
    std::vector<double>
    child_values(const CorrectedSolution::Nodes &nodes, const unsigned int child)
    {
      std::vector<double> values(RimSystems::n_vertices);
      for (unsigned int v = 0; v < RimSystems::n_vertices; ++v)
        values[v] = nodes[ChildCoefficient::corners[child][v]];
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

    RimSystems::Matrix
    matrix_of(const CellCoefficient &coefficient,
              const std::size_t      cell,
              const double           weight)
    {
      RimSystems::Matrix         matrix;
      dealii::FullMatrix<double> full(matrix.size(), matrix.size());
      coefficient.stiffness(cell, full);
      for (unsigned int i = 0; i < matrix.size(); ++i)
        for (unsigned int j = 0; j < matrix.size(); ++j)
          matrix[i][j] = weight * full(i, j);
      return matrix;
    }

    double
    energy_of(const RimSystems::Matrix &matrix, const CorrectedSolution::Nodes &values)
    {
      double energy = 0;
      for (unsigned int i = 0; i < values.size(); ++i)
        for (unsigned int j = 0; j < values.size(); ++j)
          energy += matrix[i][j] * (values[i] - values[0]) * (values[j] - values[0]);
      return energy;
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
          for (unsigned int v = 0; v < RimSystems::n_vertices; ++v)
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
          for (unsigned int node = 0; node < RimSystems::n_rim; ++node)
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

  CorrectedSolution
  HierarchicalCorrection::relax(const PotentialProblem &problem,
                                const GapField         &gap) const
  {
    // Half as many steps leave a wider bracket and hence more cells, twice as many cost
    // more than the cells that they save; each costs about as much as the one before.
    constexpr unsigned int n_steps = 4;
    const bool is_pressure         = problem.kind() == PotentialProblem::Kind::pressure;
    const auto coefficient = make_child_coefficient(mesh, fe, problem.coefficient_kind());
    coefficient->update(gap);
    CorrectedSolution   result;
    Vector              x(layout), r(layout), diagonal(layout);
    RimSystems          systems(nodes);
    std::vector<double> vertices;
    const auto is_open   = [&](const std::size_t c) { return coefficient->mean(c) > 0; };
    const auto matrix_on = [&](const std::size_t c) {
      return matrix_of(*coefficient, c, problem.coefficient_weight(c));
    };
    result.values.reserve(nodes.cells.size());
    for (const auto &cell : problem.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const std::size_t c = result.values.size();
          problem.cell_values(cell, vertices);
          result.values.push_back(interpolate(vertices));
          systems.append(is_open(c) ? matrix_on(c) : RimSystems::Matrix(),
                         result.values.back(),
                         !is_open(c),
                         is_pressure ? nodes.cells[c].at_reservoir
                                     : nodes.cells[c].at_wall,
                         r,
                         diagonal);
        }
    r.compress(VectorOperation::add);
    diagonal.compress(VectorOperation::add);
    systems.conjugate_gradients(n_steps, x, r, diagonal);
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
              for (unsigned int node = 0; node < RimSystems::n_rim; ++node)
                values[node] += x(local[node]);
              const RimSystems::Matrix matrix    = matrix_on(c);
              double                   at_centre = 0;
              for (unsigned int node = 0; node < RimSystems::n_rim; ++node)
                at_centre -= matrix[RimSystems::centre][node] * values[node];
              values[RimSystems::centre] =
                at_centre / matrix[RimSystems::centre][RimSystems::centre];
              result.cell_energies[c] = energy_of(matrix, values);
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
