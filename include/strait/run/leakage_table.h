// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_leakage_table_h
#define strait_run_leakage_table_h

#include <strait/base/scene.h>
#include <strait/base/table.h>
#include <strait/run/step.h>

namespace strait
{
  /** The table leakage.csv, with the columns of the effects that @p scene enables. */
  Table<Step> leakage_table(const Scene &scene);
} // namespace strait

#endif
