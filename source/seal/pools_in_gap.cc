// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/seal/pools_in_gap.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    // Of a pool's volume, that a reservoir may reach, and of a pressure, by which pools
    // that meet may differ, without another solution. Half of it asks for more of them,
    // double of it leaves pressures that are as much off.
    constexpr double negligible = .01;

    /** What each cluster of trapped fluid has of each owner. Collective. */
    std::map<std::int64_t, PoolsInGap::Cluster>
    find_parts(const PoolsInGap &in)
    {
      struct Share
      {
        std::int64_t label;
        int          owner;
        double       volume;
      };
      const double cell = in.gap.grid().dx() * in.gap.grid().dy();
      std::map<std::pair<std::int64_t, int>, double> mine; // by label and owner
      for (std::size_t k = 0; k < in.labels.size(); ++k)
        if (in.labels[k] >= 0)
          mine[{in.labels[k], static_cast<int>(in.known.owner[k])}] += cell * in.gap[k];
      std::vector<Share> list;
      list.reserve(mine.size());
      for (const auto &[whose, volume] : mine)
        list.push_back({whose.first, whose.second, volume});
      std::map<std::int64_t, PoolsInGap::Cluster> trapped;
      for (const Share &share : gather_all(in.gap.layout().communicator(), list))
        trapped[share.label].parts[share.owner].volume += share.volume;
      return trapped;
    }

    /** Give all parts of @p trapped a region. Returns how many there are with those of
     *  the @p pools. */
    int
    number_regions(std::map<std::int64_t, PoolsInGap::Cluster> &trapped,
                   const std::vector<Pool>                     &pools)
    {
      auto n = static_cast<int>(pools.size());
      for (auto &[label, cluster] : trapped)
        {
          // The largest by what it held before: its volume now would change places with
          // that of a pool beside it from round to round.
          for (auto &[owner, part] : cluster.parts)
            if (owner >= 0)
              {
                part.region = owner;
                if (cluster.region < 0 ||
                    pools[owner].volume > pools[cluster.region].volume)
                  cluster.region = owner;
              }
            else if (owner == TrappedFluid::reservoirs)
              part.region = n++;
          if (cluster.region < 0) // no pool has any of it
            cluster.region =
              cluster.parts.count(TrappedFluid::reservoirs) > 0 ? n - 1 : n++;
          if (const auto opened = cluster.parts.find(TrappedFluid::no_fluid);
              opened != cluster.parts.end())
            opened->second.region = cluster.region;
        }
      return n;
    }

    /** The pool that @p cluster has become. */
    Pool
    heir(const PoolsInGap          &in,
         const FeedbackParameters  &parameters,
         const std::vector<double> &pressures,
         const PoolsInGap::Cluster &cluster,
         const bool                 is_guess)
    {
      const auto pool_of = [&](const std::size_t region) {
        return region < in.known.pools.size()
                 ? in.known.pools[region]
                 : Pool{in.volumes[region], pressures[region], 0., is_guess};
      };
      Pool result = pool_of(cluster.region);
      for (const auto &[owner, part] : cluster.parts)
        result.pressure = std::max(result.pressure, pool_of(part.region).pressure);
      result.volume = 0.;
      for (const auto &[owner, part] : cluster.parts)
        {
          const Pool pool = pool_of(part.region);
          result.volume += part.volume / in.volumes[part.region] *
                           volume_at(parameters, pool, result.pressure);
          result.is_guess = result.is_guess || pool.is_guess;
        }
      return result;
    }

    /** Whether pools of other pressures have become one in @p cluster. */
    bool
    meets_another(const PoolsInGap::Cluster &cluster,
                  const std::vector<double> &pressures)
    {
      const double here = pressures[cluster.region];
      for (const auto &[owner, part] : cluster.parts)
        if (const double there = pressures[part.region];
            std::abs(here - there) >
            negligible * std::max(std::abs(here), std::abs(there)))
          return true;
      return false;
    }

    /** Area, mean pressure and compliance; and the change of the mean pressure, had all
     *  that was cut off kept the volume that it had in @p gap_before. Collective. */
    void
    measure_pools(const PoolsInGap          &in,
                  const FeedbackParameters  &parameters,
                  const std::vector<double> &pressures,
                  const double               contact_modulus,
                  const SlabField           *gap_before,
                  TrappedFluid              &fluid)
    {
      // A slit or disc of area A and circumference S that is pressed open between walls
      // in contact all around has dV/dp = 1.6 to 1.7 A²/(S E*), and more where they are
      // not. Half of it makes rounds overshoot, double of it makes each reach half as
      // far.
      constexpr double    compliance = 2.5;
      const PeriodicGrid &grid       = in.gap.grid();
      const double        cell       = grid.dx() * grid.dy();
      const int           nx         = grid.nx;
      const auto          n          = fluid.pools.size();
      const auto          n_known    = static_cast<int>(in.known.pools.size());
      SlabField           owner(in.gap.layout_pointer());
      std::copy(fluid.owner.begin(), fluid.owner.end(), owner.begin());
      const RowsAround rows(owner);
      // Areas, circumferences, what each lost before it was cut off, ∫p.
      std::vector<double> sums(3 * n + 1);
      for (int row = 0, k = 0; row < in.gap.layout().n_rows(); ++row)
        for (int ix = 0; ix < nx; ++ix, ++k)
          if (const double mine = owner[k]; mine >= 0)
            {
              const auto pool = static_cast<std::size_t>(mine);
              sums[pool] += cell;
              for (const int step : {nx - 1, 1})
                sums[n + pool] += rows[row][(ix + step) % nx] != mine ? grid.dy() : 0.;
              for (const int step : {-1, 1})
                sums[n + pool] += rows[row + step][ix] != mine ? grid.dx() : 0.;
              if (gap_before != nullptr && in.regions[k] >= n_known)
                sums[2 * n + pool] += cell * (std::max((*gap_before)[k], 0.) - in.gap[k]);
              sums[3 * n] += cell * pressures[in.regions[k]];
            }
      sum_in_place(in.gap.layout().communicator(), sums);
      for (std::size_t p = 0; p < n; ++p)
        {
          Pool &pool = fluid.pools[p];
          pool.compliance =
            compliance * sums[p] * sums[p] /
            (contact_modulus * std::max(sums[n + p], std::min(grid.dx(), grid.dy())));
          fluid.area += sums[p];
          fluid.guessed_area += pool.is_guess ? sums[p] : 0.;
          Pool fuller = pool;
          fuller.volume += std::abs(sums[2 * n + p]);
          if (gap_before != nullptr)
            fluid.uncertainty +=
              sums[p] / (grid.lx * grid.ly) *
              (pressure_to_hold(parameters, fuller, pool.volume, pool.pressure) -
               pool.pressure);
        }
      fluid.pressure = fluid.area > 0 ? sums[3 * n] / fluid.area : 0.;
      fluid.area /= grid.lx * grid.ly;
      fluid.guessed_area /= grid.lx * grid.ly;
    }
  } // namespace

  PoolsInGap::PoolsInGap(const TrappedFluid &known_,
                         const SlabField    &open_gap,
                         const Clusters     &clusters)
    : known(known_)
    , gap(open_gap)
    , labels(clusters.trapped)
    , trapped(find_parts(*this))
    , regions(gap.size(), -1)
    , volumes(number_regions(trapped, known.pools))
    , widest(volumes.size())
  {
    const MPI_Comm comm = gap.layout().communicator();
    const auto     n    = static_cast<int>(volumes.size());
    const double   cell = gap.grid().dx() * gap.grid().dy();
    for (std::size_t k = 0; k < gap.size(); ++k)
      {
        const auto owner = static_cast<int>(known.owner[k]);
        if (gap[k] > 0 && owner >= 0)
          regions[k] = owner;
        else if (gap[k] > 0 && labels[k] >= 0)
          regions[k] = trapped.at(labels[k]).parts.at(owner).region;
        if (regions[k] >= 0)
          volumes[regions[k]] += cell * gap[k];
      }
    sum_in_place(comm, volumes);
    for (std::size_t k = 0; k < gap.size(); ++k)
      {
        const auto owner = static_cast<int>(known.owner[k]);
        if (owner >= 0 && volumes[owner] == 0)
          regions[k] = owner;
        if (const int r = regions[k]; r >= 0)
          widest[r] = std::max(widest[r], gap[k]);
      }
    MPI_Allreduce(MPI_IN_PLACE, widest.data(), n, MPI_DOUBLE, MPI_MAX, comm);
  }

  std::vector<double>
  PoolsInGap::in_the_wide(const SlabField &field) const
  {
    const std::size_t   n = volumes.size();
    std::vector<double> sums(2 * n);
    for (std::size_t k = 0; k < regions.size(); ++k)
      if (const int r = regions[k]; r >= 0 && 2. * std::max(gap[k], 0.) >= widest[r])
        {
          sums[r] += field[k];
          ++sums[n + r];
        }
    sum_in_place(gap.layout().communicator(), sums);
    std::vector<double> means(n);
    for (std::size_t r = 0; r < n; ++r)
      means[r] = sums[n + r] > 0 ? sums[r] / sums[n + r] : 0.;
    return means;
  }

  PoolsInGap::Settled
  PoolsInGap::settle(const FeedbackParameters  &parameters,
                     const std::vector<double> &pressures,
                     const double               contact_modulus,
                     const SlabField           *gap_before) const
  {
    Settled                     settled;
    std::map<std::int64_t, int> number;                   // of the pool of a cluster
    std::vector<double>         left(known.pools.size()); // of pools that are trapped
    for (const auto &[label, cluster] : trapped)
      {
        number.emplace(label, static_cast<int>(number.size()));
        settled.fluid.pools.push_back(
          heir(*this, parameters, pressures, cluster, gap_before == nullptr));
        settled.has_changed = settled.has_changed || meets_another(cluster, pressures);
        for (const auto &[owner, part] : cluster.parts)
          if (static_cast<std::size_t>(part.region) < left.size())
            left[part.region] += part.volume;
      }
    std::map<int, int> still_shut;
    for (std::size_t p = 0; p < known.pools.size(); ++p)
      if (volumes[p] > 0)
        settled.has_changed |= left[p] < (1. - negligible) * volumes[p];
      else
        {
          still_shut[static_cast<int>(p)] = static_cast<int>(settled.fluid.pools.size());
          settled.fluid.pools.push_back(known.pools[p]);
        }
    settled.fluid.owner.resize(gap.size());
    for (std::size_t k = 0; k < gap.size(); ++k)
      {
        int owner = gap[k] > 0 ? TrappedFluid::reservoirs : TrappedFluid::no_fluid;
        if (labels[k] >= 0)
          owner = number.at(labels[k]);
        else if (const auto shut = still_shut.find(regions[k]); shut != still_shut.end())
          owner = shut->second;
        settled.fluid.owner[k] = static_cast<float>(owner);
      }
    measure_pools(
      *this, parameters, pressures, contact_modulus, gap_before, settled.fluid);
    return settled;
  }
} // namespace strait
