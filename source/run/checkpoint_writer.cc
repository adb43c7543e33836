// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/run/checkpoint.h>
#include <strait/run/checkpoint_format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace strait
{
  using namespace checkpoint_format;

  namespace
  {
    std::string
    name_beside(const std::string &path)
    {
      return path + ".new";
    }

    /** Until a renamed file is safe, its folder must be as well. */
    void
    sync_folder_of(const std::string &path)
    {
      const auto folder = std::filesystem::absolute(path).parent_path();
      const int  file   = open(folder.c_str(), O_RDONLY);
      if (file < 0)
        return;
      fsync(file);
      close(file);
    }
  } // namespace

  CheckpointWriter::CheckpointWriter(const std::string &path_, MPI_Comm comm_)
    : path(path_)
    , comm(comm_)
    , on_root(rank_in(comm) == 0)
  {
    if (!on_root)
      return;
    file = open(name_beside(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0)
      error = errno;
    put(signature.data(), signature.size());
  }

  CheckpointWriter::~CheckpointWriter()
  {
    if (file < 0)
      return;
    close(file);
    unlink(name_beside(path).c_str());
  }

  void
  CheckpointWriter::value(double &number)
  {
    put_item('d', &number, sizeof number);
  }

  void
  CheckpointWriter::value(std::string &text)
  {
    put_item('t', text.data(), text.size());
  }

  void
  CheckpointWriter::value(std::vector<double> &numbers)
  {
    put_item('l', numbers.data(), numbers.size() * sizeof(double));
  }

  void
  CheckpointWriter::rows(void             *local,
                         const std::size_t point_size,
                         const SlabLayout &layout)
  {
    const std::size_t row_size = layout.grid().nx * point_size;
    const int         n_bytes  = static_cast<int>(row_size);
    put_item('f', nullptr, layout.grid().ny * row_size);
    const auto own = [&](const int row) {
      return static_cast<unsigned char *>(local) + row * row_size;
    };
    std::vector<unsigned char> received(row_size);
    for_all_rows(layout, [&](const int rank, const int row) {
      if (!on_root && rank == layout.rank())
        MPI_Send(own(row), n_bytes, MPI_BYTE, 0, 0, comm);
      if (on_root && rank > 0)
        MPI_Recv(received.data(), n_bytes, MPI_BYTE, rank, 0, comm, MPI_STATUS_IGNORE);
      if (on_root)
        put(rank > 0 ? received.data() : own(row), row_size);
    });
  }

  /** Without @p data only the head; they follow. */
  void
  CheckpointWriter::put_item(const char kind, const void *data, const std::uint64_t size)
  {
    if (!on_root)
      return;
    put(&kind, 1);
    put(&size, sizeof size);
    if (data != nullptr)
      put(data, size);
  }

  void
  CheckpointWriter::put(const void *data, std::size_t size)
  {
    const auto *bytes = static_cast<const unsigned char *>(data);
    while (size > 0)
      {
        const std::size_t n = std::min(size, block - buffer.size());
        buffer.insert(buffer.end(), bytes, bytes + n);
        bytes += n;
        size -= n;
        if (buffer.size() == block)
          flush();
      }
  }

  void
  CheckpointWriter::flush()
  {
    checksum = continued_checksum(checksum, buffer.data(), buffer.size());
    for (std::size_t at = 0; at < buffer.size() && error == 0;)
      {
        const ssize_t n = write(file, buffer.data() + at, buffer.size() - at);
        if (n > 0)
          at += n;
        else if (errno != EINTR)
          error = n < 0 ? errno : EIO;
      }
    buffer.clear();
  }

  void
  CheckpointWriter::commit()
  {
    run_on_root(comm, [this]() {
      flush();
      const std::uint64_t of_all = checksum;
      put(&of_all, sizeof of_all);
      flush();
      if (error == 0 && fsync(file) != 0)
        error = errno;
      if (file >= 0 && close(file) != 0 && error == 0)
        error = errno;
      file = -1;
      if (error == 0 && std::rename(name_beside(path).c_str(), path.c_str()) != 0)
        error = errno;
      if (error != 0)
        {
          unlink(name_beside(path).c_str());
          throw ComputationError(
            "The checkpoint '" + path + "' could not be written (" +
            std::strerror(error) +
            "); what was written before is kept, make room and continue with --resume.");
        }
      sync_folder_of(path);
    });
  }
} // namespace strait
