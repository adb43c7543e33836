// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/clusters.h>
#include <strait/seal/trapped_fluid.h>

#include <cstdint>
#include <map>
#include <vector>

namespace strait
{
  /**
   * Where the regions of trapped fluid are in one gap on the way to a state, how large
   * they are there, and which of them there are once the state is found.
   *
   * On the way the regions stay what they were in the state before: an open point belongs
   * to the region that owned it, whatever its cluster is joined to by now. What a trapped
   * cluster has of the reservoirs' fluid has just been cut off: a region of its own, of
   * no mass yet. What has opened in a trapped cluster belongs to the largest region in
   * it, if there is one. A region that is pressed shut keeps the points that it had.
   */
  struct RegionsInGap
  {
    /** The regions that are @p known own points; @p open_gap has the @p clusters, which
     * tell those of trapped fluid apart. All must outlive this object. Collective. */
    RegionsInGap(const TrappedFluid &known,
                 const SlabField    &open_gap,
                 const Clusters     &clusters);

    /** The mean of @p field over the widest points of each region: those that are open by
     *  half of its largest gap, where the fluid's own pressure is known. Collective. */
    std::vector<double> in_the_wide(const SlabField &field) const;

    /** What there is of trapped fluid in this gap. */
    struct Settled
    {
      TrappedFluid fluid;
      bool         has_changed = false; // regions met a reservoir, or each other
    };

    /**
     * The regions of a state that has been found, where the regions have @p pressures.
     * Splits share their mass by volume, mergers add it, what a reservoir has reached
     * forgets it, and what was cut off fills its volume at its pressure. That is a guess
     * without a past; else it has been cut off somewhere between the open gap
     * @p gap_before and this one. @p contact_modulus is that of the walls. Collective.
     */
    Settled settle(const FeedbackParameters  &parameters,
                   const std::vector<double> &pressures,
                   double                     contact_modulus,
                   const SlabField           *gap_before) const;

    /** Of a trapped cluster, what one owner had before. */
    struct Part
    {
      double volume = 0.;
      int    region = -1;
    };

    /** A trapped cluster. */
    struct Cluster
    {
      std::map<int, Part> parts;       // by owner
      int                 region = -1; // of the largest region in it
    };

    const TrappedFluid              &known;
    const SlabField                 &gap;
    const std::vector<std::int64_t> &labels;
    std::map<std::int64_t, Cluster>  trapped; // by label

    /** Of each local grid point: a region, then those just cut off; −1: none. */
    std::vector<int> region_of_point;

    /** Of each region of both kinds [length³]; 0: it is pressed shut. */
    std::vector<double> volumes;

    std::vector<double> widest; // the largest gap of each
  };
} // namespace strait
