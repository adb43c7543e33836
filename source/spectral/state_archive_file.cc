// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/files.h>
#include <strait/spectral/state_archive.h>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace strait
{
  namespace
  {
    /** The first bytes of a file. The number changes whenever the items do. */
    const std::string signature = "strait checkpoint 31\n";

    std::string
    name_beside(const std::string &path)
    {
      return path + ".new";
    }

    /** A renamed file is not safe on the disk until its folder is. */
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

  StateArchive::StateArchive(const std::string &path_,
                             MPI_Comm           comm_,
                             const Access       access_)
    : path(path_)
    , comm(comm_)
    , access(access_)
  {
    run_on_root(comm, [this]() {
      file = std::fopen(is_reading() ? path.c_str() : name_beside(path).c_str(),
                        is_reading() ? "rb" : "wb");
      if (is_reading())
        check_whole_file();
      else
        {
          keep_error_unless(file != nullptr);
          std::string begin = signature;
          pass(begin.data(), begin.size());
        }
    });
  }

  StateArchive::~StateArchive()
  {
    if (file == nullptr)
      return;
    std::fclose(file);
    if (!is_reading())
      unlink(name_beside(path).c_str());
  }

  void
  StateArchive::refuse() const
  {
    throw InputError("The file '" + path +
                     "' is not a whole checkpoint of this version of strait, so the run "
                     "cannot be resumed; begin anew without --resume.");
  }

  void
  StateArchive::check_whole_file()
  {
    if (file == nullptr)
      throw InputError("There is no checkpoint '" + path +
                       "' to resume from; begin anew without --resume.");
    std::error_code failure;
    const auto      size = std::filesystem::file_size(path, failure);
    if (failure || size < signature.size() + sizeof checksum)
      refuse();
    const std::size_t length = size - sizeof checksum;
    uLong             now    = crc32_z(0, nullptr, 0);
    std::uint32_t     then   = 0;
    std::vector<char> block(1 << 20);
    for (std::size_t at = 0; at < length; at += block.size())
      {
        block.resize(std::min(block.size(), length - at));
        if (std::fread(block.data(), block.size(), 1, file) != 1 ||
            (at == 0 &&
             std::memcmp(block.data(), signature.data(), signature.size()) != 0))
          refuse();
        now = crc32_z(now, reinterpret_cast<const Bytef *>(block.data()), block.size());
      }
    if (std::fread(&then, sizeof then, 1, file) != 1 || then != now ||
        std::fseek(file, static_cast<long>(signature.size()), SEEK_SET) != 0)
      refuse();
    remaining = length - signature.size();
  }

  /** Write or read these bytes. Returns false if they could not be read. For rank 0. */
  bool
  StateArchive::pass(void *data, const std::size_t size)
  {
    if (is_reading())
      {
        if (size > remaining || std::fread(data, 1, size, file) != size)
          return false;
        remaining -= size;
        return true;
      }
    checksum =
      static_cast<std::uint32_t>(crc32_z(checksum, static_cast<Bytef *>(data), size));
    keep_error_unless(error != 0 || std::fwrite(data, 1, size, file) == size);
    return true;
  }

  /** Keep the error of a call that has failed, if it is the first one. */
  void
  StateArchive::keep_error_unless(const bool succeeds)
  {
    if (error == 0 && !succeeds)
      error = errno != 0 ? errno : EIO;
  }

  /** Write @p size as that of the next item, or read that. Returns it. For rank 0. */
  std::size_t
  StateArchive::size_of_item(std::size_t size)
  {
    if (!pass(&size, sizeof size) || (is_reading() && size > remaining))
      refuse();
    return size;
  }

  /** Read the next item and return it on all ranks; or write the @p bytes of rank 0 and
   *  return the own ones, which may differ between ranks, also in number. */
  std::string
  StateArchive::item(std::string bytes)
  {
    const auto pass_item = [&]() {
      bytes.resize(size_of_item(bytes.size()));
      if (!pass(bytes.data(), bytes.size()))
        refuse();
    };
    if (is_reading())
      {
        run_on_root(comm, pass_item);
        return broadcast(comm, bytes);
      }
    if (rank_in(comm) == 0)
      pass_item();
    return bytes;
  }

  void
  StateArchive::value(std::string &text)
  {
    text = item(text);
  }

  void
  StateArchive::rows(void *local, const std::size_t point_size, const SlabLayout &layout)
  {
    const std::size_t row_size = layout.grid().nx * point_size;
    const std::size_t size     = layout.grid().ny * row_size;
    const int         n_bytes  = static_cast<int>(row_size);
    const bool        on_root  = layout.rank() == 0;
    run_on_root(comm, [&]() {
      if (size_of_item(size) != size)
        refuse();
    });
    // The file was checked before. Should reading fail now, the others must not wait.
    bool              is_complete = true;
    std::vector<char> passed_on(row_size);
    for (int rank = 0; rank < layout.n_ranks(); ++rank)
      for (int row = layout.first_row_of(rank); row < layout.first_row_of(rank + 1);
           ++row)
        {
          char *own =
            rank == layout.rank()
              ? static_cast<char *>(local) + (row - layout.first_row_of(rank)) * row_size
              : passed_on.data();
          if (on_root)
            {
              if (rank > 0 && !is_reading())
                MPI_Recv(own, n_bytes, MPI_BYTE, rank, 0, comm, MPI_STATUS_IGNORE);
              is_complete = pass(own, row_size) && is_complete;
              if (rank > 0 && is_reading())
                MPI_Send(own, n_bytes, MPI_BYTE, rank, 0, comm);
            }
          else if (rank == layout.rank() && is_reading())
            MPI_Recv(own, n_bytes, MPI_BYTE, 0, 0, comm, MPI_STATUS_IGNORE);
          else if (rank == layout.rank())
            MPI_Send(own, n_bytes, MPI_BYTE, 0, 0, comm);
        }
    run_on_root(comm, [&]() {
      if (!is_complete)
        refuse();
    });
  }

  void
  StateArchive::commit()
  {
    run_on_root(comm, [this]() {
      std::uint32_t of_all = checksum;
      pass(&of_all, sizeof of_all);
      if (file != nullptr)
        {
          keep_error_unless(std::fflush(file) == 0 && fsync(fileno(file)) == 0);
          keep_error_unless(std::fclose(file) == 0);
          file = nullptr;
        }
      keep_error_unless(error != 0 ||
                        std::rename(name_beside(path).c_str(), path.c_str()) == 0);
      if (error != 0)
        {
          unlink(name_beside(path).c_str());
          throw_unfinished("The file '" + path + "'", error);
        }
      sync_folder_of(path);
    });
  }
} // namespace strait
