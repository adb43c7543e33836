// SPDX-License-Identifier: GPL-2.0-or-later
#include "allocated_memory.h"

#include <strait/base/memory.h>

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
  std::atomic<std::size_t> allocated{0}, most{0};
}

void *
operator new(const std::size_t size)
{
  void *memory = strait::allocate(size);
  if (memory == nullptr)
    throw std::bad_alloc();
  const std::size_t now = allocated += malloc_usable_size(memory);
  most                  = std::max<std::size_t>(most, now);
  return memory;
}

void *
operator new(const std::size_t size, const std::nothrow_t &) noexcept
{
  try
    {
      return operator new(size);
    }
  catch (const std::bad_alloc &)
    {
      return nullptr;
    }
}

void
operator delete(void *memory) noexcept
{
  allocated -= malloc_usable_size(memory);
  std::free(memory);
}

void
operator delete(void *memory, std::size_t) noexcept
{
  operator delete(memory);
}

namespace strait
{
  std::size_t
  allocated_memory()
  {
    return allocated;
  }

  std::size_t
  most_allocated_memory()
  {
    return most;
  }

  void
  forget_most_allocated_memory()
  {
    most = allocated.load();
  }
} // namespace strait
