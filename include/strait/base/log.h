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
   *  call every function; only rank 0 prints. */
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

    /** Log to standard output, with a live line if it is a terminal; the screen is silent
     *  if @p quiet. */
    Log(MPI_Comm comm, bool quiet);

    /** Log to @p stream, which must live longer than this object. */
    Log(MPI_Comm comm, std::ostream &stream, Screen screen);

    /** The log of a part of the work that @p whole, which must live longer, reports on:
     *  passes on the progress of that part, and shows nothing else. */
    explicit Log(Log *whole);

    /** Removes the live line. */
    ~Log();

    Log(const Log &)            = delete;
    Log &operator=(const Log &) = delete;

    /** Print one or several lines on the screen and in the file. */
    void line(const std::string &text);

    /** Print the line "warning: TEXT", once for each text, and keep it for warnings(). */
    void warn(const std::string &text);

    /** Name the work that begins now, as "step 2 of 7"; empty: nothing that takes long. A
     *  terminal shows it in the live line, the last line of the screen, which overwrites
     *  itself; elsewhere it is printed at most every ten seconds. Not in the file. */
    void stage(const std::string &text);

    /** Tell how far the stage is: append @p text to it in the live line, in place of the
     *  previous text. */
    void progress(const std::string &text);

    /** Collective. From now on write to the file @p path as well, beginning with the
     *  lines so far; with @p append behind its present content. Throws on all ranks if it
     *  cannot be written: ComputationError if the disk is full, else InputError. */
    void attach_file(const std::string &path, bool append = false);

    /** Whether nothing is shown on the screen. */
    bool
    is_quiet() const
    {
      return screen == Screen::silent;
    }

    /** The texts of all warnings that this rank gave or took over. */
    const std::vector<std::string> &
    warnings() const
    {
      return all_warnings;
    }

    /** Take over the warnings of an earlier part of the run, as if given here before. */
    void keep_warnings(const std::vector<std::string> &earlier);

  private:
    void show_live();
    void clear_live();

    MPI_Comm                              comm;
    std::ostream                         &stream;
    Screen                                screen;
    Log                                  *shows_progress = nullptr; // of this log
    bool                                  on_root;
    int                                   width; // of the live line, in characters
    std::string                           current_stage, live;
    std::chrono::steady_clock::time_point last_progress;
    std::string                           early_lines; // kept until a file is attached
    std::ofstream                         file;
    std::vector<std::string>              all_warnings;
  };
} // namespace strait
