// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mpi.h>

#include <chrono>
#include <fstream>
#include <iosfwd>
#include <string>
#include <vector>

namespace strait
{
  /** What the user sees: lines on the screen of rank 0 and in a log file. All ranks may
   *  call everything; the others stay silent. */
  class Log
  {
  public:
    /** How much the screen shows. */
    enum class Screen
    {
      silent,  // nothing but the file
      plain,   // lines only, for files and pipes
      terminal // lines, and progress that overwrites itself
    };

    /** On standard output; a terminal is recognised. */
    Log(MPI_Comm comm, bool quiet);

    /** On @p stream, which must live longer than this object. */
    Log(MPI_Comm comm, std::ostream &stream, Screen screen);

    /** Of a part of the work that @p whole, which must live longer, tells of: shows its
     *  progress, and nothing else. */
    explicit Log(Log *whole);

    /** Removes the live line. */
    ~Log();

    Log(const Log &)            = delete;
    Log &operator=(const Log &) = delete;

    /** A line, or several, on the screen and in the file. */
    void line(const std::string &text);

    /** The line "warning: TEXT", once for each text; kept for warnings(). */
    void warn(const std::string &text);

    /** What goes on from now on, "step 2 of 7"; empty: nothing that takes long. On a
     *  terminal the live line shows it, the last one on the screen, which overwrites
     *  itself; elsewhere it is printed at most every ten seconds. Not in the file. */
    void stage(const std::string &text);

    /** How far that is: the live line goes on with it until the next stage. */
    void progress(const std::string &text);

    /** Collective. From now on write to the file @p path as well, beginning with the
     *  lines so far; with @p append after what is in it. Throws on all ranks if it cannot
     *  be written: ComputationError if the disk is full, else InputError. */
    void attach_file(const std::string &path, bool append = false);

    /** Whether nothing is shown on the screen. */
    bool
    is_quiet() const
    {
      return screen == Screen::silent;
    }

    /** The texts of all warnings, on all ranks that gave them. */
    const std::vector<std::string> &
    warnings() const
    {
      return all_warnings;
    }

    /** Warnings that an earlier part of the run gave, as if given here. */
    void keep_warnings(const std::vector<std::string> &earlier);

  private:
    void show_live();
    void clear_live();

    MPI_Comm                              comm;
    std::ostream                         &stream;
    Screen                                screen;
    Log                                  *shows_progress = nullptr; // of this one
    bool                                  on_root;
    int                                   width; // of the live line, in characters
    std::string                           current_stage, live;
    std::chrono::steady_clock::time_point last_progress;
    std::string                           early_lines; // before the file is there
    std::ofstream                         file;
    std::vector<std::string>              all_warnings;
  };
} // namespace strait
