// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_local_clusters_h
#define strait_percolation_local_clusters_h

#include <strait/base/fluid_parameters.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace strait
{
  /** Union–find over 0 … n−1; the smallest member of a set is its root. */
  class DisjointSets
  {
  public:
    explicit DisjointSets(const std::size_t n)
      : parent(n)
    {
      std::iota(parent.begin(), parent.end(), std::size_t(0));
    }

    /** The root of the set of @p a. */
    std::size_t
    find(std::size_t a)
    {
      while (parent[a] != a)
        a = parent[a] = parent[parent[a]];
      return a;
    }

    /** Make the sets of @p a and @p b one. */
    void
    join(const std::size_t a, const std::size_t b)
    {
      const std::size_t root_a = find(a), root_b = find(b);
      parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
    }

  private:
    std::vector<std::size_t> parent;
  };

  /** The window that covers each point of row @p row of window @p parent, −1 for the
   *  grid; −1 for none. */
  std::vector<int> covering_windows(const SlabLayout &layout, int parent, int row);

  /** Whether two neighbours lie in the same window, whose finer edges then stand for that
   *  between them; the arguments are their entries of covering_windows(). */
  inline bool
  is_refined(const int window, const int window_of_neighbour)
  {
    return window >= 0 && window == window_of_neighbour;
  }

  /** Join the neighbours among the open points of this rank's slab, and among those of
   * the windows, but none of the former with the latter. The rule is find_clusters()'s.
   */
  DisjointSets join_open_points(const SlabField &gap, FlowDirection direction);

  /** A point of a window on the first line of the grid along the flow, where the fluid
   *  enters; and that behind it, across the seam, where it leaves, if an edge of the
   *  window leads there. Positions among the values of a rank. */
  struct SeamPoint
  {
    std::size_t                point;
    std::optional<std::size_t> behind;
  };

  /** All of them, parents before their windows. */
  std::vector<SeamPoint> seam_points(const SlabLayout &layout, FlowDirection direction);
} // namespace strait

#endif
