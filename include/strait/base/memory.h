// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

namespace strait
{
  /**
   * Memory of @p size bytes, to be given to std::free(); null if there is none.
   *
   * Fields are swept over, transposed and searched: on a virtual machine as much time
   * goes into touching and finding the usual pages of 4 KB as into the work itself.
   * Where a large page fits in the system is asked for such. Results do not depend on
   * whether it heeds that. The library's operator new, which a program that is linked
   * with it has as well unless it has its own, takes its memory from here.
   */
  void *allocate(std::size_t size) noexcept;
} // namespace strait
