// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>
#include <strait/interface/gap_interpolant.h>
#include <strait/interface/moment_set.h>
#include <strait/interface/rarefied_flow.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <vector>

namespace strait
{
  /** The square whose moments are wanted, in the unit coordinates of one cell of the grid
   *  or of a window. It may extend beyond that cell. */
  struct Square
  {
    double x0   = 0.;
    double y0   = 0.;
    double edge = 1.;
  };

  /** The coefficient of one of the potential problems, a monotone function of the gap. */
  struct CoefficientLaw
  {
    double unit_gap_conductivity; // K of a gap of 1: 1/(12 η)
    double conductivity_floor;
    bool   is_resistivity;

    const GapFactor *factor = nullptr; // multiplies K for a rarefied gas; null: 1

    /**
     * Return K = g³/(12 η) times the factor, or 1/K. Both are limited, as rounding would
     * spoil the solution of a problem whose coefficient spans too many decades.
     *
     * In 1/K, K lies between the floor and 10¹⁴ times the floor. A limit ten times as
     * large still works; with 10⁵ times as much the solution was lost on a throat of 10⁻⁵
     * of the widest gap. What the limit adds where the gap is wide increases the energy
     * by less than 10⁻⁵ of that of the throat.
     *
     * With a floor, K itself is at most 10¹⁸ times the floor, so that what flows into a
     * pool also flows out of it: with 10²⁰ the pressure in a pool between two throats of
     * 10⁻⁷ of its gap was off by a tenth of the pressure drop. With 10¹⁷ meshes have half
     * as many cells again, as the pool then resists as much as coarse cells do. With 10¹⁸
     * the pool adds less than 10⁻⁸ of the resistance of the throat.
     */
    double
    operator()(const double gap) const
    {
      double k = unit_gap_conductivity * gap * gap * gap;
      if (factor != nullptr && gap > 0.)
        k *= (*factor)(gap);
      if (is_resistivity)
        return 1. / std::clamp(k, conductivity_floor, 1e14 * conductivity_floor);
      return conductivity_floor > 0. ? std::min(k, 1e18 * conductivity_floor) : k;
    }
  };

  /** The moments of one coefficient, while they are summed up. */
  struct Integral
  {
    CoefficientLaw law;
    double        *moments;
    double         scale = 0.; // size of the integral, from its first part; 0: not known
  };

  /**
   * Moments of coefficients on one cell of the grid or of a window, or on a part of it,
   * from above: every energy that is formed from them is meant to be at least the true
   * one.
   *
   * A part on which the gap is known to vary little (CellGap::range()) is integrated by
   * Gauss quadrature with p + 2 points along each axis, and the difference from the
   * result of p + 1 points is added as a constant; where the gap hardly varies, p + 1
   * points are enough. Other parts are divided, at a line on which the gap bends or else
   * in halves, until the largest value of the coefficient in a part may be taken for all
   * of it. For rigorous bounds all parts are treated in this second way, and always
   * halved.
   */
  class CellQuadrature
  {
  public:
    explicit CellQuadrature(const FluidParameters &fluid);

    /** Add the contribution of the cell whose stencil is @p gap, as far as @p square
     *  covers it, to the moments of @p square of all @p integrals. */
    void integrate(const GapStencil            &gap,
                   const Square                &square,
                   const std::vector<Integral> &integrals) const;

    const MomentSet &
    moment_set() const
    {
      return set;
    }

  private:
    struct Sums;

    static constexpr int max_points = 4; // along an axis, of the fine rule for degree 2

    MomentSet         set;
    GapInterpolant    interpolant;
    bool              rigorous;
    dealii::QGauss<2> coarse, fine; // p + 1 and p + 2 points along each axis
  };
} // namespace strait
