// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_isolated_reader_h
#define strait_surface_readers_isolated_reader_h

#include <strait/surface/readers/height_map.h>

#include <functional>

namespace strait
{
  /** A file that is read apart, and bounds that no whole file meets. */
  struct IsolatedFile
  {
    /** The bounds grow with the size of the file. */
    IsolatedFile(const std::string &name, const std::string &library);

    std::string name;
    std::string library; // that reads it, for messages

    /** Of computing: to find the map, and for each 100 kB, or 100 MB unpacked, one. */
    unsigned int seconds = 5;
    /** Bytes: of the library, and for what can be unpacked from the file. */
    std::uint64_t memory = 1U << 29;
  };

  /**
   * The map that @p read gives, called in a process of its own, because a damaged file
   * can bring a library down or keep it going forever. The process is a copy of this one
   * that must not use MPI; it leaves no trace and ends when this one ends.
   *
   * Throws InputError if @p read does, and where a signal or the time ends it;
   * std::bad_alloc if memory is short; ComputationError for anything else: another
   * exception, no process to be had, or an exit with a status of its own, such as that of
   * a sanitizer. Not collective.
   */
  HeightMap read_isolated(const IsolatedFile               &file,
                          const std::function<HeightMap()> &read);
} // namespace strait

#endif
