// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_nine_point_stencil_h
#define strait_contact_nine_point_stencil_h

#include <functional>
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

  /** Applies a stencil in place, row after row of a periodic line of points. */
  template <class Number>
  class StencilSweep
  {
  public:
    StencilSweep(const NinePointStencil &stencil, int row_length);

    /** Begin with the row after @p row_above. */
    void begin(const Number *row_above);

    /** Replace the next row @p values by the stencil's values plus @p added; @p below
     *  is the row after it. */
    void apply(Number *values, const Number *below, const Number *added);

  private:
    const NinePointStencil stencil;
    std::vector<Number>    above, here, mixed; // rows as they were, and a sum of them
  };
} // namespace strait

#endif
