// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_two_scale_compliance_h
#define strait_contact_two_scale_compliance_h

#include <strait/contact/nine_point_stencil.h>
#include <strait/spectral/fourier_transform.h>

#include <functional>
#include <vector>

namespace strait
{
  /**
   * A cheap stand-in for the compliance 2/(qE*) of a half-space, symmetric and positive:
   * a stencil of 3 × 3 points, fitted to 1/|q|, plus a correction of its long waves on
   * the grid of every fourth point, between which it is linear. Costs about a quarter
   * of an FFT pair and is within a factor of 1.6 for all waves where dx = dy.
   */
  class TwoScaleCompliance
  {
  public:
    /** Whether the points are multiples of 4, at least 32, and spaced about equally. */
    static bool suits(const PeriodicGrid &grid);

    /**
     * On a grid that suits(), with E* = @p contact_modulus > 0; a uniform field is
     * multiplied by @p uniform [length/pressure]. Collective.
     */
    TwoScaleCompliance(SlabLayoutPtr layout, double contact_modulus, double uniform);

    /**
     * Replace @p values, one a local grid point, by M values. before(row) may still
     * write the local row, after(row) finds the result there. Collective.
     */
    void apply(double                         *values,
               const std::function<void(int)> &before,
               const std::function<void(int)> &after);

    /** Bytes on this rank. */
    std::size_t memory_consumption() const;

  private:
    void restrict_row(const double *values, int row);
    void find_corrections();
    void expand_correction(int row);

    const SlabLayoutPtr    layout;
    const double           unit; // 1/(q √(dx dy)) times this is the compliance
    const NinePointStencil stencil;
    StencilSweep           sweep;
    FourierTransform       coarse_transform;
    std::vector<double>    symbol;     // of the corrections, ky by kx, both >= 0
    std::vector<double>    restricted; // of each row, every fourth point
    std::vector<double>    coarse;     // local rows of the coarse grid
    std::vector<double>    corrections;
    std::vector<double>    between; // two coarse rows
    std::vector<double>    correction_line;
  };
} // namespace strait

#endif
