// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_adhesion_tables_h
#define strait_driver_adhesion_tables_h

#include <strait/seal/path.h>

#include <string>
#include <vector>

namespace strait
{
  /** Write jumps.csv: one row for each jump. Call on rank 0 only. */
  void write_jumps(const std::string &path, const std::vector<Jump> &jumps);

  /** Write relaxation-STEP.csv. Call on rank 0 only. */
  void write_relaxation(const std::string                 &path,
                        const std::vector<RelaxationStep> &relaxation);
} // namespace strait

#endif
