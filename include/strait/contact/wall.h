// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * The rough surface as the solid meets it: below its highest peak, as far as it was not
   * indented and, where a fluid presses on the half-space, displaced by G p_f, so that
   * contact is the dry problem with this surface under the load that the fluid leaves.
   */
  class Wall
  {
  public:
    /** @p surface: heights [length]; @p contact_modulus is E* > 0. Collective. Throws
     *  InputError if a height is not finite. */
    Wall(SlabField surface, double contact_modulus);

    /**
     * Let a fluid of the pressure @p fluid_pressure press from now on, or none if that is
     * null. It is on the grid of the heights, where windows do not matter, and continued
     * under the contact; the mean of its pressure is the load that it carries. Let the
     * surface have an @p indentation [length], or none if that is null. Collective; one
     * FFT pair with a fluid.
     */
    void deform(const SlabField *fluid_pressure, const SlabField *indentation = nullptr);

    /** The heights without fluid and indentation. */
    const SlabField &
    at_rest() const
    {
      return undeformed.empty() ? heights : undeformed;
    }

    SlabField heights;          // at most 0 [length]; they stay where they are
    double    mean_height = 0.; // of these
    double    rms_height  = 0.; // of the surface as it was made, about its mean
    double    fluid_load  = 0.; // mean pressure of the fluid; 0 without

  private:
    void lower_highest_peak_to_zero();

    const double modulus;
    SlabField    undeformed; // empty before the first fluid or indentation
  };
} // namespace strait
