// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/build_info.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/run/output_directory.h>

#include <boost/algorithm/string/replace.hpp>

#include <array>
#include <cstdio>
#include <sstream>

namespace strait
{
  namespace
  {
    /** Put @p text in single quotes for the shell. */
    std::string
    quoted(const std::string &text)
    {
      return "'" + boost::replace_all_copy(text, "'", "'\\''") + "'";
    }

    struct ScriptResult
    {
      bool        succeeded;
      std::string said; // output on both streams
    };

    /** Run a script with @p input as its standard input, if that is not empty. */
    ScriptResult
    run_script(const std::string &name,
               const std::string &argument,
               const std::string &input = "")
    {
      const std::string script = find_script(name);
      if (script.empty())
        return {false, "the script " + name + " was not found"};
      // Signals that stop a run let it complete what it has begun, its pictures as well;
      // a terminal sends Ctrl-C to scripts too. An interpreter that inherits MPI's
      // variables may believe it is a rank.
      const std::string command =
        std::string("trap '' INT TERM USR1; ") +
        (input.empty() ? "" : "printf %s " + quoted(input) + " | ") +
        "env -u OMPI_COMM_WORLD_SIZE " + quoted(python_interpreter) + " " +
        quoted(script) + " " + quoted(argument) + " 2>&1";
      std::FILE *pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c)
      if (pipe == nullptr)
        return {false, "no process could be started for " + name};
      std::string            said;
      std::array<char, 4096> part;
      while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe))
        said.append(part.data(), n);
      const bool succeeded = pclose(pipe) == 0;
      said                 = trim(said);
      if (!succeeded && said.empty())
        said = name + " was killed: start again, with --resume if there are results.";
      return {succeeded, said};
    }

    /** The output of scripts goes to the log, lines with this prefix as warnings. */
    const std::string warning = "warning: ";

    void
    run_or_warn(const std::string &name, const std::string &folder, Log &log)
    {
      const ScriptResult result = run_script(name, folder);
      std::istringstream said(result.said);
      for (std::string line; std::getline(said, line);)
        if (line.rfind(warning, 0) == 0)
          log.warn(line.substr(warning.size()));
        else
          log.line(line);
      if (!result.succeeded)
        log.warn(name + " failed; try again with: tools/" + name + " " + folder);
    }
  } // namespace

  void
  fit_results(const std::string &folder, Log &log)
  {
    run_or_warn("fit.py", folder, log);
  }

  void
  check_seal_profile(const Scene &scene)
  {
    const ScriptResult result = run_script("whole_seal.py", "--check", scene.resolved);
    require(result.succeeded, result.said);
  }

  void
  assess_whole_seal(const Scene &scene, Log &log)
  {
    const ScriptResult result = run_script("whole_seal.py", scene.output.directory);
    if (!result.succeeded)
      throw ComputationError(result.said);
    log.line(result.said);
  }

  void
  draw_results(const Scene &scene, Log &log)
  {
    if (scene.output.pictures)
      run_or_warn("plot.py", scene.output.directory, log);
    if (scene.output.report)
      run_or_warn("strait-report", scene.output.directory, log);
  }
} // namespace strait
