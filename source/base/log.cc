// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/files.h>
#include <strait/base/log.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iostream>
#include <sstream>

namespace strait
{
  namespace
  {
    // Half of it fills the output of batch jobs with progress; double of it leaves the
    // reader in doubt whether the job still runs.
    constexpr std::chrono::seconds plain_progress_interval(10);

    /** The columns of the terminal on standard output; 0 if it is none. The output of
     *  processes under mpirun looks like a terminal, but has no width. */
    int
    terminal_width()
    {
      winsize size{};
      ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
      return size.ws_col;
    }

    constexpr int columns = 80; // the usual width of a terminal

    /** The position behind the first @p n characters of @p text, which is UTF-8. */
    std::size_t
    end_of(const std::string &text, const int n)
    {
      int n_begun = 0;
      for (std::size_t k = 0; k < text.size(); ++k)
        if ((static_cast<unsigned char>(text[k]) & 0xC0) != 0x80 && ++n_begun > n)
          return k;
      return text.size();
    }

    /** A line broken at blanks to fit a terminal, with indented continuation lines. */
    std::string
    folded(std::string line)
    {
      const std::size_t indent =
        std::min<std::size_t>(line.find_first_not_of(' '), 20) + 4;
      std::string result;
      while (end_of(line, columns) < line.size())
        {
          const std::size_t first = line.find_first_not_of(' ');
          std::size_t       blank = line.rfind(' ', end_of(line, columns));
          if (blank == std::string::npos || blank < first)
            blank = line.find(' ', first);
          if (blank == std::string::npos)
            break;
          result += line.substr(0, blank) + "\n";
          line = std::string(indent, ' ') + line.substr(blank + 1);
        }
      return result + line;
    }

    /** All lines of @p text, folded. */
    std::string
    for_terminal(const std::string &text)
    {
      std::istringstream lines(text);
      std::string        result;
      for (std::string line; std::getline(lines, line);)
        result += (result.empty() ? "" : "\n") + folded(line);
      return result;
    }
  } // namespace

  Log::Log(MPI_Comm comm, const bool quiet)
    : Log(comm,
          std::cout,
          quiet                  ? Screen::silent
          : terminal_width() > 0 ? Screen::terminal
                                 : Screen::plain)
  {
    width = terminal_width() - 1;
  }

  Log::Log(MPI_Comm comm, std::ostream &stream, const Screen screen)
    : comm(comm)
    , stream(stream)
    , screen(screen)
    , on_root(rank_in(comm) == 0)
    , width(columns - 1)
    , last_progress(std::chrono::steady_clock::now())
  {
  }

  Log::Log(Log *whole)
    : Log(whole->comm, whole->stream, Screen::silent)
  {
    shows_progress = whole;
  }

  Log::~Log()
  {
    clear_live();
  }

  void
  Log::line(const std::string &text)
  {
    if (!on_root)
      return;
    clear_live();
    if (screen != Screen::silent)
      stream << (screen == Screen::terminal ? for_terminal(text) : text) << std::endl;
    show_live();
    if (file.is_open())
      file << text << std::endl;
    else
      early_lines += text + "\n";
  }

  void
  Log::warn(const std::string &text)
  {
    if (std::find(all_warnings.begin(), all_warnings.end(), text) != all_warnings.end())
      return;
    all_warnings.push_back(text);
    line("warning: " + text);
  }

  void
  Log::stage(const std::string &text)
  {
    clear_live();
    current_stage = text;
    progress("");
  }

  void
  Log::progress(const std::string &text)
  {
    if (shows_progress != nullptr)
      shows_progress->progress(text);
    if (!on_root || screen == Screen::silent)
      return;
    live           = current_stage + text;
    const auto now = std::chrono::steady_clock::now();
    if (screen == Screen::terminal)
      show_live();
    else if (!live.empty() && now - last_progress >= plain_progress_interval)
      {
        last_progress = now;
        stream << live << std::endl;
      }
  }

  void
  Log::attach_file(const std::string &path, const bool append)
  {
    run_on_root(comm, [&]() {
      errno = 0;
      file.open(path, append ? std::ios::app : std::ios::out);
      file << early_lines << std::flush;
      if (!file)
        throw_unwritable("The log file '" + path + "'", errno);
      early_lines.clear();
    });
  }

  void
  Log::keep_warnings(const std::vector<std::string> &earlier)
  {
    std::vector<std::string> all = earlier;
    for (const std::string &text : all_warnings)
      if (std::find(earlier.begin(), earlier.end(), text) == earlier.end())
        all.push_back(text);
    all_warnings = std::move(all);
  }

  /** Print the live line over the previous one. */
  void
  Log::show_live()
  {
    // Cut to the width: a line that wraps could not be overwritten.
    if (screen == Screen::terminal && !live.empty())
      stream << "\r" << live.substr(0, end_of(live, width)) << "\x1b[K" << std::flush;
  }

  void
  Log::clear_live()
  {
    if (screen == Screen::terminal && !live.empty())
      stream << "\r\x1b[K" << std::flush;
  }
} // namespace strait
