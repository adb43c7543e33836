// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_adhesion_of_scene_h
#define strait_contact_adhesion_of_scene_h

#include <strait/base/contact_parameters.h>
#include <strait/contact/adhesion_law.h>
#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * How far the adhesion of one surface reaches: z0 follows from the surface energy by
   * the Tabor number μT = Rc^{1/3} (γ0/E*)^{2/3} / z0, or is given. The definition is the
   * same for every shape. With van der Waals forces z0 is the distance of the surfaces
   * where they touch, as in Tabor's own definition (J. Colloid Interface Sci. 58, 2,
   * 1977); their largest attraction is then 2 γ0/z0, that of the exponential γ0/z0.
   */
  class AdhesionScale
  {
  public:
    /** @p parameters with Adhesion/Enabled; collective. Throws InputError if the
     *  Tabor number is given and the surface is flat. */
    AdhesionScale(const ContactParameters &parameters, const SlabField &heights);

    /** The law of this energy per area, with the scene's range or Tabor number. */
    AdhesionLaw law(double surface_energy) const;

    /** μT of a law on this surface. */
    double tabor_number(const AdhesionLaw &law) const;

    /**
     * E* over k a, with the grid spacing a and the largest slope k of the attraction:
     * γ0/z0² for the exponential, 6 γ0/z0² for van der Waals forces. Several points
     * lie within the edge of a contact if it is 3 or more; below 0.8 contact lines stick
     * to the grid.
     */
    double resolution(const AdhesionLaw &law) const;

  private:
    const AdhesionParameters adhesion;
    const double             modulus;
    const double             curvature_radius; // Rc
    const double             spacing;
  };

  /** Smallest resolution() without a warning. At half of it contact lines that begin to
   *  stick to the grid pass unnoticed, at double of it grids are warned of on which
   * several points lie within the edge of a contact. */
  constexpr double resolved_adhesion = 3.;

  /** Smallest resolution() without an error. At half of it runs pass whose contact lines
   *  stick to the grid, at double of it runs are refused that are coarse but usable. */
  constexpr double unresolved_adhesion = .8;

  /**
   * The adhesion law of the scene; collective. With `Match area at pressure` the
   * surface energy is sought for which adhesion doubles the contact area at that
   * nominal pressure, to a relative 0.1 %. Throws InputError if twice the area is more
   * than the whole, or if the range is not resolved by the grid and the scene does
   * not insist.
   */
  AdhesionLaw adhesion_of_scene(const ContactParameters &parameters,
                                const SlabField         &heights);
} // namespace strait

#endif
