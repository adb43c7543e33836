// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/grid_boxes.h>

#include <memory>
#include <vector>

namespace strait
{
  /**
   * Extends a field from the marked points of a periodic grid to all others: the nearer
   * ones get what is marked beside them, the farther ones means over larger and larger
   * boxes, up to the whole grid. The result is bounded: as rough as the field on the
   * marked points has to be, and no rougher, on all scales. (Gortler et al., The
   * Lumigraph, SIGGRAPH 1996, fill pictures so.)
   *
   * A point counts with its weight, 1 if it is marked, else 0. A box of 2 × 2 points has
   * their weighted mean as its value, and is itself a point of the next level; its
   * weight is a third of the sum of theirs, at most 1. On the way back a point of the
   * weight w keeps this part of its value, and gets the rest from the boxes around it, by
   * linear interpolation.
   *
   * Costs about two passes over the grid and 3 B a point.
   */
  class PyramidExtension
  {
  public:
    /** Collective. */
    explicit PyramidExtension(const SlabLayoutPtr &layout);

    /**
     * Take the means of @p values over boxes of all sizes. What the points have, @p has,
     * are marks, or sums as those of GridBoxes. Collective.
     */
    template <class Has>
    void gather(const float *values, const Has *has);

    /** Extend the same values to points without weight. Collective. */
    template <class Has>
    void spread(float *values, const Has *has);

    /** The boxes of 2 × 2 points. Their values are those of the field that was extended,
     *  until they are changed to what the adjoint is to take of boxes. */
    GridBoxes &
    finest()
    {
      return *levels.front();
    }

    /** The adjoint, for the same values, after all of the changes to finest(): points
     *  without weight end as 0. Collective. */
    template <class Has>
    void extend_adjoint(float *values, const Has *has);

  private:
    template <class Add, class Finish>
    void climb(const Add &add, const Finish &finish);
    template <class Prepare, class Give>
    void descend(const Prepare &prepare, const Give &give);
    template <class Pass>
    void pass_rows(std::size_t l, const Pass &pass);
    template <class Numbers, class Has, class Pass>
    void pass_points(Numbers *values, const Has *has, const Pass &pass);

    const SlabLayoutPtr                     layout;
    std::vector<std::unique_ptr<GridBoxes>> levels; // the finest first
  };
} // namespace strait
