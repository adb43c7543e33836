// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>
#include <strait/spectral/periodic_grid.h>

#include <array>
#include <vector>

namespace strait
{
  /** Gap at the 4 × 4 grid points around a grid cell, [iy][ix]; the cell's own
   *  corners are [1][1], [1][2], [2][1] and [2][2]. */
  using GapStencil = std::array<std::array<double, 4>, 4>;

  /**
   * The gap between grid points. Monotone cubic: in each grid line a cubic Hermite
   * polynomial with the harmonic mean of adjacent slopes, zero at extrema
   * (Fritsch and Butland 1984), along the flow first and then across; it stays
   * between the values at the ends of its interval. Bilinear: for verification.
   *
   * Both obey the rule of the grid: positive on an edge between two open points,
   * zero on a cell that is open at no corner or only at two opposite ones, which
   * are no neighbours to the percolation verdict.
   */
  struct GapInterpolant
  {
    /** False where the gap vanishes on the whole cell. */
    static bool may_be_open(const GapStencil &gap);

    /** A polynomial of degree 3 between two grid points, at 0 and 1. */
    struct Cubic
    {
      double
      operator()(const double t) const
      {
        return value + t * (slope + t * (square + t * cube));
      }

      /** The slope at @p t. */
      double
      derivative(const double t) const
      {
        return slope + t * (2. * square + t * (3. * cube));
      }

      double value, slope, square, cube;
    };

    /** Between the inner two of four values. */
    Cubic between(double v0, double v1, double v2, double v3) const;

    GapInterpolation kind;
    FlowDirection    direction;
  };

  /** The gap on one cell, which may_be_open(). */
  class CellGap
  {
  public:
    CellGap(const GapInterpolant &interpolant, const GapStencil &gap);

    /**
     * The gap, not below zero, at the n × n points (x[i], y[j]) of the unit cell,
     * 0 <= x, y <= 1; result[j·n + i].
     */
    void evaluate(int n, const double *x, const double *y, double *result) const;

    /** Smallest and largest gap, and whether it bends at some line inside, where a slope
     *  across the grid lines begins to be limited to zero. */
    struct Range
    {
      double lowest   = 0.;
      double highest  = 0.;
      int    crossing = -1; // the grid line that there crosses the next one, if any does

      bool
      bends() const
      {
        return crossing >= 0;
      }
    };

    /**
     * Bounds, not below zero, of the gap on the rectangle of @p width × @p height at
     * (x0, y0) in the unit cell. Bilinear: attained at the corners. Monotone cubic: on
     * each grid line attained at the ends; across the lines the control polygon of the
     * cubic, whose slopes grow with each of the differences that they are made of. Exact
     * on the whole cell, and closer in proportion to the rectangle's size. That it bends
     * is told from the differences on two edges.
     */
    Range range(double x0, double y0, double width, double height) const;

    /** Where along the flow it bends between @p from and @p to, the ends of a rectangle
     *  whose Range has that @p crossing. */
    double bend(int crossing, double from, double to) const;

  private:
    const GapInterpolant                &interpolant;
    const bool                           along_x;
    std::array<GapInterpolant::Cubic, 4> lines; // along the flow
  };

  /** The gap between some rows of the grid, for cells that are not the grid's own. */
  struct GapRows
  {
    PeriodicGrid        grid;
    GapInterpolant      interpolant;
    int                 first_row;
    std::vector<double> rows; // from that on, one after the other

    /** The gap around the cell to the right of and above point (@p ix, @p iy). It needs
     *  the rows from the one before to the second one after that. */
    GapStencil stencil(int ix, int iy) const;

    /** The gap at a point of the box, not below zero. */
    double operator()(double x, double y) const;
  };
} // namespace strait
