// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_throat_h
#define strait_percolation_throat_h

#include <strait/percolation/clusters.h>
#include <strait/percolation/flow_lattice.h>

#include <vector>

namespace strait
{
  /**
   * The shape of a constriction at its narrowest point, where the gap is a saddle
   *   g = g0 (1 + s²/length²) (1 − t²/width²)
   * with s along and t across the channel: the gap doubles at a distance of one
   * length along it, and would vanish at one width across it. From second
   * differences of the gap at the grid point; not a number where these do not tell
   * of a saddle.
   */
  struct Throat
  {
    double gap    = 0.;
    double length = 0.;
    double width  = 0.;
  };

  /** The throat at @p point of the open gap of a contact's @p gap. Collective. */
  Throat measure_throat(const SlabField &gap, double slip_length, const GridPoint &point);

  /** A stretch of a path with one narrowest point. */
  struct Constriction
  {
    std::size_t first = 0; // position on the path
    std::size_t last  = 0; // the first of the next stretch, or the end of the path
  };

  /**
   * Divide a path with the given @p gaps into constrictions. Two minima of the gap
   * are different constrictions if the channel between them widens to more than
   * 1.5 times the gap of the wider one; they are divided where it is widest.
   */
  std::vector<Constriction> divide_into_constrictions(const std::vector<double> &gaps);
} // namespace strait

#endif
