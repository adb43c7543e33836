// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>
#include <strait/spectral/periodic_grid.h>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * How far a point may be from the line or circle on which it is taken to lie, relative
   * to the grid spacing, or to the length or radius: files give six digits or more. Half
   * of it no longer finds circles that are written with six digits; double of it rounds
   * off outlines that are polygons.
   */
  constexpr double precision_of_meshes = 1e-6;

  /** The kinds of boundary at the outline of a region, in the order of the boundary ids
   *  of a mesh. */
  enum class OutlineKind : std::uint8_t
  {
    inlet,
    outlet,
    right_wall, // seen along the flow
    left_wall
  };

  /** A straight piece of the outline of a region, in the scene's unit of length. */
  struct OutlineEdge
  {
    double      x0 = 0., y0 = 0., x1 = 0., y1 = 0.;
    OutlineKind kind = OutlineKind::right_wall;
  };

  /**
   * The part of the contact grid that lies in a region of the box, as the fluid sees
   * it: a lattice of (nx + 1) × (ny + 1) points, the last ones being copies across the
   * periodic seam, which the fluid does not cross. Point (ix, iy) has the number
   * iy·(nx + 1) + ix.
   *
   * Points on the outline count as inside. Two neighbours are joined if both of them and
   * the midpoint between them lie inside. The fluid enters at the points on the inlet,
   * and at points outside from which a step to a neighbour inside crosses the inlet: they
   * belong to the lattice, joined to such neighbours alone. Likewise for the outlet.
   */
  class FlowRegion
  {
  public:
    /**
     * Make the region that the closed curves of @p outline, within the box, enclose. Only
     * rank 0 of @p comm holds its points: 1 B per grid point, and 4 B more while it is
     * made. Throws InputError if the grid is too coarse: if a point is at both inlet and
     * outlet, or none is at one of them. Collective.
     */
    FlowRegion(const PeriodicGrid             &grid,
               const std::vector<OutlineEdge> &outline,
               MPI_Comm                        comm = MPI_COMM_SELF);

    /** Number of lattice points, including those outside; 0 on ranks other than 0. */
    std::size_t
    size() const
    {
      return flags.size();
    }

    /** Whether point @p k lies inside the outline. */
    bool
    is_inside(const std::size_t k) const
    {
      return (flags[k] & inside) != 0;
    }

    /** Whether the fluid enters at point @p k. */
    bool
    is_inlet(const std::size_t k) const
    {
      return (flags[k] & at_inlet) != 0;
    }

    /** Whether the fluid leaves at point @p k. */
    bool
    is_outlet(const std::size_t k) const
    {
      return (flags[k] & at_outlet) != 0;
    }

    /** Whether the fluid can pass point @p k: it is inside, or at inlet or outlet. */
    bool
    is_point(const std::size_t k) const
    {
      return (flags[k] & (inside | at_inlet | at_outlet)) != 0;
    }

    /** Whether point @p k is joined to its neighbour at (@p dx, @p dy), one of which is
     *  ±1 and the other 0. */
    bool is_joined(std::size_t k, int dx, int dy) const;

    /** Number of grid points inside, without copies; the same on all ranks. */
    long long
    n_inside() const
    {
      return n_points_inside;
    }

  private:
    static constexpr std::uint8_t inside = 1, at_inlet = 2, at_outlet = 4, right = 8,
                                  up = 16;

    void find_points(const PeriodicGrid &grid, const std::vector<OutlineEdge> &outline);

    int                       width;
    std::vector<std::uint8_t> flags;
    long long                 n_points_inside = 0;
  };

  /** Where the fluid flows: from side to side of the box, which is periodic across the
   *  flow, or from inlet to outlet of a region of it. */
  struct FlowDomain
  {
    FlowDomain(const FlowDirection direction_) // of the whole box
      : direction(direction_)
    {
    }

    FlowDomain(std::shared_ptr<const FlowRegion> region_)
      : region(std::move(region_))
    {
    }

    FlowDirection                     direction = FlowDirection::x;
    std::shared_ptr<const FlowRegion> region; // null: the whole box
  };
} // namespace strait
