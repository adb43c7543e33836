// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_checkpoint_format_h
#define strait_run_checkpoint_format_h

#include <strait/spectral/slab_layout.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

/** What the writer and the reader of checkpoints must agree on. */
namespace strait::checkpoint_format
{
  /** The first bytes of a checkpoint. The number is another one whenever the items have
   *  changed. */
  inline const std::string signature = "strait checkpoint 12\n";

  /** Bytes of a block of the checksum. */
  constexpr std::size_t block = 1 << 20;

  /** FNV-1a on words of 8 bytes, the last one padded with zeros. */
  inline std::uint64_t
  continued_checksum(std::uint64_t checksum, const unsigned char *data, std::size_t size)
  {
    for (std::size_t at = 0; at < size; at += 8)
      {
        std::uint64_t word = 0;
        std::memcpy(&word, data + at, std::min<std::size_t>(8, size - at));
        checksum = (checksum ^ word) * 0x100000001b3ULL;
        checksum ^= checksum >> 29;
      }
    return checksum;
  }

  /** Call @p visit(rank, row of that rank) for all rows of the grid in their order. */
  template <typename Visit>
  void
  for_all_rows(const SlabLayout &layout, const Visit &visit)
  {
    for (int rank = 0; rank < layout.n_ranks(); ++rank)
      for (int row = layout.first_row_of(rank); row < layout.first_row_of(rank + 1);
           ++row)
        visit(rank, row - layout.first_row_of(rank));
  }
} // namespace strait::checkpoint_format

#endif
