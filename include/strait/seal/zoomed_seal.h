// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_zoomed_seal_h
#define strait_seal_zoomed_seal_h

#include <strait/base/contact_parameters.h>
#include <strait/base/log.h>
#include <strait/seal/seal_state.h>

namespace strait
{
  /**
   * A dry @p seal whose throats are resolved: where a channel percolates, the state gets
   * the windows that its throats lack, one level after the other, and is solved again.
   * Where none does, so does the barrier where it is weakest, for on finer points it may
   * be open. For a leak rate half of the digits are enough while windows are sought, the
   * state that is returned has all of them. The state keeps those of the state that it
   * came from, so that neighbouring states have the same points. The reference must
   * outlive the model.
   */
  SealModel zoomed_seal(SealModel             seal,
                        const ZoomParameters &zoom,
                        FlowDirection         direction,
                        Log                  &log);
} // namespace strait

#endif
