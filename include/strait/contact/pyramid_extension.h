// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/grid_boxes.h>

#include <memory>
#include <vector>

namespace strait
{
  /**
   * Extends a field from the marked points of a periodic grid to all others: near ones
   * get the values of marked points beside them, farther ones means over larger and
   * larger boxes, up to the whole grid. The result is bounded and, on all scales, no
   * rougher than the field on the marked points requires. (The push-pull method, by which
   * Gortler et al., The Lumigraph, SIGGRAPH 1996, fill in images.)
   *
   * The weight of a point is 1 if it is marked, else 0. The value of a box of 2 × 2
   * points is their weighted mean; its weight is a third of the sum of theirs, at most 1.
   * Boxes are the points of the next level. On the way back a point of the weight w keeps
   * this part of its value, and gets the rest by linear interpolation between the boxes.
   *
   * Costs about two passes over the grid and 3 B per point.
   */
  class PyramidExtension
  {
  public:
    /** Collective. */
    explicit PyramidExtension(const SlabLayoutPtr &layout);

    /**
     * Take the means of @p values over boxes of all sizes, with weights by @p weights:
     * marks of the points, or sums of weights as in GridBoxes. Collective.
     */
    template <class Weights>
    void gather(const float *values, const Weights *weights);

    /** Then extend the same @p values to points without weight. Collective. */
    template <class Weights>
    void spread(float *values, const Weights *weights);

    /** The boxes of 2 × 2 points. After spread() their values are those of the extended
     *  field. They may be changed then: extend_adjoint() takes them as input as well. */
    GridBoxes &
    finest()
    {
      return *levels.front();
    }

    /** Apply the adjoint of the extension of the last gather() to @p values and to the
     *  values of finest(). Points without weight become 0. Collective. */
    template <class Weights>
    void extend_adjoint(float *values, const Weights *weights);

  private:
    template <class Add, class Finish>
    void climb(const Add &add, const Finish &finish);
    template <class Prepare, class Give>
    void descend(const Prepare &prepare, const Give &give);
    template <class Pass>
    void pass_rows(std::size_t l, const Pass &pass);
    template <class Numbers, class Weights, class Pass>
    void pass_points(Numbers *values, const Weights *weights, const Pass &pass);

    const SlabLayoutPtr                     layout;
    std::vector<std::unique_ptr<GridBoxes>> levels; // finest first
  };
} // namespace strait
