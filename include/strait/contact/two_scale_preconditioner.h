// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_two_scale_preconditioner_h
#define strait_contact_two_scale_preconditioner_h

#include <strait/contact/nine_point_stencil.h>
#include <strait/spectral/fourier_transform.h>

#include <functional>
#include <memory>
#include <vector>

namespace strait
{
  /**
   * A cheap stand-in for the operator with the symbol |q|, the inverse of a
   * half-space's compliance: a stencil of 3 × 3 points, fitted to |q|, plus a
   * correction of its long waves on the grid of means over 4 × 4 points. Costs
   * about a tenth of an FFT pair.
   *
   * Where nx or ny is not a multiple of 4 or below 32 only the stencil is used.
   */
  class TwoScalePreconditioner
  {
  public:
    /** Collective. */
    explicit TwoScalePreconditioner(SlabLayoutPtr layout);

    /** Replace @p values, one a local grid point, by M values. Collective. */
    void apply(double *values);

    /**
     * The same for callers that run over the rows before and after: before(row)
     * may still write the local row, after(row) finds the result there.
     */
    void apply(double                         *values,
               const std::function<void(int)> &before,
               const std::function<void(int)> &after);

    /** Bytes on this rank. */
    std::size_t memory_consumption() const;

  private:
    static NinePointStencil fit_to_symbol(double aspect);

    void                find_corrections();
    void                add_to_boxes(const double *values, int row);
    void                collect_boxes();
    std::vector<double> rows_beyond(const double *values) const;
    void                expand_corrections(int row);

    SlabLayoutPtr    layout;
    double           aspect; // dy/dx
    NinePointStencil stencil;
    StencilSweep     sweep;

    std::unique_ptr<FourierTransform> coarse_transform; // null: stencil only
    bool                              coarse_rows_are_local = false;
    std::vector<double>               box_values; // sums, then corrections
    // Only where a box lies on several ranks:
    std::vector<double> row_sums;
    std::vector<double> fetched_corrections;
    int                 first_correction_row = 0;
    std::vector<double> correction_line;
  };
} // namespace strait

#endif
