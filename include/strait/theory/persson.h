// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/theory/gap_distribution.h>
#include <strait/theory/radial_spectrum.h>

#include <boost/math/special_functions/chebyshev_transform.hpp>

#include <vector>

namespace strait
{
  /** The part of the area that comes out of contact when the waves between two
   *  magnifications are added. Its gaps are distributed as |separation + roughness z|
   *  with z standard normal. */
  struct GapLayer
  {
    double fraction;   // of the nominal area
    double separation; // u1: mean distance of the walls, without the shorter waves
    double roughness;  // rms height of the shorter waves
  };

  /** The result of Persson's theory for one load. */
  struct PerssonState
  {
    double                contact_area = 0.; // fraction of the nominal area
    double                mean_gap     = 0.; // ū [length]
    std::vector<GapLayer> layers;            // from long waves to short ones
  };

  /** Fractions of the nominal area in contact if a hardness limits the pressure. */
  struct YieldingAreas
  {
    double elastic; // at pressures below the hardness
    double plastic; // at the hardness
  };

  /** Persson's theory of rough contact, with the gaps of Almqvist, Campañá, Prodanov and
   *  Persson, J. Mech. Phys. Solids 59 (2011) 2355; doc/theory.md has its formulas. */
  class PerssonTheory
  {
  public:
    /** @p gamma: fraction of the elastic energy at low loads, about 0.45. @p fineness
     *  multiplies the number of points of all integrals; the change with half of it
     *  estimates their errors. */
    PerssonTheory(RadialSpectrum spectrum,
                  double         effective_modulus,
                  double         gamma    = .45,
                  int            fineness = 4);

    const RadialSpectrum &
    spectrum() const
    {
      return waves;
    }

    /** Number of bins of distribution() in a decade of the gap, unless merged. */
    int
    bins_per_decade() const
    {
      return 25 * fineness;
    }

    /** Return the fraction of the nominal area in contact at nominal @p pressure > 0. */
    double contact_area(double pressure) const;

    /** The same for a solid that yields at @p hardness > @p pressure: the distribution of
     *  pressures, which diffuses with the mean square slope, is absorbed at zero and at
     *  the hardness (Persson, J. Chem. Phys. 115 (2001) 3840). To a relative 1e-12. */
    YieldingAreas contact_areas(double pressure, double hardness) const;

    /** Compute area, mean gap and layers at the nominal @p pressure > 0. */
    PerssonState solve(double pressure) const;

    /** Return P(u) of the excess u of the gaps over @p closed >= 0; smaller gaps count as
     *  contact. The bins reach from nearly zero to a thousand times the rms height, and
     *  are @p merged times as broad as those of bins_per_decade(). By construction they
     *  sum to 1 minus the contact area. */
    GapDistribution
    distribution(const PerssonState &state, double closed = 0., int merged = 1) const;

  private:
    /** Return W(s) for s > 0, to a relative 1e-12, and zero where it is less than a
     *  rounding error of 1. The part with γ is an exponential integral; the other has no
     *  closed form and is expanded once in Chebyshev polynomials, since it is needed a
     *  million times. */
    double compression(double s) const;

    /** Return ū(ζ) at the magnification with ḡ² = @p seen, for @p smoothed = √2 p(ζ)/E*
     *  with the mean pressure p(ζ) in what is in contact there. */
    double mean_gap(double seen, double smoothed) const;

    /** Return ḡ² of the magnifications between layers; @p smoothed = √2 p0/E*. */
    std::vector<double> magnifications(double smoothed) const;

    RadialSpectrum                           waves;
    double                                   modulus;
    double                                   gamma;
    boost::math::chebyshev_transform<double> erf_square_part; // see saturated_part()
    int                                      fineness;
  };
} // namespace strait
