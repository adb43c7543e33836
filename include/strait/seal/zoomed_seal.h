// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_zoomed_seal_h
#define strait_seal_zoomed_seal_h

#include <strait/base/contact_parameters.h>
#include <strait/base/log.h>
#include <strait/percolation/flow_region.h>
#include <strait/seal/seal_model.h>

#include <memory>
#include <utility>
#include <vector>

namespace strait
{
  /**
   * A dry seal whose throats are resolved: where a channel percolates, the state gets the
   * windows that its throats lack, one level after the other, and is solved again. Where
   * none does, so does the barrier where it is weakest, for on finer points it may be
   * open. For a leak rate half of the digits are enough while windows are sought, the
   * state that is returned has all of them. The state keeps those of the state that it
   * came from, so that neighbouring states have the same points.
   */
  class ZoomedSeal : public SealModel
  {
  public:
    /** @p log must outlive this object. */
    ZoomedSeal(std::unique_ptr<SealModel> seal_,
               const ZoomParameters      &zoom_,
               const FlowDirection        direction_,
               Log                       &log_)
      : seal(std::move(seal_))
      , zoom(zoom_)
      , direction(direction_)
      , log(log_)
    {
    }

    SealState solve(const Control &control, const SealState *from, Aim aim) override;

    bool
    depends_on_path() const override
    {
      return seal->depends_on_path();
    }

  private:
    /** The windows that @p state should have for @p aim. Once none is lacking those that
     *  are not needed are left out, unless @p is_trimmed, which is then set. Collective.
     */
    std::vector<ZoomWindow>
    windows_for(const SealState &state, Aim aim, bool &is_trimmed) const;

    std::unique_ptr<SealModel> seal;
    const ZoomParameters       zoom;
    const FlowDirection        direction;
    Log                       &log;
  };
} // namespace strait

#endif
