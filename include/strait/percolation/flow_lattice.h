// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_flow_lattice_h
#define strait_percolation_flow_lattice_h

#include <strait/base/fluid_parameters.h>
#include <strait/spectral/periodic_grid.h>

#include <cstddef>
#include <vector>

namespace strait
{
  /** A grid point; along the flow, index n stands for the outlet's copy of 0. */
  struct GridPoint
  {
    int ix = 0;
    int iy = 0;
  };

  /**
   * Values at grid points, turned so that the flow runs along the fast index, with
   * the outlet's copy of the seam appended: width() = n_along + 1 points along the
   * flow, periodic across it. For searches on one rank.
   */
  class FlowLattice
  {
  public:
    /** @p whole holds the values of the whole @p grid, row by row. */
    FlowLattice(const std::vector<double> &whole,
                const PeriodicGrid        &grid,
                FlowDirection              direction);

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
    bool                along_x;
    int                 n_along;
    int                 across;
    double              step_along;
    double              step_across;
    std::vector<double> values;
  };
} // namespace strait

#endif
