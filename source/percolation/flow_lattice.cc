// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/percolation/flow_lattice.h>

#include <algorithm>

namespace strait
{
  FlowLattice::FlowLattice(const SlabField &field, const FlowDomain &domain)
    : layout(field.layout_pointer())
    , levels(*layout, domain)
    , communicator(layout->communicator())
    , region(domain.region)
    , values(values_on_grid(field))
  {
    values.reserve(levels.n_points());
    is_covered.resize(levels.size() > 1 ? levels.n_points() : 0, false);
    for (int l = 1; l < levels.size(); ++l)
      {
        const Level &level = levels[l];
        for (int b = 0; b < level.n_across; ++b)
          for (int a = 0; a < level.n_along; ++a)
            values.push_back(field[layout->index_of(levels.point({l, a, b}))]);
        for (int b = 1; b < level.n_across; b += 3)
          for (int a = 1; a < level.n_along; a += 3)
            for_each_copy(levels.parent_of({l, a, b}),
                          [this](const std::size_t k) { is_covered[k] = true; });
      }
  }

  std::vector<double>
  FlowLattice::values_on_grid(const SlabField &field) const
  {
    const int           nx = field.grid().nx, ny = field.grid().ny;
    std::vector<double> result(levels.n_on_grid, 0.);
    if (region != nullptr)
      {
        const std::vector<double> whole = gather_on_root(field);
        for (std::size_t k = 0; k < result.size(); ++k)
          if (region->is_point(k))
            result[k] = whole[k / levels.length % ny * nx + k % levels.length % nx];
        return result;
      }
    const RowsAround rows(field);
    auto             next = result.begin();
    for (int line = levels.first; line < levels.end; ++line)
      {
        const double *row = rows[line - layout->first_row()];
        next              = std::copy_n(row, nx, next);
        if (levels.length > nx) // the seam's copy
          *next++ = *row;
      }
    return result;
  }

  bool
  FlowLattice::is_outlet(const std::size_t k) const
  {
    if (region != nullptr)
      return region->is_outlet(k);
    const Place  p     = place_of(k);
    const Level &level = levels[p.level];
    return level.ends_at_outlet && p.along == level.n_along - 1 - level.rim();
  }

  std::size_t
  FlowLattice::number_at(const GridPoint &p) const
  {
    return p.window < 0 ? finest(levels.number_of(p.iy, p.ix))
                        : number_of(levels.finest(levels.place(p)));
  }

  std::size_t
  FlowLattice::number_of(const Place &p) const
  {
    std::size_t number = none;
    for_each_copy(p, [&](const std::size_t k) { number = number == none ? k : number; });
    return number;
  }

  std::size_t
  FlowLattice::global_number(const Place &p) const
  {
    const Level &grid = levels[0];
    const auto   n    = static_cast<std::size_t>(grid.n_along);
    return p.level == 0 ? levels.wrapped(p.across) * n + p.along
                        : grid.n_across * n + (number_of(p) - levels.n_on_grid);
  }

  std::size_t
  FlowLattice::own_number(const std::size_t global) const
  {
    const Level &grid = levels[0];
    const auto   n    = static_cast<std::size_t>(grid.n_along);
    if (global >= grid.n_across * n)
      return layout->rank() == 0 ? global - grid.n_across * n + levels.n_on_grid : none;
    const std::size_t k =
      number_of({0, static_cast<int>(global % n), static_cast<int>(global / n)});
    return k != none && is_own(k) ? k : none;
  }

  std::size_t
  FlowLattice::start_of(const std::size_t k, const std::uint8_t number) const
  {
    Place      end          = place_of(k);
    const bool is_on_parent = number >= into_window;
    if (is_on_parent)
      end = levels.parent_of(end);
    const auto [da, db] = directions[is_on_parent ? number - into_window : number];
    return global_number(levels.finest({end.level, end.along - da, end.across - db}));
  }

  std::vector<std::size_t>
  FlowLattice::points_at(const OutlineKind kind) const
  {
    const bool               outlet = kind == OutlineKind::outlet;
    std::vector<std::size_t> points;
    if (region != nullptr)
      {
        for (std::size_t k = 0; k < levels.n_on_grid; ++k)
          if (outlet ? region->is_outlet(k) : region->is_inlet(k))
            points.push_back(k);
        return points;
      }
    for (int l = 0; l < levels.size(); ++l)
      {
        const Level &level = levels[l];
        if (!(outlet ? level.ends_at_outlet : level.begins_at_inlet))
          continue;
        const int along = outlet ? level.n_along - 1 - level.rim() : level.rim();
        for (int across = level.rim(); across < level.n_across - level.rim(); ++across)
          if (const std::size_t k = number_of({l, along, across});
              k != none && is_own(k) && (is_covered.empty() || !is_covered[k]))
            points.push_back(k);
      }
    return points;
  }
} // namespace strait
