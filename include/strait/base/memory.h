// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_memory_h
#define strait_base_memory_h

#include <cstddef>

namespace strait
{
  /**
   * Memory of @p size bytes, to be given to std::free(); null if there is none.
   *
   * Fields are swept over, transposed and searched: in the usual pages of 4 KB as much
   * time goes into touching these first and into finding them as into the work itself.
   * Where a large page fits in the system is asked for such. Results do not depend on
   * whether it heeds that. The operator new of all programs of this library takes its
   * memory from here.
   */
  void *allocate(std::size_t size) noexcept;
} // namespace strait

#endif
