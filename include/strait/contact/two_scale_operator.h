// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/fourier_transform.h>

#include <functional>
#include <vector>

namespace strait
{
  /** Weights of a point and its neighbours in x, in y and on the diagonals. */
  struct NinePointStencil
  {
    double centre, x, y, diagonal;

    /** The factor for a wave with the phases @p phase_x and @p phase_y per point. */
    double symbol(double phase_x, double phase_y) const;
  };

  /**
   * A cheap approximation of the response of a half-space: a stencil of 3 × 3 points for
   * the waves that only the points resolve, plus a Fourier multiplier on boxes of 2 × 2
   * points for what the stencil lacks of the longer waves. The stencil is exact for the
   * shortest waves along x, along y and along both.
   */
  class TwoScaleOperator
  {
  public:
    /**
     * The stiffness E* q/2, with E* = @p contact_modulus > 0, for a field on @p points
     * and its means over @p boxes. A uniform field has the stiffness of the longest wave.
     * The sum of both parts is 0.8 to 1.6 times the stiffness for all waves. Collective.
     */
    static TwoScaleOperator stiffness(const SlabLayoutPtr &points,
                                      const SlabLayoutPtr &boxes,
                                      double               contact_modulus);

    /**
     * The compliance 2/(qE*), for a field on @p points and what the adjoint of linear
     * interpolation makes of it on @p boxes; their result is to be interpolated linearly.
     * A uniform field is multiplied by @p uniform [length/pressure]. The sum of both
     * parts is 0.9 to 1.1 times the compliance if dx = dy. Collective.
     */
    static TwoScaleOperator compliance(const SlabLayoutPtr &points,
                                       const SlabLayoutPtr &boxes,
                                       double               contact_modulus,
                                       double               uniform);

    /** Apply the stencil to @p values, one per local point. Collective. */
    void on_points(float *values) const;

    /** Apply what the stencil lacks to @p values, one per local box. Collective. */
    void on_boxes(float *values);

    /** Free the memory for the transform of the boxes until it is needed again. */
    void
    release()
    {
      transform.release();
    }

  private:
    /** The factor for the wave that fits kx times into the box along x and ky along y. */
    using Answer = std::function<double(double, double)>;

    /** The factor for a uniform field is @p uniform; that of the stencil alone is
     *  @p of_stencil. The part on boxes is multiplied by @p weight. */
    TwoScaleOperator(const SlabLayoutPtr &points,
                     const SlabLayoutPtr &boxes,
                     const Answer        &answer,
                     double               uniform,
                     double               of_stencil,
                     double               weight);

    const SlabLayoutPtr          layout; // of the points
    NinePointStencil             stencil;
    BasicFourierTransform<float> transform;  // of the boxes
    std::vector<float>           box_symbol; // ky by kx, both >= 0
  };
} // namespace strait
