// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/flow/bottleneck_width.h>
#include <strait/flow/critical_cells.h>
#include <strait/flow/throat_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace strait
{
  namespace
  {
    // Fractions of the whole at which a cell counts as too coarse. Half of them makes a
    // finer start, which costs more than it saves; measured on rough gaps. Double of them
    // leaves more of the throats and barriers to be found by refinement.
    constexpr double short_cut_fraction = .05;
    constexpr double blocking_fraction  = .1;

    /** What is known of a cell from its grid points. */
    struct Cell
    {
      float lowest       = 2.F; // estimate of the pressure at its open points …
      float highest      = -1.F;
      float mean_cubed   = 0.F; // … mean of (g/g0)³ with the first bottleneck g0 …
      float mean_inverse = 0.F; // … and of its inverse, infinite at a closed point

      void
      add_child(const Cell &child)
      {
        lowest  = std::min(lowest, child.lowest);
        highest = std::max(highest, child.highest);
        mean_cubed += .25F * child.mean_cubed;
        mean_inverse += .25F * child.mean_inverse;
      }
    };

    Cell
    cell_of_point(const double gap_in_bottlenecks, const float pressure)
    {
      Cell cell;
      cell.mean_inverse  = std::numeric_limits<float>::infinity();
      const double cubed = std::pow(gap_in_bottlenecks, 3);
      if (gap_in_bottlenecks > 0)
        {
          cell.lowest = cell.highest = pressure;
          cell.mean_cubed            = static_cast<float>(cubed);
          cell.mean_inverse          = static_cast<float>(1. / cubed);
        }
      return cell;
    }

    /** All cells of one size, fast along the flow. */
    struct Level
    {
      Level(const int along, const int across)
        : n_along(along)
        , n_across(across)
        , cells(static_cast<std::size_t>(along) * across)
      {
      }

      Cell &
      at(const int a, const int b)
      {
        return cells[static_cast<std::size_t>((b + n_across) % n_across) * n_along + a];
      }

      /** Range of the pressure over the cell and its eight neighbours. */
      double
      pressure_range(const int a, const int b)
      {
        float lowest = at(a, b).lowest, highest = at(a, b).highest;
        for (int j = b - 1; j <= b + 1; ++j)
          for (int i = std::max(a - 1, 0); i <= std::min(a + 1, n_along - 1); ++i)
            {
              lowest  = std::min(lowest, at(i, j).lowest);
              highest = std::max(highest, at(i, j).highest);
            }
        return highest - lowest;
      }

      int               n_along;
      int               n_across;
      std::vector<Cell> cells;
    };

    /** The path by points of the grid, those that stand for the points of windows. */
    FlowPath
    on_grid(FlowPath path, const SlabLayout &layout)
    {
      for (GridPoint &point : path.points)
        if (point.window >= 0)
          {
            while (point.window >= 0)
              {
                const ZoomWindow &window = layout.windows()[point.window];
                point = {window.x + point.ix / 3, window.y + point.iy / 3, window.parent};
              }
            const int nx = layout.grid().nx, ny = layout.grid().ny;
            point = {(point.ix + nx) % nx, (point.iy + ny) % ny};
          }
      return path;
    }

    /** The search proper, from coarse cells to fine ones. */
    class CellSearch
    {
    public:
      using Cells = std::set<std::pair<int, int>>; // along, across

      CellSearch(const Channel     &channel,
                 const FlowLattice &lattice,
                 const int          largest_exponent)
        : gap(lattice)
      {
        for (const FlowPath &path : channel.paths)
          paths.push_back(on_grid(path, channel.gap.layout()));
        const std::vector<float> pressure   = estimate_pressure(gap, paths.front());
        const double             bottleneck = paths.front().bottleneck_gap;
        const int                n_along    = gap.width() - 1;
        const int                n_across = gap.n_across() - (gap.is_periodic() ? 0 : 1);
        for (int e = 1; e <= largest_exponent; ++e)
          levels.emplace_back(n_along >> e, n_across >> e);
        for (int b = 0; b < n_across; ++b)
          for (int a = 0; a < n_along; ++a)
            {
              const std::size_t k = gap.index(a, b);
              levels[0]
                .at(a >> 1, b >> 1)
                .add_child(cell_of_point(gap[k] / bottleneck, pressure[k]));
            }
        for (std::size_t e = 1; e < levels.size(); ++e)
          for (int b = 0; b < levels[e - 1].n_across; ++b)
            for (int a = 0; a < levels[e - 1].n_along; ++a)
              levels[e].at(a >> 1, b >> 1).add_child(levels[e - 1].at(a, b));
        // What each path would let through on its own. If the first is in no channel, the
        // flow is as wide as the box; another one may run beside the first in the same
        // channel, and counts for little.
        const double spacing = std::min(gap.spacing_along(), gap.spacing_across());
        for (const FlowPath &path : channel.paths)
          {
            const double otherwise = spacing * (conductances.empty() ? n_across : 1.);
            conductances.push_back(bottleneck_width(channel.gap, gap, path, otherwise) /
                                   path.resistance() / std::pow(bottleneck, 3));
          }
      }

      /** The cells of each exponent, from 1, that are too coarse. */
      std::vector<Cells>
      run(const double short_cut)
      {
        std::vector<Cells> result(levels.size());
        for (int e = static_cast<int>(levels.size()); e >= 1; --e)
          {
            Cells &here = result[e - 1];
            if (e == static_cast<int>(levels.size()))
              for (int b = 0; b < levels.back().n_across; ++b)
                for (int a = 0; a < levels.back().n_along; ++a)
                  add_if_short_cut(e, a, b, short_cut, here);
            else
              for (const auto &[a, b] : result[e])
                for (int child = 0; child < 4; ++child)
                  add_if_short_cut(
                    e, 2 * a + child % 2, 2 * b + child / 2, short_cut, here);
            add_blocking(e, here);
          }
        return result;
      }

    private:
      void
      add_if_short_cut(const int    e,
                       const int    a,
                       const int    b,
                       const double fraction,
                       Cells       &result)
      {
        Level       &level = levels[e - 1];
        const double cubed = level.at(a, b).mean_cubed;
        if (!(cubed > 0))
          return;
        const double range = level.pressure_range(a, b);
        if (cubed * range * range > fraction * conductances.front())
          result.emplace(a, b);
      }

      void
      add_blocking(const int e, Cells &result)
      {
        Level &level = levels[e - 1];
        for (std::size_t p = 0; p < paths.size(); ++p)
          for (const GridPoint &point : paths[p].points)
            {
              const std::size_t k = gap.index_of(point);
              const int         a = std::min(gap.along(k) >> e, level.n_along - 1);
              const int         b = std::min(gap.across_of(k) >> e, level.n_across - 1);
              if (!(level.at(a, b).mean_inverse * conductances[p] > blocking_fraction))
                continue;
              const int last = std::min(a + 1, level.n_along - 1);
              for (int i = std::max(a - 1, 0); i <= last; ++i)
                for (int j = b - 1; j <= b + 1; ++j)
                  if (gap.is_periodic() || (j >= 0 && j < level.n_across))
                    result.emplace(i, (j + level.n_across) % level.n_across);
            }
      }

      const FlowLattice    &gap;
      std::vector<FlowPath> paths;        // by points of the grid
      std::vector<Level>    levels;       // levels[e − 1] has cells of exponent e
      std::vector<double>   conductances; // of the paths, in units of g0³Δp/(12 η)
    };

    /** Those told from the grid. */
    std::vector<GridCell>
    find_on_lattice(const Channel     &channel,
                    const FlowLattice &gap,
                    const int          largest_exponent)
    {
      if (largest_exponent < 1)
        return {};
      // Without contact there is no barrier, and the widest way says nothing about the
      // pressure: coarse cells do, and the bracket tells where they do not.
      bool has_contact = false;
      for (std::size_t k = 0; k < gap.size() && !has_contact; ++k)
        has_contact = gap.is_point(k) && !(gap[k] > 0);
      if (!has_contact)
        return {};
      // At low loads many channels share the flow, and the one path that is known
      // makes the leak rate's estimate far too small: the start then takes at most a cell
      // for 256 points. Half as many leave more to refinement, twice as many refine cells
      // for a path that carries little of the flow.
      const std::size_t most     = std::max<std::size_t>(gap.size() / 256, 1000);
      double            fraction = short_cut_fraction;
      CellSearch        search(channel, gap, largest_exponent);
      while (true)
        {
          const std::vector<CellSearch::Cells> found = search.run(fraction);
          std::vector<GridCell>                cells;
          for (std::size_t e = 0; e < found.size(); ++e)
            for (const auto &[a, b] : found[e])
              cells.push_back(channel.domain.direction == FlowDirection::x
                                ? GridCell{static_cast<int>(e) + 1, a, b}
                                : GridCell{static_cast<int>(e) + 1, b, a});
          if (cells.size() <= most || fraction > 1e3)
            return cells;
          fraction *= 4.;
        }
    }
  } // namespace

  int
  largest_start_exponent(const PeriodicGrid &grid)
  {
    int exponent = std::min(grid.n_halvings(), 6);
    while (exponent > 0 && std::min(grid.nx, grid.ny) >> exponent < 8)
      --exponent;
    return exponent;
  }

  std::vector<GridCell>
  find_critical_cells(const Channel &channel)
  {
    std::vector<GridCell> cells;
    if (channel.paths.empty())
      return cells;
    MPI_Comm                  comm  = channel.gap.layout().communicator();
    const PeriodicGrid       &grid  = channel.gap.grid();
    const std::vector<double> whole = gather_on_root(channel.gap);
    run_on_root(comm, [&]() {
      cells = find_on_lattice(channel,
                              FlowLattice(whole, grid, channel.domain),
                              largest_start_exponent(grid));
    });
    auto n_cells = static_cast<int>(cells.size());
    MPI_Bcast(&n_cells, 1, MPI_INT, 0, comm);
    cells.resize(n_cells);
    static_assert(sizeof(GridCell) == 3 * sizeof(int));
    MPI_Bcast(cells.data(), 3 * n_cells, MPI_INT, 0, comm);
    const std::set<GridCell> in_windows =
      cells_around_throats(channel, largest_start_exponent(grid));
    cells.insert(cells.end(), in_windows.begin(), in_windows.end());
    std::sort(cells.begin(), cells.end());
    return cells;
  }
} // namespace strait
