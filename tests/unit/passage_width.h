// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/seal/transition_search.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  /** How far the ends of @p passage are apart, in parts of the larger one. */
  inline double
  relative_width(const EnclosingPair &passage)
  {
    return std::abs(passage.beyond - passage.before) /
           std::max(passage.before, passage.beyond);
  }
} // namespace strait
