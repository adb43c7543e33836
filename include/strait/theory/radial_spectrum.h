// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/surface_parameters.h>
#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** An isotropic height spectrum C(q) for mean-field theories: a power of q in each of
   *  several sections between two wave numbers. The mean square height is ∫d²q C =
   *  2π ∫ q C dq. Needs no grid, and no more memory for eight decades of q than for
   *  two. */
  class RadialSpectrum
  {
  public:
    /** C ∝ q^(−decay) for from <= q <= to, with the contributions of this section to the
     *  mean squares of height and slope. */
    struct Section
    {
      double from;
      double to;
      double decay;
      double height_square;
      double slope_square;
    };

    /** The @p sections must ascend without a space between them. Throws InputError if the
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

    /** Return the mean square slope of the waves up to @p q. */
    double slope_square_below(double q) const;

    /** Return the mean square height of the waves from @p q on. */
    double height_square_above(double q) const;

    /** The inverse of slope_square_below(). */
    double wave_number_at(double slope_square) const;

    /** Integrals are to be divided at their ends, where the power changes or C jumps. */
    const std::vector<Section> sections;

  private:
    std::vector<double> slope_below;  // at the edges of the sections
    std::vector<double> height_above; // likewise
  };

  /** Return the average spectrum of a self-affine surface: constant from 2π/L to the
   *  roll-off, ∝ q^(−2(1+H)) from there to the cut-off, scaled to the scene's rms slope
   *  or height. L² is the area of the box. Throws InputError if the cut-off wavelength
   *  is not shorter than L. */
  RadialSpectrum model_spectrum(const SurfaceParameters &parameters);

  /** Return the spectrum of given @p heights, averaged over rings of wave vectors; its
   *  mean square height and slope are those of the surface. Throws InputError if the
   *  surface is flat. Collective. */
  RadialSpectrum measured_spectrum(const SlabField &heights);
} // namespace strait
