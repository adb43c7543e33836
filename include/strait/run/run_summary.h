// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/seal/transition_search.h>

#include <cmath>
#include <string>

namespace strait
{
  /** The summary of a run, beside its files. */
  struct RunSummary
  {
    bool        converged = true; // all steps and searches
    std::string status    = "ok"; // words of all steps
    std::string validity  = "ok"; // likewise

    /** The critical load at the first slip length, if the scene looks for it. */
    Transition threshold = {0., std::nan(""), std::nan(""), std::nan("")};
  };
} // namespace strait
