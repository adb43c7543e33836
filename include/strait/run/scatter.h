// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_scatter_h
#define strait_run_scatter_h

#include <strait/run/ensemble_tables.h>

#include <vector>

namespace strait
{
  /** Mean and standard deviation of what @p scene looks for, over @p realisations. */
  std::vector<ScatterRow> scatter_of(const std::vector<RealisationRow> &realisations,
                                     const Scene                       &scene);
} // namespace strait

#endif
