// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <array>
#include <vector>

namespace strait
{
  /**
   * A set of windows that are added, moved and joined such that they lie as ZoomWindow
   * asks: within their parents, and apart from each other. Each has a place that does not
   * depend on its parent; parents are found anew in the end.
   */
  class WindowArrangement
  {
  public:
    /** Begin with the windows of @p layout, which must outlive this object. Those that
     *  are not used (@p is_used) make room for others. */
    WindowArrangement(const SlabLayout &layout, const std::vector<bool> &is_used);

    /** Return the level of the coarsest window whose rim is too near to @p point of the
     *  layout, 0 if there is none. Between point and rim there must be @p points of the
     *  point's level, and a margin around each window in its parent. */
    int level_with_close_rim(GridPoint point, double points) const;

    /** Add a window of @p level around @p centre, a point of the layout. Returns false if
     *  there is no room for it or if it was there already. */
    bool open(int level, const GridPoint &centre);

    /** Return all windows that have a parent to lie in. */
    std::vector<ZoomWindow> windows();

  private:
    using Place = std::array<long, 2>; // x and y

    /** A window, by its place on the lattice that the points of its parent's level would
     *  form in the whole box. */
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
