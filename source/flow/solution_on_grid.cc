// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/reynolds_solver.h>
#include <strait/flow/solution_on_grid.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <cmath>
#include <map>

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

    /**
     * |∇| of the potential at the vertices [1/length], the mean over the cells that meet
     * there, at the unknowns of the vertices, with ghost values. Collective.
     */
    LinearAlgebra::distributed::Vector<double>
    vertex_slopes(const PotentialProblem &problem)
    {
      const DoFHandler<2> &dofs = problem.dof_handler();
      IndexSet             relevant;
      DoFTools::extract_locally_relevant_dofs(dofs, relevant);
      LinearAlgebra::distributed::Vector<double> slopes(dofs.locally_owned_dofs(),
                                                        relevant,
                                                        dofs.get_communicator());
      auto                                       counts(slopes);
      std::vector<double>                        values;
      std::vector<types::global_dof_index>       indices(dofs.get_fe().n_dofs_per_cell());
      for (std::size_t c = 0; c < problem.cells().size(); ++c)
        {
          const auto &cell = problem.cells()[c];
          problem.cell_values(c, values);
          cell->get_dof_indices(indices);
          for (const unsigned int v : cell->vertex_indices())
            {
              slopes(indices[v]) += slope_at_vertex(cell, v, values);
              counts(indices[v]) += 1.;
            }
        }
      slopes.compress(VectorOperation::add);
      counts.compress(VectorOperation::add);
      for (const auto k : dofs.locally_owned_dofs())
        if (counts(k) > 0)
          slopes(k) /= counts(k);
      slopes.update_ghost_values();
      return slopes;
    }
  } // namespace

  SlabField
  potential_on_grid(const ReynoldsSolver &solver, const SlabLayoutPtr &layout)
  {
    const PotentialProblem            &pressure = solver.pressure();
    const FiniteElement<2>            &fe       = pressure.dof_handler().get_fe();
    const PointRows                    points   = rows_of_grid(layout->grid(), 1);
    std::map<int, std::vector<double>> rows; // that this rank's cells touch
    std::vector<double>                values;
    for (std::size_t c = 0; c < pressure.cells().size(); ++c)
      {
        pressure.cell_values(c, values);
        for (const PointInCell &p :
             points_in_cell(solver.mesh(), *pressure.cells()[c], points))
          {
            auto &row = rows.try_emplace(p.iy, layout->grid().nx).first->second;
            for (unsigned int i = 0; i < values.size(); ++i)
              row[p.ix] += values[i] * fe.shape_value(i, {p.s, p.t});
          }
      }
    std::vector<int>    touched;
    std::vector<double> lines;
    for (const auto &[row, line] : rows)
      {
        touched.push_back(row);
        lines.insert(lines.end(), line.begin(), line.end());
      }
    SlabField result(layout);
    add_rows(*layout, touched, lines, result.data());
    return result;
  }

  FlowAtPoints
  flow_at_points(const ReynoldsSolver &solver, const PointRows &rows)
  {
    const FlowMesh    &mesh  = solver.mesh();
    const auto        &cells = solver.pressure().cells();
    std::vector<float> nothing(static_cast<std::size_t>(rows.nx) * rows.ny, 0.F);
    FlowAtPoints       result{nothing, nothing};
    const auto         slope = vertex_slopes(solver.stream_function());
    Vector<double> pressures(solver.pressure().dof_handler().get_fe().n_dofs_per_cell());
    Vector<double> slopes(pressures.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (const auto points = points_in_cell(mesh, *cells[c], rows); !points.empty())
        {
          cells[c]->get_dof_values(solver.pressure().solution(), pressures);
          solver.stream_function().cells()[c]->get_dof_values(slope, slopes);
          for (const PointInCell &p : points)
            {
              const std::size_t k = static_cast<std::size_t>(p.iy) * rows.nx + p.ix;
              if (p.inside || result.current[k] == 0.F)
                {
                  result.pressure[k] = static_cast<float>(p.interpolate(pressures));
                  result.current[k]  = static_cast<float>(p.interpolate(slopes));
                }
            }
        }
    // Cells of a seal mesh share the points on their edges.
    for (std::vector<float> *field : {&result.pressure, &result.current})
      Utilities::MPI::max(*field, mesh.triangulation().get_communicator(), *field);
    return result;
  }
} // namespace strait
