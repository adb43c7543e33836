// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/solution_on_grid.h>

#include <deal.II/base/array_view.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <cmath>

namespace strait
{
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
            // Of the image of the cell that is moved by so many periods.
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
    points_in_cell_of_seal(const PeriodicGrid            &grid,
                           const dealii::CellAccessor<2> &cell,
                           const PointRows               &rows)
    {
      // In units of the cell: so far beside a cell at the outline, whose edge may be
      // curved away from them, points are taken for its own. Half of it leaves points out
      // beside coarse cells on arcs, double of it looks at more points for nothing.
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
      std::vector<dealii::Point<2>> positions;
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i)
          positions.emplace_back(origin[0] + i * spacing[0], origin[1] + j * spacing[1]);
      std::vector<dealii::Point<2>> unit(positions.size());
      dealii::StaticMappingQ1<2>::mapping.transform_points_real_to_unit_cell(
        dealii::Triangulation<2>::cell_iterator(cell),
        dealii::make_array_view(positions),
        dealii::make_array_view(unit));
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
  points_in_cell(const FlowMesh                &mesh,
                 const dealii::CellAccessor<2> &cell,
                 const PointRows               &rows)
  {
    return mesh.seal() == nullptr
             ? points_in_cell_of_box(mesh.grid(), mesh.grid_cell(cell), rows)
             : points_in_cell_of_seal(mesh.grid(), cell, rows);
  }
} // namespace strait
