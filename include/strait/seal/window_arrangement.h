// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <array>
#include <vector>

namespace strait
{
  /**
   * Windows that are moved, joined and added to until they lie as ZoomWindow asks: within
   * their parents, and apart from each other. They have places that do not depend on
   * their parents, which are found anew.
   */
  class WindowArrangement
  {
  public:
    /** Of the windows of @p layout, which must outlive this object; those that are not
     *  used make room for others. */
    WindowArrangement(const SlabLayout &layout, const std::vector<bool> &is_used);

    /** The level of the coarsest window whose rim is too near to @p point of the layout,
     *  for @p points of its level are to lie between, and a margin around each window in
     *  its parent; 0 if there is none. */
    int narrow_level(GridPoint point, double points) const;

    /** Add a window of @p level around @p centre, a point of the layout. Returns whether
     *  there is room for it and it was not there. */
    bool open(int level, const GridPoint &centre);

    /** All that have a parent to lie in. */
    std::vector<ZoomWindow> windows();

  private:
    using Place = std::array<long, 2>; // x and y

    /** A window by its place on the lattice that the points of its parent's level would
     *  make of the whole box. */
    struct Placed
    {
      int                level;
      Place              first;
      std::array<int, 2> n;
      bool               is_used;

      /** The same on the lattice of its own points. */
      Placed refined() const;
    };

    Place place_of(const GridPoint &point, int level) const;
    long  period(int level, int d) const;
    long  offset(const Placed &a, const Placed &b, int d) const;
    bool  touch(const Placed &a, const Placed &b) const;
    bool  join(Placed &window, const Placed &other) const;
    bool  add(Placed window, std::vector<Placed> &others) const;
    int   find_parent(const std::vector<Placed> &candidates, Placed &window) const;

    const SlabLayout   &layout;
    std::vector<Placed> placed;
  };
} // namespace strait
