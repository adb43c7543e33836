// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_flow_lattice_h
#define strait_percolation_flow_lattice_h

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace strait
{
  /** A grid point; along the flow, index n stands for the outlet's copy of 0. Or a point
   *  of a window. */
  struct GridPoint
  {
    int ix     = 0;
    int iy     = 0;
    int window = -1; // −1: the grid

    bool
    operator==(const GridPoint &other) const
    {
      return ix == other.ix && iy == other.iy && window == other.window;
    }
  };

  /**
   * Values at grid points, turned so that the flow runs along the fast index, with
   * the outlet's copy of the seam appended: width() = n_along + 1 points along the
   * flow, periodic across it. Of a region the lattice is that of FlowRegion, x along,
   * with zero at what does not belong to it. For searches on one rank.
   *
   * The points of windows may follow, turned alike. A point that a window covers is then
   * the coinciding point of that: its own number carries the same value, but steps never
   * lead there. The neighbours are those of find_clusters().
   */
  class FlowLattice
  {
  public:
    /** @p whole holds the values of the whole @p grid, row by row. */
    FlowLattice(const std::vector<double> &whole,
                const PeriodicGrid        &grid,
                const FlowDomain          &domain);

    /** With the windows of @p field, of whose grid @p whole holds the values. */
    FlowLattice(const std::vector<double> &whole,
                const SlabField           &field,
                const FlowDomain          &domain);

    /** Number of the grid's points along the flow. */
    int
    width() const
    {
      return levels.front().n_along;
    }

    int
    n_across() const
    {
      return levels.front().n_across;
    }

    /** Number of points of all levels. */
    std::size_t
    size() const
    {
      return values.size();
    }

    /** Number of the grid's point @p a along and @p b across; b wraps around once. */
    std::size_t
    index(const int a, const int b) const
    {
      return static_cast<std::size_t>((b + n_across()) % n_across()) * width() + a;
    }

    /** Column of the grid's point @p k, counted from the inlet. */
    int
    along(const std::size_t k) const
    {
      return static_cast<int>(k % width());
    }

    /** Row of the grid's point @p k, across the flow. */
    int
    across_of(const std::size_t k) const
    {
      return static_cast<int>(k / width());
    }

    /** Whether the first line of points along the flow follows the last. */
    bool
    is_periodic() const
    {
      return region == nullptr;
    }

    /** Whether point @p k belongs to where the fluid flows. */
    bool
    is_point(const std::size_t k) const
    {
      return region == nullptr || region->is_point(k);
    }

    /** Whether the fluid leaves at point @p k. */
    bool
    is_outlet(const std::size_t k) const
    {
      if (region != nullptr)
        return region->is_outlet(k);
      if (k < n_on_grid)
        return along(k) == width() - 1;
      const Place p = place_of(k);
      return levels[p.level].ends_at_outlet && p.along == levels[p.level].n_along - 2;
    }

    /** The points where the fluid enters. */
    std::vector<std::size_t> inlet_points() const;

    /** From a point to one of the eight around it on the same level. */
    struct Step
    {
      std::size_t  from, to; // its ends on that level
      std::size_t  point;    // where it leads: `to`, or the point of a window that it is
      double       length;   // of the way
      int          d_along;  // −1, 0 or 1
      int          d_across; // likewise
      std::uint8_t number = 0; // tells, with `point`, where it began: start_of()
    };

    /**
     * Call action(step) for the steps from point @p k to the first @p n_directions of the
     * four nearest and the four diagonal points. A diagonal one leads to no other level
     * and, of a region, needs a way around a corner.
     */
    template <class Action>
    void
    for_each_step(const std::size_t k, const int n_directions, const Action &action) const
    {
      const int level = level_of(k);
      visit_steps(level, k, n_directions, action);
      if (level > 0)
        if (const std::size_t on_parent = on_parent_of_rim(level, k); on_parent != none)
          visit_steps(levels[level].parent, on_parent, 4, action);
    }

    /** The point of the finest level that point @p k is. */
    std::size_t
    finest(std::size_t k) const
    {
      while (!is_covered.empty() && is_covered[k])
        k = finer(k);
      return k;
    }

    /** Where the step @p number that led to point @p k began. */
    std::size_t start_of(std::size_t k, std::uint8_t number) const;

    /** Whether the two steps along and across that make up a diagonal one are possible,
     *  that along first if @p first_along. */
    bool
    can_go_around(const Step &step, const bool first_along) const
    {
      return region == nullptr ||
             can_go_around(step.from, step.d_along, step.d_across, first_along);
    }

    /** The point of the grid that stands for point @p k. */
    std::size_t on_grid(std::size_t k) const;

    /** The points of the grid within @p reach spacings from its point @p k, each way, and
     *  the points of windows that these stand for. */
    std::vector<std::size_t> points_around(std::size_t k, int reach) const;

    double
    operator[](const std::size_t k) const
    {
      return values[k];
    }

    /** The point of the grid or a window that is point @p k of the lattice. */
    GridPoint point(std::size_t k) const;

    /** Its inverse. */
    std::size_t index_of(const GridPoint &p) const;

  private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    static constexpr std::array<std::array<int, 2>, 8> directions = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

    // Added to the number of a step whose end is named by a point of a finer level.
    static constexpr std::uint8_t into_window = 8;

    /** The grid, or a window. */
    struct Level
    {
      std::size_t           begin; // number of its first point
      int                   n_along;
      int                   n_across;
      std::array<double, 3> lengths; // of steps along, across and diagonally
      int                   parent;  // its level, and the first of its points that the
      int                   along;   // window covers
      int                   across;

      // Of a window across the seam there are two parts: that on the side of the outlet,
      // which ends with the outlet's copy of the seam, and that which begins with it.
      int  window          = -1;
      int  first           = 0; // its first column, along the flow, in the window
      bool begins_at_inlet = false;
      bool ends_at_outlet  = false;
    };

    /** A point by its level, column and row. */
    struct Place
    {
      int level;
      int along;
      int across;
    };

    /** Columns of a window, along the flow: all, or those on one side of the seam. */
    struct Part
    {
      int  first;
      int  last;
      bool begins_at_inlet;
      bool ends_at_outlet;
    };

    void add_window(const SlabField &field, int w);
    void add_part(const SlabField &field, int w, const Part &part);

    /** The level with column @p along of a window, −1 for the grid; of a column on the
     *  seam the copy at the outlet if @p of_outlet, else that at the inlet. */
    int level_with(int window, int along, bool of_outlet) const;

    int
    level_of(const std::size_t k) const
    {
      int level = 0;
      if (k >= n_on_grid)
        for (level = static_cast<int>(levels.size()) - 1; k < levels[level].begin;)
          --level;
      return level;
    }

    Place
    place_of(const std::size_t k) const
    {
      const int         level = level_of(k);
      const std::size_t i     = k - levels[level].begin;
      const int         n     = levels[level].n_along;
      return {level, static_cast<int>(i % n), static_cast<int>(i / n)};
    }

    std::size_t
    number_of(const Place &p) const
    {
      const Level &level = levels[p.level];
      return p.level == 0
               ? index(p.along, p.across)
               : level.begin + static_cast<std::size_t>(p.across) * level.n_along +
                   p.along;
    }

    /** The point of the next finer level that point @p k is, if a window covers it. */
    std::size_t finer(std::size_t k) const;

    /** The parent's point that point @p k of a window is, if it lies on the rim of what
     *  the window covers. */
    std::size_t on_parent_of_rim(int level, std::size_t k) const;

    /** The point of the parent that stands for a point of a window. */
    Place on_parent(const Place &p) const;

    template <class Action>
    void visit_steps(int           level,
                     std::size_t   from,
                     int           n_directions,
                     const Action &action) const;

    bool can_step_in_region(std::size_t k, int d_along, int d_across) const;

    bool can_go_around(std::size_t k, int d_along, int d_across, bool first_along) const;

    std::shared_ptr<const FlowRegion> region; // null: the box
    bool                              along_x;
    std::vector<Level>                levels; // the grid, then the windows
    std::size_t                       n_on_grid;
    std::vector<double>               values;
    std::vector<bool>                 is_covered; // empty without windows
  };

  template <class Action>
  void
  FlowLattice::visit_steps(const int         l,
                           const std::size_t from,
                           const int         n_directions,
                           const Action     &action) const
  {
    const Level &level = levels[l];
    const auto   i     = from - level.begin;
    const int    a     = static_cast<int>(i % level.n_along);
    const int    b     = static_cast<int>(i / level.n_along);
    // The outermost points of a window are there for interpolation only.
    const int  rim            = l == 0 ? 0 : 1;
    const bool from_is_finest = is_covered.empty() || !is_covered[from];
    for (int d = 0; d < n_directions; ++d)
      {
        const auto [da, db] = directions[d];
        if (a + da < rim || a + da >= level.n_along - rim ||
            (rim > 0 && (b + db < rim || b + db >= level.n_across - rim)) ||
            (region != nullptr && !can_step_in_region(from, da, db)))
          continue;
        const std::size_t to    = number_of({l, a + da, b + db});
        const std::size_t point = finest(to);
        // Between two points that a window covers its own, finer steps lead.
        if (point != to && (d >= 4 || !from_is_finest))
          continue;
        const int kind   = d < 2 ? 0 : d < 4 ? 1 : 2;
        const int number = point == to ? d : d + into_window;
        action(Step{from,
                    to,
                    point,
                    level.lengths[kind],
                    da,
                    db,
                    static_cast<std::uint8_t>(number)});
      }
  }
} // namespace strait

#endif
