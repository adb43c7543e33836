// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_flow_in_a_row_h
#define strait_run_flow_in_a_row_h

#include <strait/spectral/slab_field.h>

namespace strait
{
  /**
   * The gap of two equal boxes, one behind the other in x. At its ends a box opens on
   * reservoirs, which let the fluid in wherever there is a gap; in the middle of two it
   * must find the way from one channel to the next. The difference of the resistances of
   * two and one is that of one box in an endless row.
   */
  SlabField two_in_a_row(const SlabField &gap);
} // namespace strait

#endif
