// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/surface_parameters.h>
#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** An isotropic height spectrum C(q) as mean-field theories know it, with ∫d²q C = 2π ∫
   *  q C dq the mean square height: a power of q in each of several sections between two
   *  wave numbers. Needs no grid, and no more memory for eight decades of q than for
   *  two. */
  class RadialSpectrum
  {
  public:
    /** C ∝ q^(−decay) for from <= q <= to; the fraction of this section in the mean
     *  squares of height and slope. */
    struct Section
    {
      double from;
      double to;
      double decay;
      double height_square;
      double slope_square;
    };

    /** @p sections ascend without a space between them. Throws InputError if the
     *  surface that they make is flat, or if there are none. */
    explicit RadialSpectrum(std::vector<Section> sections);

    /** Mean square height and slope of the whole surface. */
    double
    height_square() const
    {
      return height_above.front();
    }

    double
    slope_square() const
    {
      return slope_below.back();
    }

    /** Mean square slope of the waves up to @p q. */
    double slope_square_below(double q) const;

    /** Mean square height of the waves from @p q on. */
    double height_square_above(double q) const;

    /** The inverse of slope_square_below(). */
    double wave_number_at(double slope_square) const;

    /** Integrals are divided where they meet, as the power law changes or C jumps. */
    const std::vector<Section> sections;

  private:
    std::vector<double> slope_below;  // at the edges of the sections
    std::vector<double> height_above; // likewise
  };

  /** The spectrum that a self-affine surface has on average: constant from 2π/L to the
   *  roll-off, ∝ q^(−2(1+H)) from there to the cut-off, in proportion to the scene's rms
   *  slope or height. L² is the area of the box. Throws InputError for a cut-off longer
   *  than the box. */
  RadialSpectrum model_spectrum(const SurfaceParameters &parameters);

  /** The spectrum of given @p heights, averaged over rings of wave vectors; its mean
   *  square height and slope are those of the surface. Throws InputError if the surface
   *  is flat. Collective. */
  RadialSpectrum measured_spectrum(const SlabField &heights);
} // namespace strait
