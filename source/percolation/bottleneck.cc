// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/rounding.h>
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/lattice_search.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace strait
{
  namespace
  {
    /** Number of steps from a point, @p start on its owner and none elsewhere, to the
     *  nearest closed one if @p is_open, else to the nearest open one; 0 if none exists.
     *  Collective. */
    int
    steps_to_other_side(const FlowLattice &lattice,
                        const std::size_t  start,
                        const bool         is_open)
    {
      std::vector<std::size_t> starts;
      if (start != FlowLattice::none)
        starts.push_back(start);
      LatticeSearch            search(lattice, 4);
      const LatticeSearch::End end = search.run(
        starts,
        [](std::size_t) { return 0.; },
        [](const double steps, const FlowLattice::Step &) { return steps + 1.; },
        [&](const std::size_t k) { return (lattice[k] > 0) != is_open; });

      return std::isfinite(end.cost) ? static_cast<int>(end.cost) : 0;
    }
  } // namespace

  Bottleneck
  find_bottleneck(const SlabField &openness, const FlowDomain &domain)
  {
    // The cost of a path is minus its smallest openness.
    const FlowLattice        lattice(openness, domain);
    LatticeSearch            search(lattice, 4);
    const LatticeSearch::End end = search.run(
      lattice.points_at(OutlineKind::inlet),
      [&](const std::size_t k) { return -lattice[k]; },
      [&](const double worst, const FlowLattice::Step &step) {
        return std::max(worst, -lattice[step.point]);
      },
      [&](const std::size_t k) { return lattice.is_outlet(k); });

    // +infinity: no path. Between parted walls the gap is infinite, the cost −infinity.
    constexpr double nowhere = LatticeSearch::infinity;
    if (end.cost == nowhere)
      throw InputError(
        "The contact grid is too coarse for Fluid/Mesh: no chain of grid points leads "
        "from the inlet to the outlet; raise Contact/Grid points.");
    // Several points may have this value; the first is the same on any number of ranks.
    double first = nowhere;
    for (std::size_t k = 0; k < lattice.size(); ++k)
      if (lattice.is_own(k) && -lattice[k] == end.cost && search.cost(k) == end.cost)
        first = std::min(first, static_cast<double>(lattice.global_number(k)));
    MPI_Comm          comm = lattice.communicator;
    const std::size_t k =
      lattice.own_number(static_cast<std::size_t>(minimum(comm, first)));
    std::vector<GridPoint> point; // on its owner
    if (k != FlowLattice::none)
      point.push_back(lattice.point(k));
    return {gather_all(comm, point).front(),
            -end.cost,
            steps_to_other_side(lattice, k, -end.cost > 0)};
  }

  std::array<double, 2>
  position_of(const SlabLayout &layout, const GridPoint &point)
  {
    const PeriodicGrid &grid = layout.grid();
    const auto [x, y]        = layout.position(point.window, point.ix, point.iy);
    // A window may cross the seams of the box; a point on a seam is placed at the far end
    // of the period, where the outlet is.
    const auto within = [](const double at, const double period) {
      return at - period * (std::ceil(at / period - rounding) - 1.);
    };
    return point.window < 0
             ? std::array<double, 2>{{x, y}}
             : std::array<double, 2>{{within(x, grid.lx), within(y, grid.ly)}};
  }
} // namespace strait
