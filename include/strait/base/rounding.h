// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait
{
  /** The relative difference up to which two numbers count as equal: sums of doubles, and
   *  numbers written with nine digits, are not exact. Half and double of it give the same
   *  decisions. */
  inline constexpr double rounding = 1e-9;
} // namespace strait
