// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/contact/adhesion_law.h>
#include <strait/spectral/slab_field.h>

namespace strait
{
  /** The adhesion of a scene on one surface. */
  struct SceneAdhesion
  {
    AdhesionLaw law;

    /**
     * The Tabor number μT = Rc^{1/3} (γ0/E*)^{2/3} / z0, which says how far the adhesion
     * reaches, of any shape alike. With van der Waals forces z0 is the distance of the
     * surfaces where they touch, as in Tabor's own definition (J. Colloid Interface Sci.
     * 58, 2, 1977); their largest attraction is then 2 γ0/z0, that of the exponential
     * γ0/z0.
     */
    double tabor_number;

    /**
     * E* over k a, with the grid spacing a and the largest slope k of the attraction:
     * γ0/z0² for the exponential, 6 γ0/z0² for van der Waals forces. Several points
     * lie within the edge of a contact if it is 3 or more; below 0.8 contact lines stick
     * to the grid.
     */
    double resolution;

    /** How many times larger it makes the contact area at `Match area at pressure`: twice
     *  to a relative 0.1 %, or less where the area jumps over that. */
    double growth;
  };

  /** Smallest resolution without a warning. At half of it contact lines that begin to
   *  stick to the grid pass unnoticed, at double of it grids are warned of on which
   * several points lie within the edge of a contact. */
  constexpr double resolved_adhesion = 3.;

  /**
   * The adhesion of the scene, with Adhesion/Enabled; collective. The range is given or
   * follows from the Tabor number. With `Match area at pressure` the surface energy is
   * sought for which adhesion doubles the contact area at that nominal pressure, or the
   * largest one below a jump over that. Throws InputError if the Tabor number is given
   * and the surface is flat, if twice the area is more than the whole, or if the range is
   * not resolved by the grid and the scene does not insist.
   */
  SceneAdhesion adhesion_of_scene(const ContactParameters &parameters,
                                  const SlabField         &heights);
} // namespace strait
