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
  /** The square whose moments are wanted, in the unit coordinates of a cell of a level.
   */
  struct Square
  {
    double x0   = 0.;
    double y0   = 0.;
    double edge = 1.;
  };

  /** The coefficient of one of the potential problems, a monotone function of the gap. */
  struct CoefficientLaw
  {
    double conductivity_of_one; // K of a gap of 1, 1/(12 η)
    double conductivity_floor;
    bool   is_resistivity;

    const GapFactor *factor = nullptr; // of K for a rarefied gas; null: one

    /**
     * K = g³/(12 η) times the factor, or 1/K with K between the floor and 10¹⁴ times
     * that. Beyond, rounding would spoil the solution: with ten times as much it still
     * holds, with 10⁵ times it was lost on a throat of 10⁻⁵ of the widest gap. Whatever
     * is added where the gap is wide makes the energy larger by less than 10⁻⁵ of that of
     * the throat. With a floor K itself is no more than 10¹⁸ times that, for the same
     * reason: what flows into a pool must be what flows out of it, and with 10²⁰ times
     * the pressure in one between two throats of 10⁻⁷ of its gap was off by a tenth of
     * the drop. With 10¹⁷ times meshes have half as many cells again, as the pool then
     * resists as much as coarse cells. What it does resist beside the throat is less than
     * 10⁻⁸ of what the throat does.
     */
    double
    operator()(const double gap) const
    {
      double k = conductivity_of_one * gap * gap * gap;
      if (factor != nullptr && gap > 0.)
        k *= (*factor)(gap);
      if (is_resistivity)
        return 1. / std::clamp(k, conductivity_floor, 1e14 * conductivity_floor);
      return conductivity_floor > 0. ? std::min(k, 1e18 * conductivity_floor) : k;
    }
  };

  /** The moments of one coefficient, as they are added up. */
  struct Integral
  {
    CoefficientLaw law;
    double        *moments;
    double         scale = 0.; // of what was added so far
  };

  /**
   * Moments of coefficients on (parts of) one cell of a level, from above: each energy
   * that is formed of them is to be at least the true one.
   *
   * A part is integrated by Gauss quadrature of p + 2 points along each axis, and what
   * p + 1 points find otherwise is added as a constant. That is trusted where the gap is
   * known to vary little in the part (CellGap::range()); where it hardly varies, p + 1
   * points are enough. Other parts are divided, at a line on which the gap bends or else
   * in halves, until the coefficient may be taken to be as large as it is anywhere in
   * them. For rigorous bounds all parts are treated like that, and halved.
   */
  class CellQuadrature
  {
  public:
    explicit CellQuadrature(const FluidParameters &fluid);

    /**
     * Add to the moments of @p square, of all @p integrals, those of what the cell with
     * @p gap at its corners has of it.
     */
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

    static constexpr int max_points = 4; // of a rule for degree 2

    MomentSet         set;
    GapInterpolant    interpolant;
    bool              rigorous;
    dealii::QGauss<2> coarse, fine; // of p + 1 and p + 2 points along each axis
  };
} // namespace strait
