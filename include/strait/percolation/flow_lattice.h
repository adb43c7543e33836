// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/lattice_levels.h>
#include <strait/spectral/slab_field.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace strait
{
  /**
   * Values at grid points as a search along the flow sees them: the seam is cut, and the
   * outlet's copy of it appended; across the flow the grid is periodic. Neighbours are
   * those of find_clusters().
   *
   * Rank 0 owns the points of windows. A point that a window covers is represented by the
   * window's coinciding point: its own number has the same value, but no step goes there.
   */
  class FlowLattice
  {
  public:
    /** Take the values of @p field, including its windows. Collective. */
    FlowLattice(const SlabField &field, const FlowDomain &domain);

    const SlabLayoutPtr layout;
    const LatticeLevels levels;
    const MPI_Comm      communicator;

    /** Number of points that this rank knows, on all levels. */
    std::size_t
    size() const
    {
      return values.size();
    }

    double
    operator[](const std::size_t k) const
    {
      return values[k];
    }

    /** Whether point @p k belongs to a window. */
    bool
    in_window(const std::size_t k) const
    {
      return k >= levels.n_on_grid;
    }

    /** Whether this rank owns point @p k: neither a ghost nor a point of another rank. */
    bool
    is_own(const std::size_t k) const
    {
      return in_window(k) ? layout->rank() == 0
                          : k >= levels.first_own && k < levels.end_own;
    }

    /** Whether the fluid leaves at point @p k. */
    bool is_outlet(std::size_t k) const;

    /** Whether point @p k is the outlet's copy of a point on the seam. */
    bool
    is_copy(const std::size_t k) const
    {
      return region == nullptr && is_outlet(k);
    }

    /** This rank's own points at the inlet, or at the outlet. */
    std::vector<std::size_t> points_at(OutlineKind kind) const;

    /** A step from a point to one of its eight neighbours on the same level. */
    struct Step
    {
      std::size_t from, to;         // its ends on that level
      std::size_t point;            // where it leads: `to`, or the window's point there
      std::size_t corner, corner_2; // beside a diagonal step; none if no way leads there
      double      length;           // distance from `from` to `to`

      std::uint8_t number; // with `point`, tells where the step began: start_of()
    };

    static constexpr std::size_t none = LatticeLevels::none;

    /**
     * Call action(step) for the steps from point @p k in the first @p n_directions of
     * these: to the next points along and across the flow, to the previous ones, and to
     * the four diagonal ones, as far as this rank knows them. A diagonal step leads to no
     * other level and, in a region, needs a way around a corner.
     */
    template <class Action>
    void
    for_each_step(const std::size_t k, const int n_directions, const Action &action) const
    {
      const Place p = place_of(k);
      visit_steps(p, k, n_directions, action);
      // From the rim of a window, the parent's coinciding point leads on outside.
      if (p.level > 0 && levels.is_on_rim(p))
        for_each_copy(levels.parent_of(p), [&](const std::size_t on_parent) {
          visit_steps(place_of(on_parent), on_parent, 4, action);
        });
    }

    /** The number of point @p k that is the same on all ranks. */
    std::size_t
    global_number(const std::size_t k) const
    {
      return global_number(place_of(k));
    }

    /** The inverse of global_number(); none if this rank does not own the point. */
    std::size_t own_number(std::size_t global) const;

    /** The global number of the point from which the step @p number led to point @p k. */
    std::size_t start_of(std::size_t k, std::uint8_t number) const;

    /** Call action(k, value) for each ghost k, with the value that its owner has for that
     *  point in @p values, one per point. Collective. */
    template <class Number, class Action>
    void
    for_each_ghost(const std::vector<Number> &values, const Action &action) const
    {
      std::vector<int> ghosts;
      for (const int line : {levels.first, levels.end - 1})
        if (const std::size_t k = levels.number_of(line, 0);
            k != LatticeLevels::none && !is_own(k))
          ghosts.push_back(line);
      const std::vector<Number> theirs =
        fetch_rows(*layout, values.data() + levels.first_own, levels.length, ghosts);
      for (std::size_t i = 0; i < theirs.size(); ++i)
        action(levels.number_of(ghosts[i / levels.length], i % levels.length), theirs[i]);
    }

    /** Point @p k of the lattice as a point of the grid or of a window. */
    GridPoint
    point(const std::size_t k) const
    {
      return levels.point(place_of(k));
    }

    /** The number of point @p p of the grid or a window: on the seam, that at the inlet;
     *  on several levels, that on the finest; none if this rank does not know it. */
    std::size_t number_at(const GridPoint &p) const;

  private:
    using Level = LatticeLevels::Level;
    using Place = LatticeLevels::Place;

    static constexpr std::array<std::array<int, 2>, 8> directions = {
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

    // Added to the number of a step that leads to the window's point instead of `to`.
    static constexpr std::uint8_t into_window = 8;

    Place
    place_of(const std::size_t k) const
    {
      const int level = levels.level_of(k);
      if (level == 0)
        {
          const std::size_t from_first = levels.line_of(k);
          const int         line       = levels.first + static_cast<int>(from_first);
          const int         i          = static_cast<int>(k - from_first * levels.length);
          return levels.along_x ? Place{0, i, line} : Place{0, line, i};
        }
      const std::size_t i = k - levels[level].begin;
      const int         n = levels[level].n_along;
      return {level, static_cast<int>(i % n), static_cast<int>(i / n)};
    }

    /** The values of @p field at the points of the grid; zero at those that do not belong
     *  to the region. Collective. */
    std::vector<double> values_on_grid(const SlabField &field) const;

    std::size_t global_number(const Place &p) const;

    /** The number of point @p p; none if this rank does not know it. */
    std::size_t number_of(const Place &p) const;

    /** Call visit(k) for all numbers of point @p p on this rank: one of its own lines may
     *  be a ghost as well. */
    template <class Visit>
    void
    for_each_copy(const Place &p, const Visit &visit) const
    {
      const Level &level = levels[p.level];
      if (p.level > 0)
        visit(level.begin + static_cast<std::size_t>(p.across) * level.n_along + p.along);
      else
        for (const int periods : {0, -1, 1})
          {
            const int across = levels.wrapped(p.across) + periods * level.n_across;
            if (const std::size_t k = levels.along_x ? levels.number_of(across, p.along)
                                                     : levels.number_of(p.along, across);
                k != none)
              visit(k);
          }
    }

    std::size_t
    finest(const std::size_t k) const
    {
      const bool is_finest = k == none || is_covered.empty() || !is_covered[k];
      return is_finest ? k : number_of(levels.finest(place_of(k)));
    }

    template <class Action>
    void visit_steps(const Place  &p,
                     std::size_t   from,
                     int           n_directions,
                     const Action &action) const;

    std::shared_ptr<const FlowRegion> region; // null: the whole box
    std::vector<double>               values;
    std::vector<bool>                 is_covered; // empty without windows
  };

  template <class Action>
  void
  FlowLattice::visit_steps(const Place      &p,
                           const std::size_t from,
                           const int         n_directions,
                           const Action     &action) const
  {
    const Level &level          = levels[p.level];
    const int    rim            = level.rim();
    const bool   from_is_finest = is_covered.empty() || !is_covered[from];
    // Across the flow, lines wrap around through their ghosts, points of a line here.
    const bool wraps       = p.level == 0 && !levels.along_x;
    const int  first       = p.level > 0 ? rim : levels.first;
    const int  end         = p.level > 0 ? level.n_across - rim : levels.end;
    const int  first_along = wraps ? levels.first : rim;
    const int  end_along   = wraps ? levels.end : level.n_along - rim;
    for (int d = 0; d < n_directions; ++d)
      {
        const auto [da, db] = directions[d];
        const int a = p.along + da, b = p.across + db;
        if (a < first_along || a >= end_along || (!wraps && (b < first || b >= end)))
          continue;
        std::ptrdiff_t across = db * level.across_by;
        if (wraps && b < 0)
          across += level.n_across;
        else if (wraps && b == level.n_across)
          across -= level.n_across;
        const std::ptrdiff_t along  = da * level.along_by;
        std::size_t          corner = d < 4 ? none : from + along;
        std::size_t          other  = d < 4 ? none : from + across;
        if (region != nullptr && d < 4 && !region->is_joined(from, da, db))
          continue;
        if (region != nullptr && d >= 4)
          {
            if (!region->is_joined(from, da, 0) || !region->is_joined(corner, 0, db))
              corner = none;
            if (!region->is_joined(from, 0, db) || !region->is_joined(other, da, 0))
              other = none;
            if (corner == none && other == none)
              continue;
          }
        const std::size_t to    = from + along + across;
        const std::size_t point = finest(to);
        // Two points that a window covers are joined by its own, finer steps.
        if (point != to && (d >= 4 || !from_is_finest))
          continue;
        const int kind   = d < 4 ? d % 2 : 2;
        const int number = point == to ? d : d + into_window;
        action(Step{from,
                    to,
                    point,
                    corner,
                    other,
                    level.lengths[kind],
                    static_cast<std::uint8_t>(number)});
      }
  }
} // namespace strait
