// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/seal/regions_in_gap.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    // Fraction of a region's volume that a reservoir may reach, and of a pressure by
    // which regions that meet may differ, without another solution. Half of it asks for
    // more solutions; double of it leaves pressures that are off by twice as much.
    constexpr double negligible = .01;

    /** Find the part of each owner in each cluster of trapped fluid. Collective. */
    std::map<std::int64_t, RegionsInGap::Cluster>
    find_parts(const RegionsInGap &in)
    {
      struct Piece
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
      std::vector<Piece> list;
      list.reserve(mine.size());
      for (const auto &[whose, volume] : mine)
        list.push_back({whose.first, whose.second, volume});
      std::map<std::int64_t, RegionsInGap::Cluster> trapped;
      for (const Piece &piece : gather_all(in.gap.layout().communicator(), list))
        trapped[piece.label].parts[piece.owner].volume += piece.volume;
      return trapped;
    }

    /** Give each part of @p trapped a region. Returns the number of all regions,
     *  including the known @p regions. */
    int
    number_regions(std::map<std::int64_t, RegionsInGap::Cluster> &trapped,
                   const std::vector<TrappedRegion>              &regions)
    {
      auto n = static_cast<int>(regions.size());
      for (auto &[label, cluster] : trapped)
        {
          // The largest by its volume before: by their present volumes, neighbouring
          // regions would change ranks from round to round.
          for (auto &[owner, part] : cluster.parts)
            if (owner >= 0)
              {
                part.region = owner;
                if (cluster.region < 0 ||
                    regions[owner].volume > regions[cluster.region].volume)
                  cluster.region = owner;
              }
            else if (owner == TrappedFluid::reservoirs)
              part.region = n++;
          if (cluster.region < 0) // no known region has a part in it
            cluster.region =
              cluster.parts.count(TrappedFluid::reservoirs) > 0 ? n - 1 : n++;
          if (const auto opened = cluster.parts.find(TrappedFluid::no_fluid);
              opened != cluster.parts.end())
            opened->second.region = cluster.region;
        }
      return n;
    }

    /** The region that @p cluster has become. */
    TrappedRegion
    merged_region(const RegionsInGap          &in,
                  const FeedbackParameters    &parameters,
                  const std::vector<double>   &pressures,
                  const RegionsInGap::Cluster &cluster,
                  const bool                   is_guess)
    {
      const auto fluid_of = [&](const std::size_t region) {
        return region < in.known.regions.size()
                 ? in.known.regions[region]
                 : TrappedRegion{in.volumes[region], pressures[region], 0., is_guess};
      };
      TrappedRegion result = fluid_of(cluster.region);
      for (const auto &[owner, part] : cluster.parts)
        result.pressure = std::max(result.pressure, fluid_of(part.region).pressure);
      result.volume = 0.;
      for (const auto &[owner, part] : cluster.parts)
        {
          const TrappedRegion region = fluid_of(part.region);
          result.volume += part.volume / in.volumes[part.region] *
                           volume_at(parameters, region, result.pressure);
          result.is_guess = result.is_guess || region.is_guess;
        }
      return result;
    }

    /** Whether regions of different pressures have become one in @p cluster. */
    bool
    meets_another(const RegionsInGap::Cluster &cluster,
                  const std::vector<double>   &pressures)
    {
      const double here = pressures[cluster.region];
      for (const auto &[owner, part] : cluster.parts)
        if (const double there = pressures[part.region];
            std::abs(here - there) >
            negligible * std::max(std::abs(here), std::abs(there)))
          return true;
      return false;
    }

    /** Compute area, mean pressure, compliances and uncertainty of @p fluid: the last is
     *  the change of the mean pressure, had all fluid just cut off kept its volume in
     *  @p gap_before. Collective. */
    void
    measure_regions(const RegionsInGap        &in,
                    const FeedbackParameters  &parameters,
                    const std::vector<double> &pressures,
                    const double               contact_modulus,
                    const SlabField           *gap_before,
                    TrappedFluid              &fluid)
    {
      // Coefficient of dV/dp = c A²/(S E*) for a region of area A and circumference S. A
      // slit or disc that is pressed open between walls in contact all around has 1.6 to
      // 1.7, and more where they are not. Half of it makes rounds overshoot; double of it
      // makes each reach half as far.
      constexpr double    compliance = 2.5;
      const PeriodicGrid &grid       = in.gap.grid();
      const double        cell       = grid.dx() * grid.dy();
      const int           nx         = grid.nx;
      const auto          n          = fluid.regions.size();
      const auto          n_known    = static_cast<int>(in.known.regions.size());
      SlabField           owner(in.gap.layout_pointer());
      std::copy(fluid.owner.begin(), fluid.owner.end(), owner.begin());
      const RowsAround rows(owner);
      // Areas, circumferences, volumes lost before being cut off; then of all open
      // points, which those of a region pressed shut are not: area, ∫p, area of guessed
      // fluid.
      std::vector<double> sums(3 * n + 3);
      for (int row = 0, k = 0; row < in.gap.layout().n_rows(); ++row)
        for (int ix = 0; ix < nx; ++ix, ++k)
          if (const double mine = owner[k]; mine >= 0)
            {
              const auto region = static_cast<std::size_t>(mine);
              sums[region] += cell;
              for (const int step : {nx - 1, 1})
                sums[n + region] += rows[row][(ix + step) % nx] != mine ? grid.dy() : 0.;
              for (const int step : {-1, 1})
                sums[n + region] += rows[row + step][ix] != mine ? grid.dx() : 0.;
              if (gap_before != nullptr && in.region_of_point[k] >= n_known)
                sums[2 * n + region] +=
                  cell * (std::max((*gap_before)[k], 0.) - in.gap[k]);
              if (in.labels[k] >= 0)
                {
                  sums[3 * n] += cell;
                  sums[3 * n + 1] += cell * pressures[in.region_of_point[k]];
                  sums[3 * n + 2] += fluid.regions[region].is_guess ? cell : 0.;
                }
            }
      sum_in_place(in.gap.layout().communicator(), sums);
      for (std::size_t p = 0; p < n; ++p)
        {
          TrappedRegion &region = fluid.regions[p];
          region.compliance =
            compliance * sums[p] * sums[p] /
            (contact_modulus * std::max(sums[n + p], std::min(grid.dx(), grid.dy())));
          TrappedRegion fuller = region;
          fuller.volume += std::abs(sums[2 * n + p]);
          if (gap_before != nullptr)
            fluid.uncertainty +=
              sums[p] / (grid.lx * grid.ly) *
              (pressure_to_hold(parameters, fuller, region.volume, region.pressure) -
               region.pressure);
        }
      fluid.pressure     = sums[3 * n] > 0 ? sums[3 * n + 1] / sums[3 * n] : 0.;
      fluid.area         = sums[3 * n] / (grid.lx * grid.ly);
      fluid.guessed_area = sums[3 * n + 2] / (grid.lx * grid.ly);
    }
  } // namespace

  RegionsInGap::RegionsInGap(const TrappedFluid &known_,
                             const SlabField    &open_gap,
                             const Clusters     &clusters)
    : known(known_)
    , gap(open_gap)
    , labels(clusters.trapped)
    , trapped(find_parts(*this))
    , region_of_point(gap.size(), -1)
    , volumes(number_regions(trapped, known.regions))
    , widest(volumes.size())
  {
    const MPI_Comm comm = gap.layout().communicator();
    const auto     n    = static_cast<int>(volumes.size());
    const double   cell = gap.grid().dx() * gap.grid().dy();
    for (std::size_t k = 0; k < gap.size(); ++k)
      {
        const auto owner = static_cast<int>(known.owner[k]);
        if (gap[k] > 0 && owner >= 0)
          region_of_point[k] = owner;
        else if (gap[k] > 0 && labels[k] >= 0)
          region_of_point[k] = trapped.at(labels[k]).parts.at(owner).region;
        if (region_of_point[k] >= 0)
          volumes[region_of_point[k]] += cell * gap[k];
      }
    sum_in_place(comm, volumes);
    for (std::size_t k = 0; k < gap.size(); ++k)
      {
        const auto owner = static_cast<int>(known.owner[k]);
        if (owner >= 0 && volumes[owner] == 0)
          region_of_point[k] = owner;
        if (const int r = region_of_point[k]; r >= 0)
          widest[r] = std::max(widest[r], gap[k]);
      }
    MPI_Allreduce(MPI_IN_PLACE, widest.data(), n, MPI_DOUBLE, MPI_MAX, comm);
  }

  std::vector<double>
  RegionsInGap::mean_over_widest_points(const SlabField &field) const
  {
    const std::size_t   n = volumes.size();
    std::vector<double> sums(2 * n);
    for (std::size_t k = 0; k < region_of_point.size(); ++k)
      if (is_widest(k))
        {
          sums[region_of_point[k]] += field[k];
          ++sums[n + region_of_point[k]];
        }
    sum_in_place(gap.layout().communicator(), sums);
    std::vector<double> means(n);
    for (std::size_t r = 0; r < n; ++r)
      means[r] = sums[n + r] > 0 ? sums[r] / sums[n + r] : 0.;
    return means;
  }

  RegionsInGap::Settled
  RegionsInGap::settle(const FeedbackParameters  &parameters,
                       const std::vector<double> &pressures,
                       const double               contact_modulus,
                       const SlabField           *gap_before) const
  {
    Settled                     settled;
    std::map<std::int64_t, int> number;                     // of a cluster's region
    std::vector<double>         left(known.regions.size()); // volume still trapped
    for (const auto &[label, cluster] : trapped)
      {
        number.emplace(label, static_cast<int>(number.size()));
        settled.fluid.regions.push_back(
          merged_region(*this, parameters, pressures, cluster, gap_before == nullptr));
        settled.has_changed = settled.has_changed || meets_another(cluster, pressures);
        for (const auto &[owner, part] : cluster.parts)
          if (static_cast<std::size_t>(part.region) < left.size())
            left[part.region] += part.volume;
      }
    std::map<int, int> still_shut;
    for (std::size_t p = 0; p < known.regions.size(); ++p)
      if (volumes[p] > 0)
        settled.has_changed |= left[p] < (1. - negligible) * volumes[p];
      else
        {
          still_shut[static_cast<int>(p)] =
            static_cast<int>(settled.fluid.regions.size());
          settled.fluid.regions.push_back(known.regions[p]);
        }
    settled.fluid.owner.resize(gap.size());
    for (std::size_t k = 0; k < gap.size(); ++k)
      {
        int owner = gap[k] > 0 ? TrappedFluid::reservoirs : TrappedFluid::no_fluid;
        if (labels[k] >= 0)
          owner = number.at(labels[k]);
        else if (const auto shut = still_shut.find(region_of_point[k]);
                 shut != still_shut.end())
          owner = shut->second;
        settled.fluid.owner[k] = static_cast<float>(owner);
      }
    measure_regions(
      *this, parameters, pressures, contact_modulus, gap_before, settled.fluid);
    return settled;
  }
} // namespace strait
