// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_flow_lattice_h
#define strait_percolation_flow_lattice_h

#include <strait/percolation/flow_region.h>
#include <strait/spectral/periodic_grid.h>

#include <cstddef>
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
  };

  /**
   * Values at grid points, turned so that the flow runs along the fast index, with
   * the outlet's copy of the seam appended: width() = n_along + 1 points along the
   * flow, periodic across it. Of a region the lattice is that of FlowRegion, x along,
   * with zero at what does not belong to it. For searches on one rank.
   */
  class FlowLattice
  {
  public:
    /** @p whole holds the values of the whole @p grid, row by row. */
    FlowLattice(const std::vector<double> &whole,
                const PeriodicGrid        &grid,
                const FlowDomain          &domain);

    int
    width() const
    {
      return n_along;
    }

    int
    n_across() const
    {
      return across;
    }

    std::size_t
    size() const
    {
      return values.size();
    }

    /** Position of the point @p a along and @p b across; b wraps around once. */
    std::size_t
    index(const int a, const int b) const
    {
      return static_cast<std::size_t>((b + across) % across) * n_along + a;
    }

    /** Column of point @p k, counted from the inlet. */
    int
    along(const std::size_t k) const
    {
      return static_cast<int>(k % n_along);
    }

    /** Row of point @p k, across the flow. */
    int
    across_of(const std::size_t k) const
    {
      return static_cast<int>(k / n_along);
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
      return region == nullptr ? along(k) == n_along - 1 : region->is_outlet(k);
    }

    /** The points where the fluid enters. */
    std::vector<std::size_t> inlet_points() const;

    /**
     * Whether a step of at most one point along and across leads from point @p k to a
     * point of the lattice. A diagonal one needs a way around a corner.
     */
    bool
    can_step(const std::size_t k, const int d_along, const int d_across) const
    {
      const int to = along(k) + d_along;
      return to >= 0 && to < n_along &&
             (region == nullptr || can_step_in_region(k, d_along, d_across));
    }

    /** Whether two steps lead from @p k, first along and then across if
     *  @p first_along, to the diagonal neighbour. */
    bool
    can_go_around(const std::size_t k,
                  const int         d_along,
                  const int         d_across,
                  const bool        first_along) const
    {
      if (region == nullptr)
        return true;
      const int         da = first_along ? d_along : 0, db = first_along ? 0 : d_across;
      const std::size_t corner = index(along(k) + da, across_of(k) + db);
      return region->is_joined(k, da, db) &&
             region->is_joined(corner, d_along - da, d_across - db);
    }

    double
    operator[](const std::size_t k) const
    {
      return values[k];
    }

    /** The point of the grid that is point @p k of the lattice. */
    GridPoint
    point(const std::size_t k) const
    {
      return along_x ? GridPoint{along(k), across_of(k)}
                     : GridPoint{across_of(k), along(k)};
    }

    /** Its inverse. */
    std::size_t
    index_of(const GridPoint &p) const
    {
      return along_x ? index(p.ix, p.iy) : index(p.iy, p.ix);
    }

    double
    spacing_along() const
    {
      return step_along;
    }

    double
    spacing_across() const
    {
      return step_across;
    }

  private:
    bool can_step_in_region(std::size_t k, int d_along, int d_across) const;

    std::shared_ptr<const FlowRegion> region; // null: the box
    bool                              along_x;
    int                               n_along;
    int                               across;
    double                            step_along;
    double                            step_across;
    std::vector<double>               values;
  };
} // namespace strait

#endif
