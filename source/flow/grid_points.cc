// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/grid_points.h>

#include <deal.II/base/array_view.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** Of points at x0 + k·step those in a cell along one axis of the box, from the first
     *  to before the last. */
    struct Range
    {
      Range(const double low,
            const double size,
            const double x0,
            const double step,
            const int    n_points)
        : first(std::max(static_cast<int>(std::ceil((low - x0) / step)), 0))
        , end(std::min(static_cast<int>(std::ceil((low + size - x0) / step)), n_points))
      {
      }

      int first, end;
    };

    /** Of the image of the cell that is moved by @p shift_x and @p shift_y spacings. */
    void
    add_points_in_cell_of_box(const GridCell           &cell,
                              const int                 shift_x,
                              const int                 shift_y,
                              const PointRows          &rows,
                              std::vector<PointInCell> &points)
    {
      const double size  = std::ldexp(1., cell.exponent);
      const double low_x = cell.i * size + shift_x, low_y = cell.j * size + shift_y;
      const Range  x(low_x, size, rows.x0, rows.step, rows.nx);
      const Range  y(low_y, size, rows.y0, rows.step, rows.ny);
      for (int iy = y.first; iy < y.end; ++iy)
        for (int ix = x.first; ix < x.end; ++ix)
          points.push_back({ix,
                            iy,
                            (rows.x0 + ix * rows.step - low_x) / size,
                            (rows.y0 + iy * rows.step - low_y) / size});
    }
  } // namespace

  std::vector<PointInCell>
  points_in_cell(const FlowMesh                &mesh,
                 const dealii::CellAccessor<2> &cell,
                 const PointRows               &rows)
  {
    const PeriodicGrid      &grid = mesh.grid();
    std::vector<PointInCell> points;
    if (mesh.seal() == nullptr)
      {
        for (const int i : {-1, 0, 1})
          for (const int j : {-1, 0, 1})
            add_points_in_cell_of_box(
              mesh.grid_cell(cell), i * grid.nx, j * grid.ny, rows, points);
        return points;
      }
    // In units of the cell: so far beside a cell at the outline, whose edge may be curved
    // away from them, points are taken for its own. Half of it leaves points out beside
    // coarse cells on arcs, double of it looks at more points for nothing.
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
        const auto   index = [&](const double x) { return (x - origin[d]) / spacing[d]; };
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
    auto x = unit.cbegin();
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
} // namespace strait
