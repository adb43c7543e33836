// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/flow_mesh.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace strait
{
  namespace
  {
    // Periodicity in deal.II wants two coarse cells across.
    int
    coarsest_exponent(const PeriodicGrid &grid, const int n_halvings)
    {
      int e = n_halvings;
      while (e > 0 && ((grid.nx >> e) < 2 || (grid.ny >> e) < 2))
        --e;
      return e;
    }
  } // namespace

  FlowMesh::FlowMesh(const GapField &gap, const FlowDirection direction)
    : periodic_grid(gap.layout().grid())
    , flow_direction(direction)
    , root_exponent(coarsest_exponent(periodic_grid, gap.n_halvings()))
    , tria(gap.layout().communicator())
  {
    const std::vector<unsigned int> n_roots = {
      static_cast<unsigned int>(periodic_grid.nx >> root_exponent),
      static_cast<unsigned int>(periodic_grid.ny >> root_exponent)};
    dealii::GridGenerator::subdivided_hyper_rectangle(tria,
                                                      n_roots,
                                                      dealii::Point<2>(0., 0.),
                                                      dealii::Point<2>(periodic_grid.lx,
                                                                       periodic_grid.ly));

    const unsigned int along = axis_along();
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          {
            const bool first = f % 2 == 0;
            if (f / 2 == along)
              cell->face(f)->set_boundary_id(first ? inlet : outlet);
            else
              cell->face(f)->set_boundary_id(first ? periodic_first : periodic_last);
          }
    std::vector<dealii::GridTools::PeriodicFacePair<Triangulation::cell_iterator>> pairs;
    dealii::GridTools::collect_periodic_faces(
      tria, periodic_first, periodic_last, 1 - along, pairs);
    tria.add_periodicity(pairs);
  }

  GridCell
  FlowMesh::grid_cell(const dealii::CellAccessor<2> &cell) const
  {
    GridCell   result;
    const auto corner = cell.vertex(0);
    result.exponent   = exponent_of_level(cell.level());
    result.i          = static_cast<int>(std::lround(corner[0] / width(result)));
    result.j          = static_cast<int>(std::lround(corner[1] / height(result)));
    return result;
  }

  std::vector<GridCell>
  FlowMesh::owned_grid_cells() const
  {
    std::vector<GridCell> cells;
    cells.reserve(tria.n_locally_owned_active_cells());
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        cells.push_back(grid_cell(*cell));
    return cells;
  }

  void
  FlowMesh::refine_uniformly(const int exponent)
  {
    const int n = root_exponent - exponent;
    if (n > 0)
      tria.refine_global(n);
  }

  void
  FlowMesh::refine_initially(const GapField &gap, const std::vector<FlowPath> &paths)
  {
    constexpr int start_exponent = 4;
    refine_uniformly(std::min(start_exponent, root_exponent));
    std::map<int, CellSet> near_paths;
    for (int exponent = 1; exponent <= std::min(start_exponent, root_exponent);
         ++exponent)
      near_paths[exponent] = cells_near(paths, exponent);
    while (refine_contact_lines_and_paths(gap, near_paths))
      ;
  }

  FlowMesh::CellSet
  FlowMesh::cells_near(const std::vector<FlowPath> &paths, const int exponent) const
  {
    const int nx = periodic_grid.nx >> exponent, ny = periodic_grid.ny >> exponent;
    CellSet   cells;
    for (const FlowPath &path : paths)
      for (const GridPoint &point : path.points)
        for (int a = -1; a <= 1; ++a)
          for (int b = -1; b <= 1; ++b)
            cells.emplace_back(((point.ix >> exponent) + a + nx) % nx,
                               ((point.iy >> exponent) + b + ny) % ny);
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }

  bool
  FlowMesh::refine_contact_lines_and_paths(const GapField               &gap,
                                           const std::map<int, CellSet> &near_paths)
  {
    constexpr int               contact_line_exponent = 2;
    const std::vector<GridCell> cells                 = owned_grid_cells();
    const CellAnswers answers   = gap.ask(GapField::Coefficient::conductivity, cells);
    std::size_t       c         = 0;
    unsigned int      n_flagged = 0;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const GridCell  &here   = cells[c];
          const CellAnswer answer = answers[c];
          const bool       cut    = answer.open && answer.closed;
          ++c;
          const auto near_path = near_paths.find(here.exponent);
          const bool on_path   = near_path != near_paths.end() &&
                               std::binary_search(near_path->second.begin(),
                                                  near_path->second.end(),
                                                  std::make_pair(here.i, here.j));
          if (on_path || (cut && here.exponent > contact_line_exponent))
            {
              cell->set_refine_flag();
              ++n_flagged;
            }
        }
    if (dealii::Utilities::MPI::sum(n_flagged, tria.get_communicator()) == 0)
      return false;
    tria.execute_coarsening_and_refinement();
    return true;
  }
} // namespace strait
