// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/theory/gap_distribution.h>
#include <strait/theory/radial_spectrum.h>

#include <boost/math/special_functions/chebyshev_transform.hpp>

#include <vector>

namespace strait
{
  /** The part of the area that comes out of contact when waves between two magnifications
   *  are switched on. Its gaps are distributed as |separation + roughness z|, z
   *  normal. */
  struct GapLayer
  {
    double fraction;   // of the nominal area
    double separation; // u1: mean distance of the walls, smoothed at that magnification
    double roughness;  // rms height of the shorter waves
  };

  /** What Persson's theory says about one load. */
  struct PerssonState
  {
    double                contact_area = 0.; // fraction of the nominal area
    double                mean_gap     = 0.; // ū
    std::vector<GapLayer> layers;            // from long waves to short ones
  };

  /** Fractions of the nominal area in contact where no pressure exceeds a hardness. */
  struct YieldingAreas
  {
    double elastic; // under less than the hardness
    double plastic; // under the hardness
  };

  /** Persson's theory of rough contact, with the gaps of Almqvist, Campañá, Prodanov and
   *  Persson, J. Mech. Phys. Solids 59 (2011) 2355; doc/theory.md has its formulas. */
  class PerssonTheory
  {
  public:
    /** @p gamma: fraction of the elastic energy at low loads, about 0.45. @p fineness
     *  multiplies the number of points of all integrals; what half of it changes tells
     *  their errors. */
    PerssonTheory(RadialSpectrum spectrum,
                  double         effective_modulus,
                  double         gamma    = .45,
                  int            fineness = 4);

    const RadialSpectrum &
    spectrum() const
    {
      return waves;
    }

    /** How many bins of distribution() make a decade of the gap, unless merged. */
    int
    bins_per_decade() const
    {
      return 25 * fineness;
    }

    /** Fraction of the nominal area in contact at the nominal @p pressure > 0. */
    double contact_area(double pressure) const;

    /** The same of a solid that flows at @p hardness > @p pressure: the distribution of
     *  pressures, which diffuses with the square of the slope, is absorbed at both ends
     *  (Persson, J. Chem. Phys. 115 (2001) 3840). To a relative 1e-12. */
    YieldingAreas contact_areas(double pressure, double hardness) const;

    /** All there is to know at the nominal @p pressure > 0. */
    PerssonState solve(double pressure) const;

    /** P(u) of what the gaps exceed @p closed >= 0 by, in bins that reach from nearly
     *  nothing to a thousand times the rms height, @p merged times as broad as those of
     *  bins_per_decade(). Smaller gaps count as contact, and the sum over the bins is 1
     *  less the contact by construction. */
    GapDistribution
    distribution(const PerssonState &state, double closed = 0., int merged = 1) const;

  private:
    /** W(s) for s > 0, to a relative 1e-12, and zero where it is less than a rounding
     *  error of 1. The part with γ is an exponential integral; the other has no closed
     *  form and is expanded in Chebyshev polynomials once, for it is needed a million
     *  times. */
    double compression(double s) const;

    /** ū where the waves up to mean square slope @p seen carry the pressure
     *  @p smoothed, √2 p/E*. */
    double mean_gap(double seen, double smoothed) const;

    /** ḡ² of the magnifications between the layers at a load of √2 p0/E*. */
    std::vector<double> magnifications(double smoothed) const;

    RadialSpectrum                           waves;
    double                                   modulus;
    double                                   gamma;
    boost::math::chebyshev_transform<double> saturated; // see saturated_part()
    int                                      fineness;
  };
} // namespace strait
