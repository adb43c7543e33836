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

    /** Of the points of its level, in the direction in which it is larger: points that
     *  are close to each other in the other one bring the contact around the throat no
     *  nearer to the true one. */
    double spacing = 0.;

    /** Such spacings from there to where the gap has doubled: 0 if the points do
     *  not tell, infinite if the gap does not grow along the channel. */
    double points = 0.;

    /** Points across the channel from wall to wall, of a parabola; not a number if the
     * gap does not fall towards both. */
    double points_across = std::numeric_limits<double>::quiet_NaN();
  };

  /** The throat at @p point of the open gap of a contact's @p gap. Collective. */
  Throat measure_throat(const SlabField &gap, double slip_length, const GridPoint &point);
  /**
   * Where a fluid can flow through one gap, found once and then asked by all: flow,
   * the fluid on the walls, tables and pictures.
   *
   *   const Channel channel = make_channel(gap, slip_length, domain, n_paths);
   *   if (channel.percolates()) … channel.paths.front().bottleneck …
   */
  struct Channel
  {
    Clusters clusters;

    /** The open gap of what percolates (percolating_gap()); empty where nothing does. */
    SlabField gap;

    /** Ways from inlet to outlet, that of least resistance first; no more than were
     *  asked for, and none where nothing percolates. */
    std::vector<FlowPath> paths;

    /** At the bottleneck of the first path, if there is one. */
    Throat throat;

    /** Whether the gap leaks. */
    bool
    percolates() const
    {
      return clusters.percolates;
    }
  };

  /**
   * The channel of @p gap as the contact leaves it, in @p domain, with at most @p n_paths
   * paths: 1 tells the bottleneck, 0 only the verdict and the clusters, those of trapped
   * fluid if @p tells_trapped. Collective.
   */
  Channel make_channel(const SlabField  &gap,
                       double            slip_length,
                       const FlowDomain &domain,
                       unsigned int      n_paths,
                       bool              tells_trapped = false);

  /** A stretch of a path with one narrowest point. */
  struct Constriction
  {
    std::size_t first     = 0; // position on the path
    std::size_t last      = 0; // the first of the next stretch, or the end of the path
    std::size_t narrowest = 0;
  };

  /**
   * Divide a path with the given @p gaps, one at least, into constrictions. Two minima
   * of the gap are different constrictions if the channel between them widens to more
   * than 1.5 times the gap of the wider one; they are divided where it is widest.
   */
  std::vector<Constriction> divide_into_constrictions(const std::vector<double> &gaps);

  /** A constriction on one of a channel's paths. */
  struct ThroatOnPath
  {
    GridPoint point; // the narrowest
    /** Its part of the path's ∫ ds / gap³, an estimate of the pressure drop, times that
     *  of the first path over this one's, an estimate of the flow. */
    double fraction = 0.;
    double points   = 0.; // of its level along it, as of Throat
  };

  /** The constrictions of @p channel through @p gap at the slip length @p slip_length,
   *  path after path from inlet to outlet; one that several paths pass is listed with the
   *  first. Collective. */
  std::vector<ThroatOnPath>
  throats(const Channel &channel, const SlabField &gap, double slip_length);

  /**
   * What the flow solver may see of an open gap: its value at percolating points, zero at
   * other open points, and the value itself (<= 0) at closed points, so that an
   * interpolant crosses zero where the threshold lies. Closed values are raised to no
   * less than minus the smallest percolating gap beside them: a channel one point wide
   * stays open for half a spacing to each side.
   *
   * A point on the seam belongs to the inlet and, as a copy, to the outlet; it is kept if
   * either of the two percolates. Points outside a region that are no more than two
   * spacings from a percolating one keep their value, since the gap between that and the
   * outline is interpolated with them. All this holds on each level among its own points;
   * a point that a window covers has the window's value. Collective.
   */
  SlabField
  percolating_gap(SlabField open_gap, const Clusters &clusters, const FlowDomain &domain);
} // namespace strait
