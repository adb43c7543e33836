// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_flow_in_a_row_h
#define strait_run_flow_in_a_row_h

#include <strait/seal/flow_stage.h>

namespace strait
{
  /**
   * The flow through two equal boxes, one behind the other in x. At its ends a box opens
   * on reservoirs, which let the fluid in wherever there is a gap; in the middle of two
   * it must find the way from one channel to the next. The difference of both
   * resistances is that of one box in an endless row.
   */
  class FlowInARow
  {
  public:
    /** @p fluid flows along x. @p log and @p timers must outlive this object.
     *  Collective. */
    FlowInARow(const FluidParameters &fluid,
               const SlabLayout      &layout,
               Log                   &log,
               Timers                &timers);

    /** The leak rate of two boxes with this @p gap [length]. Collective. */
    Leakage solve(const SlabField &gap, double slip_length);

    std::size_t
    memory_consumption() const
    {
      return flow.memory_consumption();
    }

  private:
    SlabLayoutPtr layout;
    FlowStage     flow;
  };
} // namespace strait

#endif
