// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/percolation/bottleneck.h>

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
      for (int b = 0; b < lattice.n_across(); ++b)
        reach(lattice.index(0, b));

      Bottleneck worst{{}, std::numeric_limits<double>::infinity()};
      while (true)
        {
          const auto [value, k] = shore.top();
          shore.pop();
          if (value < worst.value)
            worst = {lattice.point(k), value};
          const int a = lattice.along(k), b = lattice.across_of(k);
          if (a == lattice.width() - 1)
            return worst;
          reach(lattice.index(a + 1, b));
          if (a > 0)
            reach(lattice.index(a - 1, b));
          reach(lattice.index(a, b + 1));
          reach(lattice.index(a, b - 1));
        }
    }
  } // namespace

  Bottleneck
  find_bottleneck(const SlabField &openness, const FlowDirection direction)
  {
    MPI_Comm                  comm  = openness.layout().communicator();
    const std::vector<double> whole = gather_on_root(openness);
    Bottleneck                result;
    run_on_root(comm, [&]() {
      result = flood(FlowLattice(whole, openness.grid(), direction));
    });
    MPI_Bcast(&result.point, 2, MPI_INT, 0, comm);
    MPI_Bcast(&result.value, 1, MPI_DOUBLE, 0, comm);
    return result;
  }
} // namespace strait
