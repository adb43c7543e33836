// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/pyramid_extension.h>
#include <strait/contact/two_scale_operator.h>
#include <strait/contact/window_transfer.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace strait
{
  /**
   * The approximate inverse of a half-space's compliance on the marked points of a grid
   * and nested windows of finer points. A field is extended to all points as by
   * PyramidExtension. Then each level contributes the stiffness of what it adds to the
   * field, and the adjoint of the extension follows.
   *
   * The value of a parent's point is the mean of the nine points of the window there;
   * what the window adds is the difference of its values from the interpolated ones of
   * the parent. In the extension this mean is weighted, and the windows are the finest
   * levels of the pyramid. Adjoints are those in the scalar product weighted by area.
   *
   * Values at points that windows cover are meaningless, on entry and on return.
   */
  class ZoomedPreconditioner
  {
  public:
    /** Multiplies @p values of window @p window by the stiffness, in its own box. */
    using WindowStiffness = std::function<void(int window, float *values)>;

    /** Collective. */
    ZoomedPreconditioner(const SlabLayoutPtr &layout, double contact_modulus);

    /** Apply the preconditioner to @p values, which must be 0 except at marked points.
     *  The @p window_stiffness is that of the ZoomedOperator. Collective. */
    void apply(float                 *values,
               const std::uint8_t    *marks,
               const WindowStiffness &window_stiffness);

  private:
    void stiffen(float *values, const WindowStiffness &window_stiffness);

    void take_means(int window, float *values);
    void take_means_adjoint(int window, float *values);
    void refine(int window, float *values);
    void refine_adjoint(int window, float *values);

    void interpolate(int window, const float *values);
    void add_deposit(int window, float *values);
    template <class OfParent, class Weight>
    void   add_to_children(int             window,
                           float          *values,
                           const OfParent &of_parent,
                           const Weight   &weight);
    float  weight_at(std::size_t i) const;
    float *room_of(int window);

    template <class Visit>
    void for_each_of_nine(int window, int a, int b, const Visit &visit) const;

    const SlabLayoutPtr                layout;
    const int                          n_windows;
    PyramidExtension                   extension; // on the grid
    TwoScaleOperator                   stiffness; // on the grid
    std::vector<WindowTransfer<float>> transfers;
    std::vector<float>                 sums;  // of weights, scaled to 2 × 2 points each
    std::vector<float>                 patch; // scratch: of a parent, around a window
    std::vector<float>                 room;  // scratch: for the points of all windows
  };
} // namespace strait
