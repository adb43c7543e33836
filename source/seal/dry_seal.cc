// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/timers.h>
#include <strait/seal/dry_seal.h>

#include <algorithm>
#include <utility>

namespace strait
{
  GivenGap::GivenGap(SlabField gap_)
    : gap(std::move(gap_))
  {
    SlabField open = gap;
    for (double &value : open)
      value = std::max(value, 0.);
    mean_gap = mean(open);
  }

  SealState
  GivenGap::solve(const Control &control, const SealState *, Aim)
  {
    SealState state;
    state.control   = control;
    state.given_gap = gap;
    state.mean_gap  = mean_gap;
    return state;
  }

  SealState
  DrySeal::solve(const Control &control, const SealState *from, const Aim aim)
  {
    const auto start = Timers::Clock::now();
    SealState  state;
    state.control         = control;
    state.contact         = contact->solve(control.target,
                                   from == nullptr ? nullptr : &*from->contact,
                                   nullptr,
                                   aim == Aim::throats ? Digits::half : Digits::all);
    state.mean_gap        = state.contact->mean_gap;
    state.contact_seconds = Timers::seconds_since(start);
    return state;
  }
} // namespace strait
