// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_pools_in_gap_h
#define strait_seal_pools_in_gap_h

#include <strait/percolation/clusters.h>
#include <strait/seal/trapped_fluid.h>

#include <cstdint>
#include <map>
#include <vector>

namespace strait
{
  /**
   * Where the pools of trapped fluid are in one gap on the way to a state, how large they
   * are there, and which of them there are once the state is found.
   *
   * On the way the regions stay what they were in the state before: an open point belongs
   * to the pool that owned it, whatever its cluster is joined to by now. What a trapped
   * cluster has of the reservoirs' fluid has just been cut off: a region of its own, of
   * no mass yet. What has opened in a trapped cluster belongs to the largest pool in it,
   * if there is one. A pool that is pressed shut keeps the points that it had.
   */
  class PoolsInGap
  {
  public:
    /** The pools that are @p known own points; @p open_gap has the @p clusters, which
     * tell those of trapped fluid apart. All must outlive this object. Collective. */
    PoolsInGap(const TrappedFluid &known,
               const SlabField    &open_gap,
               const Clusters     &clusters);

    /** The region of a local grid point: a pool, then those just cut off; −1: none. */
    int
    region(const std::size_t k) const
    {
      return regions[k];
    }

    /** Of both kinds. */
    std::size_t
    n_regions() const
    {
      return volumes.size();
    }

    /** Of region @p r [length³]; 0: it is pressed shut. */
    double
    volume(const std::size_t r) const
    {
      return volumes[r];
    }

    /** The mean of @p field over the widest points of each region: those that are open by
     *  half of its largest gap, where the fluid's own pressure is known. Collective. */
    std::vector<double> in_the_wide(const SlabField &field) const;

    /** What there is of trapped fluid in this gap. */
    struct Settled
    {
      TrappedFluid fluid;
      bool         has_changed = false; // pools met a reservoir, or each other
    };

    /**
     * The pools of a state that has been found, where the regions have @p pressures.
     * Splits share their mass by volume, mergers add it, what a reservoir has reached
     * forgets it, and what was cut off fills its volume at its pressure. That is a guess
     * without a past; else it has been cut off somewhere between the open gap
     * @p gap_before and this one. @p contact_modulus is that of the walls. Collective.
     */
    Settled settle(const FeedbackParameters  &parameters,
                   const std::vector<double> &pressures,
                   double                     contact_modulus,
                   const SlabField           *gap_before) const;

  private:
    /** Of a trapped cluster, what one owner had before. */
    struct Part
    {
      double volume = 0.;
      int    region = -1;
    };

    struct Cluster
    {
      std::map<int, Part> parts;       // by owner
      int                 region = -1; // of the largest pool in it
    };

    void   find_parts();
    void   number_regions();
    void   measure();
    Pool   heir(const FeedbackParameters  &parameters,
                const std::vector<double> &pressures,
                const Cluster             &cluster,
                bool                       is_guess) const;
    bool   meets_another(const Cluster             &cluster,
                         const std::vector<double> &pressures) const;
    void   measure_pools(TrappedFluid              &fluid,
                         const std::vector<double> &pressures,
                         double                     contact_modulus) const;
    double uncertainty(const FeedbackParameters &parameters,
                       const TrappedFluid       &fluid,
                       const SlabField          &gap_before) const;

    const TrappedFluid              &known;
    const SlabField                 &gap;
    const std::vector<std::int64_t> &labels;
    std::map<std::int64_t, Cluster>  trapped; // by label
    std::vector<int>                 regions;
    std::vector<double>              volumes, widest;
  };
} // namespace strait

#endif
