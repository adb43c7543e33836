// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/memory.h>

#include <cstdlib>
#include <new>

// In a file of its own, so that a program can define another operator new.

void *
operator new(const std::size_t size)
{
  if (void *const memory = strait::allocate(size))
    return memory;
  throw std::bad_alloc();
}

void
operator delete(void *const memory) noexcept
{
  std::free(memory);
}

void
operator delete(void *const memory, std::size_t) noexcept
{
  std::free(memory);
}
