// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/fourier_transform.h>

#include <functional>
#include <vector>

namespace strait
{
  /** Weights of a point, its neighbours in x, in y, and on the diagonals. */
  struct NinePointStencil
  {
    double centre, x, y, diagonal;

    /** By what it multiplies a wave of the phases per point @p phase_x and @p phase_y. */
    double symbol(double phase_x, double phase_y) const;
  };

  /**
   * A cheap stand-in for the answer of a half-space to waves: a stencil of 3 × 3 points
   * for those that only points can show, plus what it lacks of the others on boxes of
   * 2 × 2 points. The stencil is exact for the shortest waves along x, along y and along
   * both.
   */
  class TwoScaleOperator
  {
  public:
    /**
     * The stiffness E* q/2, with E* = @p contact_modulus > 0, for a field on @p points
     * and its means over @p boxes; that of a uniform field is that of the longest wave.
     * The sum is 0.8 to 1.6 times the stiffness for all waves. Collective.
     */
    static TwoScaleOperator stiffness(const SlabLayoutPtr &points,
                                      const SlabLayoutPtr &boxes,
                                      double               contact_modulus);

    /**
     * The compliance 2/(qE*), if what boxes have is found by linear interpolation, and
     * its adjoint before; a uniform field is multiplied by @p uniform [length/pressure].
     * On a grid whose points are spaced equally the sum is 0.9 to 1.1 times the
     * compliance. Collective.
     */
    static TwoScaleOperator compliance(const SlabLayoutPtr &points,
                                       const SlabLayoutPtr &boxes,
                                       double               contact_modulus,
                                       double               uniform);

    /** Replace @p values, one a local point, by the stencil's. Collective. */
    void on_points(float *values) const;

    /** Replace @p values, one a local box, by what the stencil lacks there. Collective.
     */
    void on_boxes(float *values);

    /** Free the room for the transform of the boxes until it is needed again. */
    void
    release()
    {
      transform.release();
    }

  private:
    /** Of a wave, by how many times it fits into the box along x and along y. */
    using Answer = std::function<double(double, double)>;

    /** The answer to a uniform field is @p uniform, the stencil's to it @p of_stencil.
     *  What boxes lack is multiplied by @p weight. */
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
