// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

namespace strait
{
  /** Bytes on the heap that operator new has allocated and that are not yet freed. */
  std::size_t allocated_memory();

  /** The largest allocated_memory() since the last forget_most_allocated_memory(). */
  std::size_t most_allocated_memory();
  void        forget_most_allocated_memory();
} // namespace strait
