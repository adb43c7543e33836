// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait
{
  /** How far, relative, two numbers may be apart that would be the same if sums of
   * doubles and texts of nine digits were exact. Half and double of it decide alike. */
  inline constexpr double rounding = 1e-9;
} // namespace strait
