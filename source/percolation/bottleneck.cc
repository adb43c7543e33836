// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/clusters.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace strait
{
  namespace
  {
    /** Flood from the inlet, always over the most open point of the shore. */
    Bottleneck
    flood(const FlowLattice &lattice)
    {
      using Entry = std::pair<double, std::size_t>;
      std::priority_queue<Entry> shore;
      std::vector<bool>          reached(lattice.size(), false);
      const auto                 reach = [&](const std::size_t k) {
        if (!reached[k])
          {
            reached[k] = true;
            shore.emplace(lattice[k], k);
          }
      };
      for (const std::size_t k : lattice.inlet_points())
        reach(k);

      Bottleneck worst{{}, std::numeric_limits<double>::infinity()};
      while (!shore.empty())
        {
          const auto [value, k] = shore.top();
          shore.pop();
          if (value < worst.value)
            worst = {lattice.point(k), value};
          const int a = lattice.along(k), b = lattice.across_of(k);
          if (lattice.is_outlet(k))
            return worst;
          for (const auto &[da, db] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
            if (lattice.can_step(k, da, db))
              reach(lattice.index(a + da, b + db));
        }
      throw InputError(
        "The contact grid is too coarse for Fluid/Mesh: no chain of grid points leads "
        "from the inlet to the outlet; raise Contact/Grid points.");
    }

    std::size_t
    widest_between(const std::vector<double> &gaps,
                   const std::size_t          a,
                   const std::size_t          b)
    {
      const auto first = gaps.begin() + static_cast<std::ptrdiff_t>(a);
      const auto last  = gaps.begin() + static_cast<std::ptrdiff_t>(b) + 1;
      return static_cast<std::size_t>(std::max_element(first, last) - gaps.begin());
    }
  } // namespace

  Bottleneck
  find_bottleneck(const SlabField &openness, const FlowDomain &domain)
  {
    MPI_Comm                  comm  = openness.layout().communicator();
    const std::vector<double> whole = gather_on_root(openness);
    Bottleneck                result;
    run_on_root(comm,
                [&]() { result = flood(FlowLattice(whole, openness.grid(), domain)); });
    MPI_Bcast(&result.point, 2, MPI_INT, 0, comm);
    MPI_Bcast(&result.value, 1, MPI_DOUBLE, 0, comm);
    return result;
  }

  std::array<double, 2>
  position_of(const SlabLayout &layout, const GridPoint &point)
  {
    const PeriodicGrid &grid = layout.grid();
    auto [x, y]              = layout.position(point.window, point.ix, point.iy);
    if (point.window >= 0) // which may cross the seam
      {
        x -= grid.lx * std::floor(x / grid.lx);
        y -= grid.ly * std::floor(y / grid.ly);
      }
    return {x, y};
  }

  Throat
  measure_throat(const SlabField &gap, const double slip_length, const GridPoint &point)
  {
    const PeriodicGrid       &grid = gap.grid();
    const std::vector<double> rows =
      fetch_rows(gap, {point.iy - 1, point.iy, point.iy + 1});
    const auto g = [&](const int i, const int j) {
      const int column = (point.ix + i + grid.nx) % grid.nx;
      return open_gap(rows[static_cast<std::size_t>(j + 1) * grid.nx + column],
                      slip_length);
    };
    const double g0 = g(0, 0);
    const double xx = (g(1, 0) - 2 * g0 + g(-1, 0)) / (grid.dx() * grid.dx());
    const double yy = (g(0, 1) - 2 * g0 + g(0, -1)) / (grid.dy() * grid.dy());
    const double xy =
      (g(1, 1) - g(1, -1) - g(-1, 1) + g(-1, -1)) / (4 * grid.dx() * grid.dy());
    const double middle = .5 * (xx + yy);
    const double radius = std::hypot(.5 * (xx - yy), xy);
    const double along = middle + radius, across = middle - radius;

    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {g0,
            along > 0 ? std::sqrt(2 * g0 / along) : unknown,
            across < 0 ? std::sqrt(-2 * g0 / across) : unknown};
  }

  std::vector<Constriction>
  divide_into_constrictions(const std::vector<double> &gaps)
  {
    // Half of it, that is any widening at all, counts the same throat as several; double
    // of it several as one. It matters to the report only.
    constexpr double         distinct = 1.5;
    std::vector<std::size_t> minima;
    for (std::size_t k = 0; k < gaps.size(); ++k)
      {
        // Join this point to the minimum before it, unless the channel has widened.
        if (minima.empty())
          {
            minima.push_back(k);
            continue;
          }
        const double widest = gaps[widest_between(gaps, minima.back(), k)];
        if (widest > distinct * std::max(gaps[minima.back()], gaps[k]))
          minima.push_back(k);
        else if (gaps[k] < gaps[minima.back()])
          minima.back() = k;
        // A narrower point may make two minima before it one.
        while (minima.size() > 1)
          {
            const std::size_t last = minima.back(), before = minima[minima.size() - 2];
            if (gaps[widest_between(gaps, before, last)] >
                distinct * std::max(gaps[before], gaps[last]))
              break;
            minima.pop_back();
            minima.back() = gaps[last] < gaps[before] ? last : before;
          }
      }

    std::vector<Constriction> result;
    for (std::size_t m = 0; m < minima.size(); ++m)
      {
        const std::size_t first = m == 0 ? 0 : result.back().last;
        const std::size_t last  = m + 1 == minima.size()
                                    ? gaps.size() - 1
                                    : widest_between(gaps, minima[m], minima[m + 1]);
        result.push_back({first, last});
      }
    return result;
  }
} // namespace strait
