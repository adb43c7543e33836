// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <chrono>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace strait
{
  /** Wall-clock time of nested parts of the program on this rank. A part is timed while
   *  what its scope() returned exists; scopes must end in the reverse order of their
   *  beginning. Entering a part again adds to its time. */
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

    /** Wall-clock seconds. */
    static double
    seconds_since(const Clock::time_point start)
    {
      return std::chrono::duration<double>(Clock::now() - start).count();
    }

    /** The whole since this object was made, and depth first the parts in the order in
     *  which they first appeared; what the parts of a part leave over is its part
     *  "other". */
    std::vector<Part> table() const;

    /** The table as text, one indented line a part. */
    std::string summary() const;

  private:
    struct Node
    {
      std::string     name;
      Node           *whole; // that this is a part of
      std::list<Node> parts   = {};
      double          seconds = 0.;
    };

    Clock::time_point start      = Clock::now();
    Node              total_time = {"total", nullptr};
    Node             *innermost  = &total_time;
  };
} // namespace strait
