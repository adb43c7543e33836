// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_grid_lines_h
#define strait_percolation_grid_lines_h

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <array>
#include <cstddef>
#include <vector>

namespace strait
{
  /**
   * The lines of constant y of a grid, with the outlet's copy of the seam, of which a
   * rank owns its rows and knows the line before and the one after them, its ghosts.
   * Across a flow along x lines follow each other periodically; a ghost may then be the
   * rank's own line as well. Of a region rank 0 owns all lines, which are those of
   * FlowRegion.
   */
  class GridLines
  {
  public:
    GridLines(SlabLayoutPtr layout, const FlowDomain &domain);

    /** Number of points of a line. */
    int
    length() const
    {
      return n_along_line;
    }

    /** The first line that this rank knows, −1 for that before line 0. */
    int
    first() const
    {
      return first_line;
    }

    /** The one after the last. */
    int
    end() const
    {
      return first_line + n_lines;
    }

    /** Number of points that this rank knows. */
    std::size_t
    size() const
    {
      return static_cast<std::size_t>(n_lines) * n_along_line;
    }

    /** Whether point @p k is on a line of this rank's own. */
    bool
    is_own(const std::size_t k) const
    {
      return k >= own[0] && k < own[1];
    }

    /** The numbers of this rank's own points: from the first one to before the second. */
    const std::array<std::size_t, 2> &
    own_points() const
    {
      return own;
    }

    /** The line of point @p k, counted over the whole grid. */
    int
    line_of(const std::size_t k) const
    {
      return first_line + static_cast<int>(k / n_along_line);
    }

    /** The place of point @p k on its line. */
    int
    position_of(const std::size_t k) const
    {
      return static_cast<int>(k % n_along_line);
    }

    /** Number of no point. */
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    /** The number of point @p i of line @p line; none if this rank does not know it. */
    std::size_t
    number_of(const int line, const int i) const
    {
      return line < first_line || line >= end() || i < 0 || i >= n_along_line
               ? none
               : static_cast<std::size_t>(line - first_line) * n_along_line + i;
    }

    /** The values of @p field at the points; zero at what does not belong to the region.
     *  Collective. */
    std::vector<double> values(const SlabField &field) const;

    /** Call visit(k, number) for each ghost @p k, with what its owner has of @p numbers,
     *  one for each point. Collective. */
    template <class Number, class Visit>
    void for_each_ghost(const std::vector<Number> &numbers, const Visit &visit) const;

    /** Points that lie together are in the same one of so many blocks. */
    std::size_t
    n_blocks() const
    {
      return (n_lines + block_size - 1) / block_size * blocks_per_line;
    }

    /** The block that point @p k is in. */
    std::size_t
    block_of(const std::size_t k) const
    {
      return k / n_along_line / block_size * blocks_per_line +
             k % n_along_line / block_size;
    }

  private:
    // Values of a block and what a search keeps of them fit a processor's cache. With
    // half of it a path at 4096² takes as long, with double of it a quarter longer.
    static constexpr std::size_t block_size = 32;

    SlabLayoutPtr                     layout;
    std::shared_ptr<const FlowRegion> region; // null: the box
    int                               n_along_line, n_lines = 0, first_line = 0;
    std::array<std::size_t, 2>        own = {{0, 0}};
    std::size_t                       blocks_per_line;
  };

  template <class Number, class Visit>
  void
  GridLines::for_each_ghost(const std::vector<Number> &numbers, const Visit &visit) const
  {
    if (region != nullptr)
      return;
    std::vector<int> wanted;
    if (own[0] > 0)
      wanted.push_back(first_line);
    if (own[1] < size())
      wanted.push_back(end() - 1);
    const std::vector<Number> lines =
      fetch_rows(*layout, numbers.data() + own[0], n_along_line, wanted);
    for (std::size_t i = 0; i < lines.size(); ++i)
      visit(i < own[0] ? i : i - own[0] + own[1], lines[i]);
  }
} // namespace strait

#endif
