// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/memory.h>

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>

void *
strait::allocate(const std::size_t size) noexcept
{
  // The size on most processors under Linux. Where it is another, this does no harm.
  constexpr std::size_t large_page = 1 << 21; // bytes
  if (size < large_page)
    return std::malloc(std::max<std::size_t>(size, 1));
  void *memory = nullptr;
  if (posix_memalign(&memory, large_page, size) != 0)
    return nullptr;
  madvise(memory, size, MADV_HUGEPAGE);
  return memory;
}
