// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_bottleneck_h
#define strait_percolation_bottleneck_h

#include <strait/percolation/flow_lattice.h>
#include <strait/spectral/slab_field.h>

#include <array>
#include <vector>

namespace strait
{
  /** The narrowest point of the widest way from inlet to outlet. */
  struct Bottleneck
  {
    GridPoint point;
    double    value = 0.;
  };

  /**
   * The largest value v such that the points with @p openness >= v connect inlet and
   * outlet, over the four nearest neighbours as in find_clusters(), and the point
   * where a way that realises it is narrowest.
   *
   * With openness = gap the value is the gap of the critical constriction; where
   * closed points carry a negative number that tells how firmly they are closed,
   * its sign is the verdict on percolation, and both sides of the threshold say how
   * far it is. Runs on rank 0, whose memory it needs for 20 B a grid point; the
   * result is the same on all ranks. Collective.
   */
  Bottleneck find_bottleneck(const SlabField &openness, const FlowDomain &domain);

  /** Where @p point of a field on @p layout lies, in the box [length]. */
  std::array<double, 2> position_of(const SlabLayout &layout, const GridPoint &point);

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
