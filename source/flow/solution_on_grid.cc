// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/flow/solution_on_grid.h>

#include <deal.II/base/array_view.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace strait
{
  using namespace dealii;

  namespace
  {
    std::vector<PointInCell>
    points_in_cell_of_box(const PeriodicGrid &grid,
                          const GridCell     &cell,
                          const PointRows    &rows)
    {
      const double size     = std::ldexp(1., cell.exponent);
      const auto   index_at = [&rows](const double x, const double x0) {
        return static_cast<int>(std::ceil((x - x0) / rows.step));
      };
      std::vector<PointInCell> points;
      for (const int i : {-1, 0, 1})
        for (const int j : {-1, 0, 1})
          {
            // The image of the cell that is shifted by (i, j) periods.
            const double low_x = cell.i * size + i * grid.nx;
            const double low_y = cell.j * size + j * grid.ny;
            const int    end_x = std::min(index_at(low_x + size, rows.x0), rows.nx);
            const int    end_y = std::min(index_at(low_y + size, rows.y0), rows.ny);
            for (int iy = std::max(index_at(low_y, rows.y0), 0); iy < end_y; ++iy)
              for (int ix = std::max(index_at(low_x, rows.x0), 0); ix < end_x; ++ix)
                points.push_back({ix,
                                  iy,
                                  (rows.x0 + ix * rows.step - low_x) / size,
                                  (rows.y0 + iy * rows.step - low_y) / size});
          }
      return points;
    }

    std::vector<PointInCell>
    points_in_cell_of_seal(const PeriodicGrid    &grid,
                           const CellAccessor<2> &cell,
                           const PointRows       &rows)
    {
      // How far, in units of the cell, points beside a cell at the outline may be to be
      // taken for its own, as its edge may be curved. Half of it leaves out points beside
      // coarse cells on arcs; double of it looks at more points for nothing.
      constexpr double beside      = 1. / 3;
      const double     slack       = cell.at_boundary() ? beside : precision_of_meshes;
      const double     spacing[2]  = {grid.dx() * rows.step, grid.dy() * rows.step};
      const double     origin[2]   = {grid.dx() * rows.x0, grid.dy() * rows.y0};
      const int        n_points[2] = {rows.nx, rows.ny};
      const auto       box         = cell.bounding_box();
      int              first[2], last[2];
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double margin = slack * box.side_length(d);
          const auto index = [&](const double x) { return (x - origin[d]) / spacing[d]; };
          first[d] =
            std::max(static_cast<int>(std::ceil(index(box.lower_bound(d) - margin))), 0);
          last[d] =
            std::min(static_cast<int>(std::floor(index(box.upper_bound(d) + margin))),
                     n_points[d] - 1);
        }
      std::vector<Point<2>> positions;
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i)
          positions.emplace_back(origin[0] + i * spacing[0], origin[1] + j * spacing[1]);
      std::vector<Point<2>> unit(positions.size());
      StaticMappingQ1<2>::mapping.transform_points_real_to_unit_cell(
        Triangulation<2>::cell_iterator(cell),
        make_array_view(positions),
        make_array_view(unit));
      std::vector<PointInCell> points;
      auto                     x = unit.cbegin();
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i, ++x)
          {
            const double s = (*x)[0], t = (*x)[1];
            const auto   within = [s, t](const double d) {
              return s >= -d && s <= 1 + d && t >= -d && t <= 1 + d;
            };
            if (within(slack))
              points.push_back({i,
                                j,
                                std::clamp(s, 0., 1.),
                                std::clamp(t, 0., 1.),
                                within(precision_of_meshes)});
          }
      return points;
    }

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
      // The gradient for which the potential rises by these values along the edges.
      return (along_a * b - along_b * a).norm() / std::abs(a[0] * b[1] - a[1] * b[0]);
    }

    /**
     * Return |∇| of the potential at the vertices [1/length], as mean over the cells that
     * meet there, at the unknowns of the vertices, with ghost values. Collective.
     */
    LinearAlgebra::distributed::Vector<double>
    vertex_slopes(const PotentialProblem &problem)
    {
      const DoFHandler<2>                       &dofs = problem.dof_handler();
      LinearAlgebra::distributed::Vector<double> slopes(
        dofs.locally_owned_dofs(),
        DoFTools::extract_locally_relevant_dofs(dofs),
        dofs.get_communicator());
      auto                                 counts(slopes);
      std::vector<double>                  values;
      std::vector<types::global_dof_index> indices(dofs.get_fe().n_dofs_per_cell());
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

  PointRows
  rows_of_grid(const PeriodicGrid &grid, const int stride)
  {
    return {0.,
            0.,
            static_cast<double>(stride),
            (grid.nx + stride - 1) / stride,
            (grid.ny + stride - 1) / stride};
  }

  PointRows
  rows_of_window(const SlabLayout &layout, const int window)
  {
    const auto [x, y]    = layout.position(window, 0, 0);
    const ZoomWindow &of = layout.windows()[window];
    return {x / layout.grid().dx(),
            y / layout.grid().dy(),
            std::pow(3., -of.level),
            of.n_columns(),
            of.n_rows()};
  }

  std::vector<PointInCell>
  points_in_cell(const FlowMesh &mesh, const CellAccessor<2> &cell, const PointRows &rows)
  {
    return mesh.seal() == nullptr
             ? points_in_cell_of_box(mesh.grid(), mesh.grid_cell(cell), rows)
             : points_in_cell_of_seal(mesh.grid(), cell, rows);
  }

  SlabField
  potential_on_grid(const ReynoldsSolver &solver, const SlabLayoutPtr &layout)
  {
    const PotentialProblem &pressure = solver.pressure();
    const FiniteElement<2> &fe       = pressure.dof_handler().get_fe();
    std::vector<double>     values;
    // Call add(point, potential) for the points of some rows in the cells of this rank.
    const auto for_each_of = [&](const PointRows &points, const auto &add) {
      for (std::size_t c = 0; c < pressure.cells().size(); ++c)
        {
          pressure.cell_values(c, values);
          for (const PointInCell &p :
               points_in_cell(solver.mesh(), *pressure.cells()[c], points))
            {
              double potential = 0.;
              for (unsigned int i = 0; i < values.size(); ++i)
                potential += values[i] * fe.shape_value(i, {p.s, p.t});
              add(p, potential);
            }
        }
    };
    std::map<int, std::vector<double>> rows; // with points in this rank's cells
    for_each_of(rows_of_grid(layout->grid(), 1),
                [&](const PointInCell &p, const double potential) {
                  rows.try_emplace(p.iy, layout->grid().nx).first->second[p.ix] +=
                    potential;
                });
    std::vector<int>    touched;
    std::vector<double> lines;
    for (const auto &[row, line] : rows)
      {
        touched.push_back(row);
        lines.insert(lines.end(), line.begin(), line.end());
      }
    SlabField result(layout);
    add_rows(*layout, touched, lines, result.data());
    for (int w = 0; w < static_cast<int>(layout->windows().size()); ++w)
      for_each_of(rows_of_window(*layout, w),
                  [&](const PointInCell &p, const double potential) {
                    result[layout->index_of({p.ix, p.iy, w})] += potential;
                  });
    sum_in_place(layout->communicator(),
                 result.data() + layout->n_local_points(),
                 result.size() - layout->n_local_points());
    return result;
  }

  FlowAtPoints
  flow_at_points(const ReynoldsSolver &solver, const PointRows &rows)
  {
    const FlowMesh          &mesh    = solver.mesh();
    const auto              &cells   = solver.pressure().cells();
    constexpr float          unknown = -std::numeric_limits<float>::infinity();
    const std::vector<float> nothing(static_cast<std::size_t>(rows.nx) * rows.ny,
                                     unknown);
    // Cells share the points on their edges, and points beside cells, which only count
    // where no cell of any rank contains them.
    FlowAtPoints   inside{nothing, nothing}, beside{nothing, nothing};
    const auto     slope = vertex_slopes(solver.stream_function());
    Vector<double> pressures(solver.pressure().dof_handler().get_fe().n_dofs_per_cell());
    Vector<double> slopes(pressures.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (const auto points = points_in_cell(mesh, *cells[c], rows); !points.empty())
        {
          cells[c]->get_dof_values(solver.pressure().solution(), pressures);
          solver.stream_function().cells()[c]->get_dof_values(slope, slopes);
          for (const PointInCell &p : points)
            {
              const std::size_t k  = static_cast<std::size_t>(p.iy) * rows.nx + p.ix;
              FlowAtPoints     &at = p.inside ? inside : beside;
              const auto        keep_larger = [](float &kept, const double value) {
                kept = std::max(kept, static_cast<float>(value));
              };
              keep_larger(at.pressure[k], p.interpolate(pressures));
              keep_larger(at.current[k], p.interpolate(slopes));
            }
        }
    for (std::vector<float> FlowAtPoints::*field :
         {&FlowAtPoints::pressure, &FlowAtPoints::current})
      {
        for (FlowAtPoints *at : {&inside, &beside})
          Utilities::MPI::max(at->*field,
                              mesh.triangulation().get_communicator(),
                              at->*field);
        for (std::size_t k = 0; k < nothing.size(); ++k)
          if ((inside.*field)[k] == unknown)
            (inside.*field)[k] = std::max((beside.*field)[k], 0.F);
      }
    return inside;
  }
} // namespace strait
