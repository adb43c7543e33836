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
     * The Tabor number μT = Rc^{1/3} (γ0/E*)^{2/3} / z0, which measures how short the
     * range of the adhesion is; it is defined alike for all shapes. With van der Waals
     * forces z0 is the distance between surfaces in contact, as in Tabor's own definition
     * (J. Colloid Interface Sci. 58, 2, 1977). Their largest attraction is then 2 γ0/z0;
     * that of the exponential is γ0/z0.
     */
    double tabor_number;

    /**
     * E* / (k a), with the larger grid spacing a and the steepest slope k of the
     * attraction: γ0/z0² for the exponential, 6 γ0/z0² for van der Waals forces. From 3
     * on, several points lie within the edge of a contact; below 0.8, contact lines stick
     * to the grid.
     */
    double resolution;

    /** Contact area at `Match area at pressure` over that without adhesion: 2 to a
     *  relative 0.1 %, less where the area jumps past that; also 2 without a match. */
    double growth;
  };

  /** Smallest resolution without a warning. With half of this value no warning is given
   *  where contact lines begin to stick to the grid; with double of it there is a warning
   *  for grids on which several points lie within the edge of a contact. */
  constexpr double resolved_adhesion = 3.;

  /**
   * Return the adhesion of a scene with Adhesion/Enabled on a surface of @p heights. The
   * range is given or follows from the Tabor number. `Match area at pressure` selects the
   * surface energy with which adhesion doubles the contact area at that nominal pressure
   * or, where the area jumps past that, the largest one below the jump. Collective.
   * Throws InputError if the Tabor number is given and the surface is flat, if twice the
   * contact area is the whole area or more, or if the grid does not resolve the range and
   * the scene does not accept that; ComputationError if no match is found.
   */
  SceneAdhesion adhesion_of_scene(const ContactParameters &parameters,
                                  const SlabField         &heights);
} // namespace strait
