// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_percolation_flow_domain_h
#define strait_percolation_flow_domain_h

#include <strait/base/fluid_parameters.h>

#include <memory>
#include <utility>

namespace strait
{
  class FlowRegion;

  /** Where the fluid flows: from side to side of the box, which is periodic across the
   *  flow, or from inlet to outlet of a region of it. */
  struct FlowDomain
  {
    FlowDomain(const FlowDirection direction_) // of the whole box
      : direction(direction_)
    {
    }

    FlowDomain(std::shared_ptr<const FlowRegion> region_)
      : region(std::move(region_))
    {
    }

    FlowDirection                     direction = FlowDirection::x;
    std::shared_ptr<const FlowRegion> region; // null: the whole box
  };
} // namespace strait

#endif
