// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/run/checkpoint_format.h>
#include <strait/run/checkpoint_reader.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace strait
{
  using namespace checkpoint_format;

  CheckpointReader::CheckpointReader(const std::string &path_, MPI_Comm comm_)
    : path(path_)
    , comm(comm_)
    , on_root(is_root(comm))
  {
    run_on_root(comm, [this]() {
      file = std::fopen(path.c_str(), "rb");
      if (file == nullptr)
        throw InputError("There is no checkpoint '" + path +
                         "' to resume from; begin anew without --resume.");
      check_whole_file();
    });
  }

  CheckpointReader::~CheckpointReader()
  {
    if (file != nullptr)
      std::fclose(file);
  }

  void
  CheckpointReader::refuse() const
  {
    throw InputError("The file '" + path +
                     "' is not a whole checkpoint of this version of strait, so the run "
                     "cannot be resumed; begin anew without --resume.");
  }

  void
  CheckpointReader::check_whole_file()
  {
    constexpr std::size_t head = sizeof signature - 1 + sizeof version;
    std::error_code       failure;
    const auto            size = std::filesystem::file_size(path, failure);
    if (failure || size < head + sizeof(Trailer))
      refuse();
    const std::size_t          length   = size - sizeof(Trailer);
    std::uint64_t              checksum = 0;
    std::vector<unsigned char> data(std::min(block, length));
    for (std::size_t left = length; left > 0;)
      {
        const std::size_t n = std::min(block, left);
        if (std::fread(data.data(), 1, n, file) != n)
          refuse();
        checksum = continued_checksum(checksum, data.data(), n);
        if (left == length)
          {
            std::uint64_t found = 0;
            std::memcpy(&found, data.data() + sizeof signature - 1, sizeof found);
            if (std::memcmp(data.data(), signature, sizeof signature - 1) != 0 ||
                found != version)
              refuse();
          }
        left -= n;
      }
    Trailer trailer;
    if (std::fread(&trailer, sizeof trailer, 1, file) != 1 || trailer.length != length ||
        trailer.checksum != checksum ||
        std::fseek(file, static_cast<long>(head), SEEK_SET) != 0)
      refuse();
    remaining = length - head;
  }

  void
  CheckpointReader::value(double &number)
  {
    const std::string bytes = take_item('d');
    std::memcpy(&number, bytes.data(), sizeof number);
  }

  void
  CheckpointReader::value(std::string &text)
  {
    text = take_item('t');
  }

  void
  CheckpointReader::value(std::vector<double> &numbers)
  {
    const std::string bytes = take_item('l');
    numbers.resize(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  }

  /** For rank 0 only, as the next two. */
  void
  CheckpointReader::take(void *data, const std::size_t size)
  {
    if (size > remaining || std::fread(data, 1, size, file) != size)
      refuse();
    remaining -= size;
  }

  std::uint64_t
  CheckpointReader::take_head(const char kind)
  {
    char          found = 0;
    std::uint64_t size  = 0;
    take(&found, 1);
    take(&size, sizeof size);
    if (found != kind || size > remaining || (kind == 'd' && size != sizeof(double)))
      refuse();
    return size;
  }

  std::string
  CheckpointReader::take_item(const char kind)
  {
    std::string bytes;
    run_on_root(comm, [&]() {
      bytes.resize(take_head(kind));
      take(bytes.data(), bytes.size());
    });
    return broadcast(comm, bytes);
  }

  void
  CheckpointReader::rows(void             *local,
                         const std::size_t point_size,
                         const SlabLayout &layout)
  {
    run_on_root(comm, [&]() {
      if (take_head('f') !=
          static_cast<std::uint64_t>(layout.grid().n_points()) * point_size)
        refuse();
    });
    // The file was read before; should it fail now, the others must not wait.
    std::string failure;
    const auto  try_to_take = [&](void *data, const std::size_t size) {
      try
        {
          take(data, size);
        }
      catch (const InputError &error)
        {
          failure = error.what();
        }
    };
    const std::size_t mine = bytes_of(layout, layout.rank(), point_size);
    if (on_root)
      {
        try_to_take(local, mine);
        std::vector<unsigned char> data(block);
        for (int rank = 1; rank < layout.n_ranks(); ++rank)
          for (std::size_t left = bytes_of(layout, rank, point_size); left > 0;)
            {
              const std::size_t size = std::min(block, left);
              try_to_take(data.data(), size);
              MPI_Send(data.data(), static_cast<int>(size), MPI_BYTE, rank, 0, comm);
              left -= size;
            }
      }
    else
      in_pieces(local, mine, [&](unsigned char *data, const std::size_t size) {
        MPI_Recv(data, static_cast<int>(size), MPI_BYTE, 0, 0, comm, MPI_STATUS_IGNORE);
      });
    throw_if_any(comm, failure);
  }
} // namespace strait
