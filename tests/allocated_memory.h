// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

namespace strait
{
  /** Bytes on the heap that operator new gave and that were not given back. */
  std::size_t allocated_memory();

  /** The most since the last forget_most_allocated_memory(). */
  std::size_t most_allocated_memory();
  void        forget_most_allocated_memory();
} // namespace strait
