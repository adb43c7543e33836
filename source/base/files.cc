// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/files.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace strait
{
  namespace
  {
    bool
    is_lack_of_room(const int error)
    {
      return error == ENOSPC || error == EDQUOT || error == EFBIG;
    }

    [[noreturn]] void
    throw_unwritten(const std::string &what,
                    const std::string &reason,
                    const std::string &remedy)
    {
      throw ComputationError(what + " could not be written (" + reason + "); " + remedy +
                             ", and continue with --resume if a step was complete.");
    }
  } // namespace

  std::string
  text_of(const std::string &path)
  {
    std::ifstream      file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  void
  write_text(const std::string &path, const std::string &text)
  {
    const std::string fresh = path + ".new";
    std::ofstream     file(fresh);
    file << text << std::flush;
    std::error_code error;
    if (file)
      std::filesystem::rename(fresh, path, error);
    if (file && !error)
      return;
    std::filesystem::remove(fresh, error);
    throw_unfinished("The file '" + path + "'");
  }

  void
  require_space(const std::string &path, const std::uintmax_t of_fields, MPI_Comm comm)
  {
    // An upper bound of what our files hold besides their fields. Half of it might be too
    // little; double of it refuses disks that have enough room.
    constexpr std::uintmax_t overhead = 1 << 16;
    const std::uintmax_t     bytes    = of_fields + overhead;
    run_on_root(comm, [&]() {
      const std::string probe = path + ".new";
      const int         file  = open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      const int         error =
        file < 0 ? errno : posix_fallocate(file, 0, static_cast<off_t>(bytes));
      if (file >= 0)
        close(file);
      unlink(probe.c_str());
      if (error != 0)
        throw_unfinished("The file '" + path + "' of " + std::to_string(bytes / 1000) +
                           " kB",
                         error);
    });
  }

  void
  require_end(const std::string &path, const std::string &end)
  {
    const auto    n_bytes = static_cast<std::streamoff>(end.size());
    std::string   tail(end.size(), ' ');
    std::ifstream file(path, std::ios::binary);
    if (!file.seekg(-n_bytes, std::ios::end).read(tail.data(), n_bytes) || tail != end)
      throw_unfinished("The file '" + path + "'");
  }

  void
  throw_unfinished(const std::string &what, const int error)
  {
    const std::string reason = error != 0 ? std::strerror(error) : "is the disk full?";
    if (error != 0 && !is_lack_of_room(error))
      throw_unfinished(what, reason);
    throw_unwritten(what, reason, "make room");
  }

  void
  throw_unfinished(const std::string &what, const std::string &reason)
  {
    throw_unwritten(what, reason, "mend that");
  }

  void
  throw_unwritable(const std::string &what, const int error)
  {
    const std::string found =
      what + " cannot be written" +
      (error == 0 ? "" : std::string(" (") + std::strerror(error) + ")");
    if (is_lack_of_room(error))
      throw ComputationError(
        found + "; make room, and continue with --resume if the run had begun.");
    throw InputError(found + "; choose another with Output/Directory or --output.");
  }
} // namespace strait
