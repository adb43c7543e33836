// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

namespace strait
{
  /**
   * Allocate @p size bytes, to be released by std::free(); null if there is no memory.
   *
   * Fields are traversed, transposed and searched. On a virtual machine it takes as much
   * time to touch and find the usual pages of 4 kB as to do the work itself. A block that
   * holds a large page therefore asks the system for large pages; results do not depend
   * on whether it grants them. The library's operator new allocates here, also in a
   * program that links the library, unless the program defines its own.
   */
  void *allocate(std::size_t size) noexcept;
} // namespace strait
