// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_binary_h
#define strait_surface_readers_binary_h

#include <cstddef>
#include <istream>
#include <vector>

namespace strait
{
  /** Types of numbers in binary files, all little-endian. */
  enum class NumberType
  {
    uint8,
    uint16,
    uint32,
    int8,
    int16,
    int32,
    int64,
    float32,
    float64
  };

  /** Size of a number in bytes. */
  std::size_t bytes_of(NumberType type);

  /** The number that begins at @p bytes, whatever the byte order of this machine. */
  double decode(NumberType type, const char *bytes);

  /**
   * The next @p n numbers of @p stream, decoded; the stream is in a failed state
   * if there are fewer.
   */
  std::vector<double> read_numbers(std::istream &stream, NumberType type, std::size_t n);
} // namespace strait

#endif
