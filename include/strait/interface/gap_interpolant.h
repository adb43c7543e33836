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
   * Interpolation of the gap between grid points. Monotone cubic: along each grid line a
   * cubic Hermite polynomial whose slope at a point is the harmonic mean of the adjacent
   * differences, and zero at extrema (Fritsch and Butland 1984); along the flow first and
   * then across. It stays between the values at the ends of its interval. Bilinear: for
   * verification.
   *
   * Both obey the rule that decides percolation on the grid: the gap is positive on an
   * edge between two open points, and zero on a cell that is open at no corner or only at
   * two opposite ones, which do not count as neighbours.
   */
  struct GapInterpolant
  {
    /** False where the gap vanishes on the whole cell. */
    static bool may_be_open(const GapStencil &gap);

    /** A cubic polynomial between two grid points, which lie at t = 0 and t = 1. */
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

    /** The interpolant between the inner two of four adjacent values. */
    Cubic between(double v0, double v1, double v2, double v3) const;

    GapInterpolation kind;
    FlowDirection    direction;
  };

  /** The gap on one cell for which GapInterpolant::may_be_open() holds. */
  class CellGap
  {
  public:
    CellGap(const GapInterpolant &interpolant, const GapStencil &gap);

    /** Evaluate the gap, not below zero, at the n × n points (x[i], y[j]) of the unit
     *  cell, 0 <= x, y <= 1; result[j·n + i]. */
    void evaluate(int n, const double *x, const double *y, double *result) const;

    /** Bounds of the gap, and whether it bends on a line inside, where a slope across the
     *  grid lines begins to be limited to zero. */
    struct Range
    {
      double lowest   = 0.;
      double highest  = 0.;
      int    crossing = -1; // k if the gaps on lines k and k + 1 cross; −1: none

      bool
      bends() const
      {
        return crossing >= 0;
      }
    };

    /**
     * Return bounds, not below zero, of the gap on the rectangle of @p width × @p height
     * at (x0, y0) in the unit cell. Bilinear: the extremes of the corners. Monotone
     * cubic: on each grid line the extremes of the ends; across the lines the Bézier
     * control polygon of the cubic, whose slopes increase with each of the differences
     * that they are formed from. The bounds are exact on the whole cell, and otherwise
     * off in proportion to the size of the rectangle. The signs of the differences
     * between grid lines on two opposite edges tell whether the gap bends.
     */
    Range range(double x0, double y0, double width, double height) const;

    /** The coordinate along the flow at which the gap bends, between the ends @p from and
     *  @p to of a rectangle whose Range has this @p crossing. */
    double bend(int crossing, double from, double to) const;

  private:
    const GapInterpolant                &interpolant;
    const bool                           along_x;
    std::array<GapInterpolant::Cubic, 4> lines; // the gap on grid lines along the flow
  };

  /** The gap on some consecutive rows of the grid: around cells, and at any point between
   *  these rows. */
  struct GapRows
  {
    PeriodicGrid        grid;
    GapInterpolant      interpolant;
    int                 first_row;
    std::vector<double> rows; // from first_row on, one after the other

    /** The gap around the cell whose lower left point is (@p ix, @p iy). The rows from
     *  iy − 1 to iy + 2 must be there. */
    GapStencil stencil(int ix, int iy) const;

    /** The gap at a point of the box, not below zero. */
    double operator()(double x, double y) const;
  };
} // namespace strait
