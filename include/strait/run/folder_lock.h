// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_folder_lock_h
#define strait_run_folder_lock_h

#include <string>

namespace strait
{
  /**
   * Keeps other runs out of a folder while this object lives. There is no file for it,
   * and the system takes the lock away with the process, however that ends. A folder that
   * does not exist, or whose file system has no locks, is not locked.
   */
  class FolderLock
  {
  public:
    /** Throws InputError if another lock of the same @p folder lives, in this process or
     *  in another. */
    explicit FolderLock(const std::string &folder);
    ~FolderLock();

    FolderLock(const FolderLock &)            = delete;
    FolderLock &operator=(const FolderLock &) = delete;

  private:
    int descriptor; // of the folder; negative if it cannot be opened
  };
} // namespace strait

#endif
