// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_gap_around_h
#define strait_percolation_gap_around_h

#include <strait/spectral/slab_field.h>

#include <array>
#include <vector>

namespace strait
{
  /** The open gap at any position, on all levels, on the grid in some rows alone. */
  class GapAround
  {
  public:
    /** Of the contact's @p gap, with the @p rows of the grid from @p first_row on. */
    GapAround(const SlabField    &gap,
              double              slip_length,
              int                 first_row,
              std::vector<double> rows);

    /** At a point; not a number, and is_complete() no more, beyond the rows. */
    double at(int window, int ix, int iy);

    /** Whether the rows were enough for all that was asked. */
    bool
    is_complete() const
    {
      return complete;
    }

    /** The window of finest points around a position, −1 if there is none. */
    int window_at(double x, double y) const;

    /**
     * g^(2/3) at a position, which goes to zero linearly at the line of contact, and is
     * interpolated between points of the finest level around it: by cubic polynomials
     * where they are all open, bilinearly beside closed ones. With @p open_only zero
     * between closed points.
     */
    double root_at(double x, double y, bool open_only);

  private:
    /** Of the point before a position, and of its neighbours: −1, 0, 1 and 2. */
    using Weights = std::array<double, 4>;

    struct Roots
    {
      double value          = 0.;
      bool   between_closed = false; // at least one point that counts is closed
    };

    static Weights cubic_weights(double s);
    Roots          interpolate(int            window,
                               int            ix,
                               int            iy,
                               const Weights &along_x,
                               const Weights &along_y);
    /** Column and row of a position among the points of a window or the grid, whole
     *  numbers at points. */
    std::array<double, 2> indices(int window, double x, double y) const;

    const SlabField    &gap;
    const SlabLayout   &layout;
    double              slip_length;
    int                 first_row;
    std::vector<double> rows;
    bool                complete = true;
  };
} // namespace strait

#endif
