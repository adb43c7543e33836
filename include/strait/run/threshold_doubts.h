// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_threshold_doubts_h
#define strait_run_threshold_doubts_h

#include <strait/base/log.h>

#include <string>
#include <vector>

namespace strait
{
  /** A load next to the one at which the contact seals. */
  struct NearThreshold
  {
    double reduced_load;     // 1 − L/L_c, positive
    double load_uncertainty; // of L_c, relative
    double points_along;     // the throat, in grid points; NaN where it is no saddle
  };

  /**
   * Why the exponent of the leak rate cannot be told from this load: words for the column
   * `status`. Warns of each, with what would help.
   */
  std::vector<std::string> doubts_near_threshold(const NearThreshold &near, Log &log);
} // namespace strait

#endif
