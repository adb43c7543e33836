// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/clusters.h>
#include <strait/percolation/flow_path.h>

#include <limits>
#include <vector>

namespace strait
{
  /**
   * The shape of a constriction at its narrowest point, where the gap is a saddle
   *   g = g0 (1 + s²/length²) (1 − t²/width²)
   * with s along and t across the channel: the gap doubles at a distance of one
   * length along it, and would vanish at one width across it. Both come from second
   * differences of the gap on the level of the point, and are not a number where these
   * have the wrong sign for a saddle.
   *
   * Close to the walls the gap of a contact follows another law, g ~ (t0 − t)^(3/2).
   * The distance at which the gap doubles is therefore also measured, along the straight
   * line through the point in the direction of the largest second derivative: the mean of
   * both sides, not a number if either is unknown. In a saddle of that law, at any angle
   * and offset to the points, it is off by at most 0.7 % with five points from the middle
   * to the wall, and 0.2 % with ten; the length from second differences by 2.5 % and
   * 0.6 %.
   */
  struct Throat
  {
    double gap             = 0.;
    double length          = 0.;
    double width           = 0.;
    double doubling_length = std::numeric_limits<double>::quiet_NaN();

    /** The larger spacing of the points of its level [length]: a smaller one in the other
     *  direction brings the contact around the throat no closer to the true one. */
    double spacing = 0.;

    /** Number of such spacings along the channel to where the gap has doubled: infinite
     *  if it does not grow among open neighbours, 0 if closed ones leave this unknown. */
    double points = 0.;

    /** Number of spacings across the channel from wall to wall, if the gap is a parabola;
     *  not a number if it does not fall towards both walls. */
    double points_across = std::numeric_limits<double>::quiet_NaN();
  };

  /** Measure the throat at @p point of the open gap that the @p gap of a contact and the
   *  slip length leave. Collective. */
  Throat measure_throat(const SlabField &gap, double slip_length, const GridPoint &point);

  /**
   * Where fluid can flow through one gap. It is computed once, and serves the flow
   * solver, the fluid on the walls, tables and pictures.
   *
   *   const Channel channel = make_channel(gap, slip_length, domain, n_paths);
   *   if (channel.percolates()) … channel.paths.front().bottleneck …
   */
  struct Channel
  {
    Clusters clusters;

    /** The open gap of what percolates (percolating_gap()); empty if nothing does. */
    SlabField gap;

    /** Paths from inlet to outlet, that of least resistance first; at most as many as
     *  were asked for, and none if nothing percolates. */
    std::vector<FlowPath> paths;

    /** The throat at the bottleneck of the first path, if there is one. */
    Throat throat;

    /** Whether the gap leaks. */
    bool
    percolates() const
    {
      return clusters.percolates;
    }
  };

  /**
   * Find the channel in @p domain through the open gap that the @p gap of a contact and
   * @p slip_length leave. At most @p n_paths paths are searched for: 1 gives the
   * bottleneck, 0 leaves out paths and throat. If @p tells_trapped, clusters of trapped
   * fluid are told apart. Collective.
   */
  Channel make_channel(const SlabField  &gap,
                       double            slip_length,
                       const FlowDomain &domain,
                       unsigned int      n_paths,
                       bool              tells_trapped = false);

  /** A stretch of a path with one narrowest point. */
  struct Constriction
  {
    std::size_t first     = 0; // index of its first point on the path
    std::size_t last      = 0; // first of the next stretch, or last point of the path
    std::size_t narrowest = 0;
  };

  /**
   * Divide a path with the given @p gaps, at least one, into constrictions. Two minima
   * of the gap are different constrictions if the gap between them grows to more than 1.5
   * times the larger of them; the path is divided where the gap is largest.
   */
  std::vector<Constriction> divide_into_constrictions(const std::vector<double> &gaps);

  /** A constriction on one of a channel's paths. */
  struct ThroatOnPath
  {
    GridPoint point; // the narrowest
    /** Its share of the path's ∫ ds / gap³, an estimate of its pressure drop, times the
     *  ratio of the first path's integral to this one's, an estimate of the flow. */
    double fraction = 0.;
    double points   = 0.; // as Throat::points
  };

  /** List the constrictions of @p channel, which was made of @p gap and @p slip_length:
   *  path by path, from inlet to outlet. One that several paths share is listed with the
   *  first of these. Collective. */
  std::vector<ThroatOnPath>
  throats(const Channel &channel, const SlabField &gap, double slip_length);

  /**
   * The part of an open gap that the flow solver sees: its value at percolating points,
   * zero at other open points, and its value (<= 0) at closed points, so that an
   * interpolant crosses zero at the threshold. Closed values are raised to at least minus
   * the smallest positive value beside them, so that a channel one point wide stays open
   * for half a spacing to each side.
   *
   * A point on the seam belongs to the inlet and, as a copy, to the outlet; it is kept if
   * either of the two percolates. Points outside a region keep their value within two
   * spacings of a percolating point, because the gap between that and the outline is
   * interpolated from them. Each level is treated on its own points; a point that a
   * window covers takes the window's value. Collective.
   */
  SlabField
  percolating_gap(SlabField open_gap, const Clusters &clusters, const FlowDomain &domain);
} // namespace strait
