// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/seal/transition_search.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  /** Return the distance between the two values of @p passage, relative to the larger. */
  inline double
  relative_width(const EnclosingPair &passage)
  {
    return std::abs(passage.beyond - passage.before) /
           std::max(passage.before, passage.beyond);
  }
} // namespace strait
