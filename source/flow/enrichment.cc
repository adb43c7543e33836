// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/enrichment.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>

namespace strait
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_vertices = 4, n_rim = 8, centre = 8;

    /** Nodes at the corners of the children, deal.II's order throughout. */
    constexpr std::array<std::array<unsigned int, 4>, 4> corners_of_child = {
      {{{0, 6, 4, 8}}, {{6, 1, 8, 5}}, {{4, 8, 2, 7}}, {{8, 5, 7, 3}}}};

    std::vector<double>
    child_values(const EnrichedSolution::Nodes &nodes, const unsigned int child)
    {
      std::vector<double> values(n_vertices);
      for (unsigned int v = 0; v < n_vertices; ++v)
        values[v] = nodes[corners_of_child[child][v]];
      return values;
    }

    /** The bilinear function with the given values at the vertices, less the first. */
    EnrichedSolution::Nodes
    interpolate(const std::vector<double> &vertices)
    {
      const double a = vertices[1] - vertices[0], b = vertices[2] - vertices[0],
                   c = vertices[3] - vertices[0];
      return {
        {0., a, b, c, .5 * b, .5 * (a + c), .5 * a, .5 * (b + c), .25 * (a + b + c)}};
    }
  } // namespace

  /** The systems of the cells in the freed nodes of their rims. */
  class Enrichment::LocalSystems
  {
  public:
    using Matrix = std::array<std::array<double, 9>, 9>;

    explicit LocalSystems(const Enrichment &enrichment)
      : mesh_nodes(enrichment)
    {
      first_entry.reserve(mesh_nodes.cells.size() + 1);
      first_entry.push_back(0);
    }

    /** Append the next cell's, and add its share to residual and diagonal. */
    void
    append(const Matrix &matrix,
           const Nodes  &base,
           const bool    closed,
           const bool    fixed_at_reservoirs,
           Vector       &r,
           Vector       &d)
    {
      const CellNodes   &here = mesh_nodes.cell_nodes[first_entry.size() - 1];
      const unsigned int m    = here.n_indices;
      first_entry.push_back(first_entry.back() + m * m);
      entries.resize(first_entry.back(), 0.);
      if (closed)
        return;
      // Eliminate the centre; residual of the rim with the centre at its optimum.
      double rim[n_rim][n_rim], residual[n_rim];
      double at_centre = 0;
      for (unsigned int j = 0; j < base.size(); ++j)
        at_centre -= matrix[centre][j] * base[j];
      for (unsigned int i = 0; i < n_rim; ++i)
        {
          const double share = matrix[i][centre] / matrix[centre][centre];
          residual[i]        = -share * at_centre;
          for (unsigned int j = 0; j < base.size(); ++j)
            residual[i] -= matrix[i][j] * base[j];
          for (unsigned int j = 0; j < n_rim; ++j)
            rim[i][j] = matrix[i][j] - share * matrix[centre][j];
        }
      const Dependence   *first = mesh_nodes.dependences.data() + here.first_dependence;
      double             *entry = entries.data() + first_entry[first_entry.size() - 2];
      const unsigned int *index = mesh_nodes.indices.data() + here.first_index;
      const auto          is_fixed = [&](const unsigned int node) {
        return fixed_at_reservoirs && node >= n_vertices &&
               (here.at_reservoir >> (node - n_vertices) & 1U) != 0;
      };
      for (unsigned int k = 0; k < here.n_dependences; ++k)
        {
          const Dependence &row = first[k];
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

    /** image += A x, for the cells of this rank. */
    void
    apply(const Vector &x, Vector &image) const
    {
      for (std::size_t c = 0; c + 1 < first_entry.size(); ++c)
        {
          const CellNodes    &here  = mesh_nodes.cell_nodes[c];
          const unsigned int  m     = here.n_indices;
          const unsigned int *index = mesh_nodes.indices.data() + here.first_index;
          const double       *entry = entries.data() + first_entry[c];
          for (unsigned int k = 0; k < m; ++k)
            {
              double sum = 0;
              for (unsigned int l = 0; l < m; ++l)
                sum += entry[k * m + l] * x.local_element(index[l]);
              image.local_element(index[k]) += sum;
            }
        }
    }

  private:
    const Enrichment        &mesh_nodes;
    std::vector<std::size_t> first_entry;
    std::vector<double>      entries;
  };

  Enrichment::Enrichment(const FlowMesh &mesh_)
    : mesh(mesh_)
    , element(MomentSet(1))
    , fe(2)
    , dofs(mesh.triangulation())
  {
  }

  void
  Enrichment::set_up()
  {
    dofs.distribute_dofs(fe);
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    constraints.clear();
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dofs, constraints);
    DoFTools::make_periodicity_constraints(dofs,
                                           FlowMesh::periodic_first,
                                           FlowMesh::periodic_last,
                                           1 - mesh.axis_along(),
                                           constraints);
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
  Enrichment::list_nodes()
  {
    cells = mesh.owned_grid_cells();
    child_cells.clear();
    cell_nodes.clear();
    indices.clear();
    dependences.clear();
    const auto                          &partitioner = *layout.get_partitioner();
    std::vector<types::global_dof_index> local(fe.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const GridCell parent = cells[cell_nodes.size()];
          for (int child = 0; child < 4; ++child)
            child_cells.push_back(
              {parent.exponent - 1, 2 * parent.i + child % 2, 2 * parent.j + child / 2});
          CellNodes here;
          here.first_index      = indices.size();
          here.first_dependence = dependences.size();
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() &&
                cell->face(f)->boundary_id() <= FlowMesh::outlet)
              here.at_reservoir |= 1U << f;
          const auto add = [&](const unsigned int            node,
                               const types::global_dof_index dof,
                               const double                  weight) {
            const unsigned int k      = partitioner.global_to_local(dof);
            const auto         begin  = indices.begin() + here.first_index;
            const auto         found  = std::find(begin, indices.end(), k);
            const auto         column = static_cast<unsigned int>(found - begin);
            if (found == indices.end())
              indices.push_back(k);
            dependences.push_back({node, column, weight});
          };
          cell->get_dof_indices(local);
          for (unsigned int node = 0; node < n_rim; ++node)
            if (!constraints.is_constrained(local[node]))
              add(node, local[node], 1.);
            else if (const auto *line = constraints.get_constraint_entries(local[node]))
              for (const auto &[dof, weight] : *line)
                add(node, dof, weight);
          here.n_indices = static_cast<unsigned int>(indices.size() - here.first_index);
          here.n_dependences =
            static_cast<unsigned int>(dependences.size() - here.first_dependence);
          cell_nodes.push_back(here);
        }
  }

  void
  Enrichment::macro_matrix(const std::size_t     cell,
                           const CellAnswers    &answers,
                           LocalSystems::Matrix &matrix) const
  {
    FullMatrix<double> small(n_vertices, n_vertices);
    matrix = {};
    for (unsigned int child = 0; child < 4; ++child)
      {
        element.stiffness(answers[4 * cell + child].moments,
                          mesh.width(cells[cell]),
                          mesh.height(cells[cell]),
                          small);
        const auto &corner = corners_of_child[child];
        for (unsigned int i = 0; i < n_vertices; ++i)
          for (unsigned int j = 0; j < n_vertices; ++j)
            matrix[corner[i]][corner[j]] += small(i, j);
      }
  }

  void
  Enrichment::conjugate_gradients(const LocalSystems &systems,
                                  const unsigned int  n_steps,
                                  Vector             &x,
                                  Vector             &r,
                                  const Vector       &diagonal) const
  {
    Vector     direction(layout), z(layout), image(layout);
    const auto precondition = [&]() {
      for (std::size_t k = 0; k < z.locally_owned_size(); ++k)
        {
          const double d     = diagonal.local_element(k);
          z.local_element(k) = d > 0 ? r.local_element(k) / d : 0.;
        }
      return z * r;
    };
    double rz = precondition();
    direction = z;
    for (unsigned int step = 0; step < n_steps && rz > 0; ++step)
      {
        image = 0.;
        direction.update_ghost_values();
        systems.apply(direction, image);
        direction.zero_out_ghost_values();
        image.compress(VectorOperation::add);
        const double alpha = rz / (direction * image);
        x.add(alpha, direction);
        r.add(-alpha, image);
        const double next = precondition();
        direction.sadd(next / rz, 1., z);
        rz = next;
      }
  }

  EnrichedSolution
  Enrichment::relax(const PotentialProblem &problem,
                    const CellAnswers      &answers,
                    const unsigned int      n_steps) const
  {
    const bool           is_pressure = problem.kind() == PotentialProblem::Kind::pressure;
    EnrichedSolution     result;
    Vector               x(layout), r(layout), diagonal(layout);
    LocalSystems         systems(*this);
    LocalSystems::Matrix matrix = {};
    std::vector<double>  vertices;
    const auto           is_open = [&](const std::size_t c) {
      for (unsigned int child = 0; child < 4; ++child)
        if (answers[4 * c + child].moments[0] > 0)
          return true;
      return false;
    };
    result.values.reserve(cells.size());
    for (const auto &cell : problem.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const std::size_t c = result.values.size();
          problem.cell_values(cell, vertices);
          result.values.push_back(interpolate(vertices));
          if (is_open(c))
            macro_matrix(c, answers, matrix);
          systems.append(
            matrix, result.values.back(), !is_open(c), is_pressure, r, diagonal);
        }
    r.compress(VectorOperation::add);
    diagonal.compress(VectorOperation::add);
    conjugate_gradients(systems, n_steps, x, r, diagonal);
    constraints.distribute(x);
    x.update_ghost_values();

    result.cell_energies.assign(cells.size(), 0.);
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
              macro_matrix(c, answers, matrix);
              double at_centre = 0;
              for (unsigned int node = 0; node < n_rim; ++node)
                at_centre -= matrix[centre][node] * values[node];
              values[centre] = at_centre / matrix[centre][centre];
              for (unsigned int i = 0; i < values.size(); ++i)
                for (unsigned int j = 0; j < values.size(); ++j)
                  result.cell_energies[c] +=
                    matrix[i][j] * (values[i] - values[0]) * (values[j] - values[0]);
              result.energy += result.cell_energies[c];
            }
          ++c;
        }
    result.energy =
      Utilities::MPI::sum(result.energy, mesh.triangulation().get_communicator());
    return result;
  }

  double
  Enrichment::gradient_times_curl(const Nodes &u, const Nodes &v) const
  {
    double sum = 0;
    for (unsigned int child = 0; child < 4; ++child)
      sum += element.gradient_times_curl(child_values(u, child), child_values(v, child));
    return sum;
  }
} // namespace strait
