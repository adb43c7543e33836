// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/solution_on_grid.h>
#include <strait/seal/wall_pressure.h>

#include <algorithm>
#include <utility>

namespace strait
{
  void
  UnsettledPools::note(const std::vector<NodeState> &now)
  {
    const bool is_first = was_pool.empty();
    before.resize(now.size(), NodeState::closed);
    was_pool.resize(now.size());
    n_changes.resize(now.size());
    for (std::size_t k = 0; k < now.size(); ++k)
      {
        const std::uint8_t is_pool = now[k] == NodeState::trapped ? 1 : 0;
        if (!is_first && is_pool != was_pool[k] && n_changes[k] <= changes_allowed)
          ++n_changes[k];
        was_pool[k] = is_pool;
        if (is_pool == 0)
          before[k] = now[k];
      }
  }

  WallPressure::WallPressure(HarmonicExtension &extension_,
                             const double       pool_pressure_,
                             const bool         has_start_)
    : extension(extension_)
    , pool_pressure(pool_pressure_)
    , has_start(has_start_)
  {
  }

  void
  WallPressure::update(SlabField             &pressure,
                       const StepFlow        &flow,
                       SlabField              open,
                       const FluidParameters &fluid)
  {
    const std::vector<NodeState> &states = flow.channel.clusters.states;
    pools.note(states);
    const double            inlet = fluid.inlet_pressure;
    const double            drop  = inlet - fluid.outlet_pressure;
    const GridDeposit::Sums channel =
      flow.solution ? pressure_on_grid(*flow.solution, pressure.layout_pointer())
                    : GridDeposit::Sums();
    for (std::size_t k = 0; k < pressure.size(); ++k)
      switch (pools.contains(k) ? pools.state_before(k) : states[k])
        {
          case NodeState::percolating:
            if (pools.contains(k))
              break; // it keeps what it had when it was cut off
            // On the seam the channel may reach one side only; see extend().
            pressure[k] = channel.area.empty() || channel.area[k] == 0
                            ? inlet
                            : inlet - drop * (1. - channel.integral[k] / channel.area[k]);
            break;
          case NodeState::inlet_side:
            pressure[k] = inlet;
            break;
          case NodeState::outlet_side:
            pressure[k] = fluid.outlet_pressure;
            break;
          case NodeState::trapped:
          case NodeState::outside: // there is none of them in the box
            pressure[k] = pool_pressure;
            break;
          case NodeState::closed:
            if (!has_start)
              pressure[k] = .5 * (inlet + fluid.outlet_pressure);
            open[k] = std::min(open[k], 0.);
            break;
        }
    has_start = true;
    // The next round starts from here, so that no more is needed than to come nearer.
    // With half of it each round takes an iteration or so more, with double of it fewer,
    // and more rounds until the pressure under the contact has followed.
    constexpr double reduction = 1e-3;
    extension.extend(pressure, open, inlet, fluid.outlet_pressure, reduction);
  }
} // namespace strait
