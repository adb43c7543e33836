// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_checkpoint_format_h
#define strait_run_checkpoint_format_h

#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

/** What the writer and the reader of checkpoints must agree on. */
namespace strait::checkpoint_format
{
  /** The first 16 bytes of a checkpoint. */
  constexpr char signature[17] = "strait checkpnt\n";

  /** Follows the signature: tells the byte order, and whether the items have changed. */
  constexpr std::uint64_t version = 11;

  /** Bytes of a block of the checksum, and of a message at most. */
  constexpr std::size_t block = 1 << 20;

  /** The end of the file, which says that it is whole. */
  struct Trailer
  {
    std::uint64_t length;
    std::uint64_t checksum;
  };

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

  /** Whether this rank writes and reads for all. */
  inline bool
  is_root(MPI_Comm comm)
  {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank == 0;
  }

  /** Call @p piece(local pointer, size) for this rank's bytes in messages' sizes. */
  template <typename Piece>
  void
  in_pieces(void *local, const std::size_t size, const Piece &piece)
  {
    auto *bytes = static_cast<unsigned char *>(local);
    for (std::size_t at = 0; at < size; at += block)
      piece(bytes + at, std::min(block, size - at));
  }

  /** Bytes of all points of @p rank. */
  inline std::size_t
  bytes_of(const SlabLayout &layout, const int rank, const std::size_t point_size)
  {
    const int n_rows = layout.first_row_of(rank + 1) - layout.first_row_of(rank);
    return static_cast<std::size_t>(n_rows) * layout.grid().nx * point_size;
  }
} // namespace strait::checkpoint_format

#endif
