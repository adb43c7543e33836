// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * The rough surface as the solid meets it: counted from its highest peak, less what is
   * indented and, where a fluid presses on the half-space, less the displacement G p_f.
   * Contact is then the dry problem with this surface, under the load that the fluid
   * leaves.
   */
  class Wall
  {
  public:
    /** @p surface has the heights [length]; @p contact_modulus is E* > 0. Collective.
     *  Throws InputError if a height is not finite. */
    Wall(SlabField surface, double contact_modulus);

    /**
     * Let a fluid of the pressure @p fluid_pressure press from now on, or none if that is
     * null, and let the surface have this @p indentation [length], or none if that is
     * null. The fluid pressure is given on the grid of the heights, perhaps with windows,
     * and continued under the contact; its mean is the load that the fluid carries.
     * Collective; one FFT pair with a fluid.
     */
    void deform(const SlabField *fluid_pressure, const SlabField *indentation = nullptr);

    /** The heights without a fluid and without indentation. */
    const SlabField &
    at_rest() const
    {
      return undeformed.empty() ? heights : undeformed;
    }

    SlabField heights;          // at most 0 [length]; never reallocated
    double    mean_height = 0.; // of these
    double    rms_height  = 0.; // of the original surface, about its mean
    double    fluid_load  = 0.; // mean pressure of the fluid; 0 without a fluid

  private:
    void lower_highest_peak_to_zero();

    const double modulus;
    SlabField    undeformed; // empty while there is neither fluid nor indentation
  };
} // namespace strait
