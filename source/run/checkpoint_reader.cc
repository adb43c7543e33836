// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/run/checkpoint.h>
#include <strait/run/checkpoint_format.h>

#include <filesystem>

namespace strait
{
  using namespace checkpoint_format;

  CheckpointReader::CheckpointReader(const std::string &path_, MPI_Comm comm_)
    : path(path_)
    , comm(comm_)
    , on_root(rank_in(comm) == 0)
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
    std::error_code failure;
    const auto      size = std::filesystem::file_size(path, failure);
    if (failure || size < signature.size() + sizeof(std::uint64_t))
      refuse();
    const std::size_t          length   = size - sizeof(std::uint64_t);
    std::uint64_t              checksum = 0, expected = 0;
    std::vector<unsigned char> data(block);
    for (std::size_t at = 0; at < length; at += block)
      {
        const std::size_t n = std::min(block, length - at);
        if (std::fread(data.data(), 1, n, file) != n ||
            (at == 0 &&
             std::memcmp(data.data(), signature.data(), signature.size()) != 0))
          refuse();
        checksum = continued_checksum(checksum, data.data(), n);
      }
    if (std::fread(&expected, sizeof expected, 1, file) != 1 || expected != checksum ||
        std::fseek(file, static_cast<long>(signature.size()), SEEK_SET) != 0)
      refuse();
    remaining = length - signature.size();
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
    const std::size_t row_size = layout.grid().nx * point_size;
    const int         n_bytes  = static_cast<int>(row_size);
    run_on_root(comm, [&]() {
      if (take_head('f') != layout.grid().ny * row_size)
        refuse();
      remaining -= layout.grid().ny * row_size;
    });
    // The file was read before; should it fail now, the others must not wait.
    bool       is_complete = true;
    const auto own         = [&](const int row) {
      return static_cast<unsigned char *>(local) + row * row_size;
    };
    std::vector<unsigned char> passed_on(row_size);
    for_all_rows(layout, [&](const int rank, const int row) {
      if (on_root)
        is_complete =
          std::fread(rank > 0 ? passed_on.data() : own(row), row_size, 1, file) == 1 &&
          is_complete;
      if (on_root && rank > 0)
        MPI_Send(passed_on.data(), n_bytes, MPI_BYTE, rank, 0, comm);
      if (!on_root && rank == layout.rank())
        MPI_Recv(own(row), n_bytes, MPI_BYTE, 0, 0, comm, MPI_STATUS_IGNORE);
    });
    run_on_root(comm, [&]() {
      if (!is_complete)
        refuse();
    });
  }
} // namespace strait
