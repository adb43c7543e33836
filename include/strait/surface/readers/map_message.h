// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_readers_map_message_h
#define strait_surface_readers_map_message_h

#include <strait/surface/readers/height_map.h>

namespace strait
{
  /** What one process tells another about a height map that it was to read. */
  struct MapMessage
  {
    /** The map, or the kind of exception in its place. */
    enum class Kind : int
    {
      map,
      input_error,
      out_of_memory,
      other_error
    };

    Kind        kind = Kind::other_error;
    HeightMap   map  = {};
    std::string text = {}; // of an error
  };

  /** Write @p message to an open file. Return whether all of it was taken. */
  bool send(int file, const MapMessage &message);

  /** Read a message from an open file; nothing if that ends before it or the message
   *  makes no sense. */
  std::optional<MapMessage> receive(int file);
} // namespace strait

#endif
