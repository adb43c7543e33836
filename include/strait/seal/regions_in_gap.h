// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/percolation/clusters.h>
#include <strait/seal/trapped_fluid.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace strait
{
  /**
   * The regions of trapped fluid in one gap on the way to a state: where they are, how
   * large they are, and which of them remain once the state is found.
   *
   * On the way, the regions are those of the state before: an open point belongs to the
   * region that owned it, whatever its cluster is joined to by now. The part of a trapped
   * cluster that belonged to the reservoirs has just been cut off: it is a region of its
   * own, without a mass yet. Points that have opened in a trapped cluster belong to the
   * largest region in it, if there is one, or else to a new one. A region that is pressed
   * shut keeps its points.
   */
  struct RegionsInGap
  {
    /** @p known: the regions of the state before, and which points they own; @p clusters:
     *  those of @p open_gap, with clusters of trapped fluid told apart. All must outlive
     *  this object. Collective. */
    RegionsInGap(const TrappedFluid &known,
                 const SlabField    &open_gap,
                 const Clusters     &clusters);

    /** Whether local grid point @p k is one of the widest of its region: its gap is at
     *  least half of the largest there, and the fluid's own pressure is known. */
    bool
    is_widest(const std::size_t k) const
    {
      const int r = region_of_point[k];
      return r >= 0 && 2. * std::max(gap[k], 0.) >= widest[r];
    }

    /** Return the mean of @p field over the widest points of each region. Collective. */
    std::vector<double> mean_over_widest_points(const SlabField &field) const;

    /** The trapped fluid of a state. */
    struct Settled
    {
      TrappedFluid fluid;
      bool         has_changed = false; // regions met a reservoir, or each other
    };

    /**
     * Return the regions of a state that has been found, with @p pressures in the regions
     * on the way. Regions that split share their mass by volume, those that merge add it,
     * those that a reservoir has reached lose it, and fluid just cut off fills its volume
     * at its pressure. Without a past that is a guess; otherwise, it was cut off
     * somewhere between the open gap @p gap_before and this one. @p contact_modulus is
     * that of the walls. Collective.
     */
    Settled settle(const FeedbackParameters  &parameters,
                   const std::vector<double> &pressures,
                   double                     contact_modulus,
                   const SlabField           *gap_before) const;

    /** The part of a trapped cluster that one owner had before. */
    struct Part
    {
      double volume = 0.;
      int    region = -1;
    };

    /** A trapped cluster. */
    struct Cluster
    {
      std::map<int, Part> parts;       // by owner
      int                 region = -1; // the largest one in it
    };

    const TrappedFluid              &known;
    const SlabField                 &gap;
    const std::vector<std::int64_t> &labels;
    std::map<std::int64_t, Cluster>  trapped; // by label

    /** The region of each local grid point, −1 for none: numbers of known regions come
     *  first, then those of regions just cut off. */
    std::vector<int> region_of_point;

    /** Volume of each region of both kinds [length³]; 0: it is pressed shut. */
    std::vector<double> volumes;

    std::vector<double> widest; // the largest gap of each region
  };
} // namespace strait
