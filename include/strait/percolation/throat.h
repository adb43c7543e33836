// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_throat_h
#define strait_percolation_throat_h

#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <limits>

namespace strait
{
  /**
   * The shape of a constriction at its narrowest point, where the gap is a saddle
   *   g = g0 (1 + s²/length²) (1 − t²/width²)
   * with s along and t across the channel: the gap doubles at a distance of one
   * length along it, and would vanish at one width across it. From second
   * differences of the gap at the point, among those of its level; not a number where
   * these do not tell of a saddle.
   *
   * Close to the walls the gap of a contact follows another law, g ~ (t0 − t)^(3/2).
   * Where points resolve that, the distance at which the gap doubles is measured along a
   * straight line through the point as well, in the direction of the largest second
   * derivative: the mean of both sides, not a number where one is unknown. In a saddle of
   * that law, turned and shifted against the points at will, it is off by at most 0.7 %
   * with five points from the middle to the wall, and 0.2 % with ten; a length from
   * second differences by 2.5 % and 0.6 %.
   */
  struct Throat
  {
    double gap             = 0.;
    double length          = 0.;
    double width           = 0.;
    double doubling_length = std::numeric_limits<double>::quiet_NaN();

    /** Of the points of its level, along the channel. */
    double spacing = 0.;

    /** Such spacings from there to where the gap has doubled: 0 if the points do
     *  not tell, infinite if the gap does not grow along the channel. */
    double points = 0.;
  };

  /** The throat at @p point of the open gap of a contact's @p gap. Collective. */
  Throat measure_throat(const SlabField &gap, double slip_length, const GridPoint &point);
} // namespace strait

#endif
