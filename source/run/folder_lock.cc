// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/run/folder_lock.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace strait
{
  FolderLock::FolderLock(const std::string &folder)
    : descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
  {
    // Any other error is one of a file system without locks.
    if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0 ||
        errno != EWOULDBLOCK)
      return;
    close(descriptor);
    throw InputError("Another run is writing into '" + folder +
                     "'; wait for it to end or choose another Output/Directory.");
  }

  FolderLock::~FolderLock()
  {
    if (descriptor >= 0)
      close(descriptor);
  }
} // namespace strait
