// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <chrono>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace strait
{
  /** Wall-clock times of nested parts of the program on this rank. A part is timed as
   *  long as the object that scope() returned for it exists; scopes must end in the
   *  reverse order of their beginning. Entering a part again adds to its time. */
  class Timers
  {
  public:
    using Clock = std::chrono::steady_clock;

    /** One row of the table of times. */
    struct Part
    {
      std::string path;  // "contact/transforms"
      int         depth; // 0: the whole
      double      seconds;
    };

    Timers()                          = default;
    Timers(const Timers &)            = delete;
    Timers &operator=(const Timers &) = delete;

    /** Time @p name as a part of the innermost part that is being timed. */
    [[nodiscard]] std::shared_ptr<void> scope(const std::string &name);

    /** Wall-clock seconds since @p start. */
    static double
    seconds_since(const Clock::time_point start)
    {
      return std::chrono::duration<double>(Clock::now() - start).count();
    }

    /** The time since this object was made, followed by all parts, depth first, in the
     *  order in which they first appeared. The time of a part that none of its own parts
     *  accounts for is its part "other". */
    std::vector<Part> table() const;

    /** The table as text, one indented line for each part. */
    std::string summary() const;

  private:
    struct Node
    {
      std::string     name;
      Node           *whole; // of which this is a part
      std::list<Node> parts   = {};
      double          seconds = 0.;
    };

    Clock::time_point start      = Clock::now();
    Node              total_time = {"total", nullptr};
    Node             *innermost  = &total_time;
  };
} // namespace strait
