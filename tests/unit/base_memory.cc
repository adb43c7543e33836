// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/memory.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

namespace
{
  constexpr std::uintptr_t large_page = 1 << 21;

  TEST(Memory, FieldsBeginOnALargePage)
  {
    for (const std::size_t n : {large_page / 8, large_page / 8 + 1, 3 * large_page})
      {
        std::vector<double> field(n, 1.);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.data()) % large_page, 0u) << n;
        field.resize(2 * n, 2.);
        EXPECT_EQ(field.front() + field.back(), 3.);
      }
  }

  TEST(Memory, WhatThereIsNotIsNull)
  {
    EXPECT_EQ(strait::allocate(std::numeric_limits<std::size_t>::max() / 2), nullptr);
    void *const nothing = strait::allocate(0);
    EXPECT_NE(nothing, nullptr);
    std::free(nothing);
  }
} // namespace
