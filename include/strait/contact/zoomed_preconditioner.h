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
   * A stand-in for the inverse of a half-space's compliance on the marked points of a
   * grid and nested windows of finer points: the sum, over the levels, of the stiffness
   * of what a level adds, and of a PyramidExtension to all points before and its adjoint
   * after.
   *
   * What a point of a parent has is the mean of the nine points that a window has of it;
   * what the window adds is the difference from the parent's values, interpolated. For
   * the extension the mean is weighted and the windows are the finest levels of the
   * pyramid. All adjoints are those of the scalar product that is weighted by area.
   *
   * What stands at points that windows cover means nothing, before and after.
   */
  class ZoomedPreconditioner
  {
  public:
    /** Replaces the values of window @p window by their stiffness in a box of its own. */
    using WindowStiffness = std::function<void(int window, float *values)>;

    /** Collective. */
    ZoomedPreconditioner(const SlabLayoutPtr &layout, double contact_modulus);

    /** Replace @p values, which are 0 but where @p marks are. Collective. */
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
    void   give_to_nine(int             window,
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
    TwoScaleOperator                   stiffness; // likewise
    std::vector<WindowTransfer<float>> transfers;
    std::vector<float>                 sums;  // of weights, as if of 2 × 2 points each
    std::vector<float>                 patch; // of a parent, around a window
    std::vector<float>                 room;  // for the points of all windows
  };
} // namespace strait
