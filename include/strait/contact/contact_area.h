// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_area_h
#define strait_contact_contact_area_h

#include <strait/spectral/slab_field.h>

namespace strait
{
  /** How much of a periodic grid carries pressure. */
  struct ContactArea
  {
    /** Points with pressure > 0 over all points. */
    double fraction = 0;

    /**
     * The fraction that a continuum would have, A − 0.118 S a: a grid counts too much
     * along the contact line, which has the length S on the lattice, the number of
     * neighbouring pairs of points of which one is in contact, times their spacing a;
     * (π − 1 + ln 2)/24 = 0.118 (Yastrebov, Anciaux, Molinari 2017).
     */
    double corrected_fraction = 0;
  };

  /** Collective. */
  ContactArea contact_area(const SlabField &pressure);
} // namespace strait

#endif
