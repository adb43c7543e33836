// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_two_scale_operator_h
#define strait_contact_two_scale_operator_h

#include <strait/spectral/fourier_transform.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace strait
{
  /** Weights of a point, its neighbours in x, in y, and on the diagonals. */
  struct NinePointStencil
  {
    double centre, x, y, diagonal;

    /** Of the phases per point @p phase_x and @p phase_y. */
    double symbol(double phase_x, double phase_y) const;
  };

  /**
   * The stencil whose symbol has the least relative error in the mean square over all
   * phases. @p target(x, y) > 0 is even in both phases.
   */
  NinePointStencil fit_stencil(const std::function<double(double, double)> &target);

  /**
   * A cheap symmetric stand-in for an operator with the symbol S(|q|): a stencil of
   * 3 × 3 points, fitted to S, plus a correction of its long waves on a grid of every
   * fourth point each way. Where nx or ny is not a multiple of 4 or below 32 only the
   * stencil is used.
   */
  class TwoScaleOperator
  {
  public:
    /**
     * The stiffness E* q/2, with E* = @p contact_modulus > 0; that of a uniform field is
     * that of the longest wave, so that it is positive. The corrections are
     * constant on boxes of 4 × 4 points: about a tenth of an FFT pair, and within a
     * factor of 1.6 for all waves. Collective.
     */
    static TwoScaleOperator
    stiffness(const SlabLayoutPtr &layout, const double contact_modulus)
    {
      const PeriodicGrid &grid = layout->grid();
      return {layout,
              Transfer::constant,
              contact_modulus,
              M_PI * contact_modulus / std::max(grid.lx, grid.ly)};
    }

    /**
     * The compliance 2/(qE*), with E* = @p contact_modulus > 0; a uniform field is
     * multiplied by @p uniform [length/pressure]. Positive. The corrections are
     * linear between the coarse points: about a quarter of an FFT pair, and within a
     * factor of 1.6 on a grid that suits_compliance(). Collective.
     */
    static TwoScaleOperator
    compliance(const SlabLayoutPtr &layout,
               const double         contact_modulus,
               const double         uniform)
    {
      return {layout, Transfer::linear, contact_modulus, uniform};
    }

    /** Whether there is a coarse grid and the points are spaced about equally. */
    static bool suits_compliance(const PeriodicGrid &grid);

    /**
     * Replace @p values, one a local grid point, by M values. before(row) may still
     * write the local row, after(row) finds the result there. @p Number is double or
     * float. Collective.
     */
    template <class Number>
    void apply(Number                         *values,
               const std::function<void(int)> &before,
               const std::function<void(int)> &after);

  private:
    /** What a correction is between the coarse points; the way there is the adjoint. */
    enum class Transfer
    {
      constant, // of the stiffness
      linear    // of the compliance
    };

    /** S of a uniform field is @p uniform. */
    TwoScaleOperator(const SlabLayoutPtr &layout,
                     Transfer             transfer,
                     double               contact_modulus,
                     double               uniform);

    /** S of the phase |q| √(dx dy) > 0. */
    double symbol(double of_phase) const;
    double correction(double x, double y, double missing) const;
    template <class Number>
    void restrict_row(const Number *values, int row);
    void find_corrections();
    template <class Number>
    void    expand_row(int row, std::vector<Number> &correction_line);
    double *row_above(int row);

    const SlabLayoutPtr    layout;
    const Transfer         transfer;
    const double           modulus;
    const NinePointStencil stencil;

    std::unique_ptr<FourierTransform> coarse_transform; // null: stencil only
    std::vector<double>               coarse_symbol;    // ky by kx, both >= 0
    std::vector<int>                  around;    // coarse rows about the fine ones,
    std::vector<double>               near_rows; // and their values
    std::vector<double>               coarse_line;
  };
} // namespace strait

#endif
