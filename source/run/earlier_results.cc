// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/files.h>
#include <strait/base/scene_text.h>
#include <strait/base/text.h>
#include <strait/run/output_directory.h>
#include <strait/run/result_tables.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <vector>

namespace strait
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Whether an earlier run of this program may have written a file. */
    bool
    is_result(const std::string &name)
    {
      static const std::regex number("-[0-9]+\\.");
      static const std::regex other_file(
        "(fields|flow|picture)-[0-9]+(-level-[0-9]+)?\\.(h5|xmf|vtu|pvtu|png)|flow\\.pvd|"
        "(leakage|gaps|ensemble|seal|spectrum)\\.png|report\\.html|"
        "surface(-indented)?\\.nc|run\\.json|checkpoint(\\.new)?|log\\.txt|"
        "parameters\\.prm");
      for (const TableInfo &table : all_tables({}))
        if (std::regex_replace(name, number, "-STEP.") == table.file)
          return true;
      return std::regex_match(name, other_file);
    }

    /** The files that an earlier run left in a folder; none if there is no folder. */
    std::vector<fs::path>
    results_in(const std::string &folder)
    {
      std::vector<fs::path> files;
      std::error_code       error;
      for (const auto &entry : fs::directory_iterator(folder, error))
        if (entry.is_regular_file() && is_result(entry.path().filename().string()))
          files.push_back(entry.path());
      return files;
    }

    /** Whether a parameter may change from one part of a run to the next, because no
     *  number of a step depends on it. A Seal is made of the steps of all patches. */
    bool
    may_change(const std::string &name)
    {
      static const std::regex free(
        "Output/(Directory|Pictures|Report|Fields|Checkpoint|Surface (map|spectrum))|"
        "Realisations/Ranks each|Seal/(?!Two in a row$).*");
      return std::regex_match(name, free);
    }

    /** The values of a resolved scene by "Section/Parameter". */
    std::map<std::string, std::string>
    parameters_of(const std::string &resolved)
    {
      std::map<std::string, std::string> values;
      for (const SceneEntry &entry : lex_scene(resolved, "scene", ""))
        if (!entry.name.empty() && !may_change(entry.path()))
          values[entry.path()] = entry.value;
      return values;
    }

    /** Read the scene in @p file, with the defaults of parameters that an earlier version
     *  did not have. */
    Scene
    scene_in(const fs::path &file)
    {
      return make_scene(
        lex_scene(text_of(file.string()), file.string(), file.parent_path().string()));
    }

    /** Return "which had NAME = VALUE …" of the scene in @p file, or why it cannot be
     *  read; empty if it is @p scene. */
    std::string
    foreign_scene(const fs::path &file, const Scene &scene)
    {
      try
        {
          const std::string difference =
            difference_of_scenes(scene_in(file).resolved, scene.resolved);
          return difference.empty() ? "" : "which had " + difference;
        }
      catch (const InputError &)
        {
          return "which this version of strait cannot read";
        }
    }

    /** Whether the program has written the scene in @p file: it stays the same when it is
     *  read and written again, which a user's does not. */
    bool
    is_written_scene(const fs::path &file)
    {
      try
        {
          return scene_in(file).resolved == text_of(file.string());
        }
      catch (const InputError &)
        {
          return false;
        }
    }

    /** Throws if a folder cannot be made or written to. */
    void
    make_folder(const std::string &folder)
    {
      const std::string what = "The output directory '" + folder + "'";
      std::error_code   error;
      fs::create_directories(folder, error);
      if (error)
        throw_unwritable(what, error.value());
      errno = 0;
      if (!std::ofstream(fs::path(folder) / "log.txt", std::ios::app))
        throw_unwritable(what, errno);
    }

    /** Remove what earlier runs left in a folder, and only that. */
    void
    remove_results(const std::string &folder)
    {
      std::error_code error;
      const bool      had_realisations = fs::exists(fs::path(folder) / "ensemble.csv");
      for (const fs::path &file : results_in(folder))
        fs::remove(file, error);
      // There may be fewer realisations now.
      static const std::regex realisation("realisation-[0-9]+");
      for (const auto &entry : fs::directory_iterator(folder, error))
        if (had_realisations &&
            std::regex_match(entry.path().filename().string(), realisation))
          for (const fs::path &file : results_in(entry.path().string()))
            fs::remove(file, error);
    }
  } // namespace

  std::shared_ptr<const void>
  lock_folder(const std::string &folder)
  {
    const int  descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const auto unlock     = [descriptor](const void *) { close(descriptor); };
    std::shared_ptr<const void> lock(nullptr, unlock);
    // Any other error means that the file system has no locks.
    require(descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0 ||
              errno != EWOULDBLOCK,
            "Another run is writing into '" + folder +
              "'; wait for it to end or choose another Output/Directory.");
    return lock;
  }

  std::string
  difference_of_scenes(const std::string &then, const std::string &now)
  {
    const auto before = parameters_of(then), after = parameters_of(now);
    for (const auto &[name, value] : after)
      {
        const auto found = before.find(name);
        if (found == before.end() || found->second != value)
          return join({name, found == before.end() ? "(none)" : found->second}, " = ") +
                 " where the scene now has " + value;
      }
    for (const auto &[name, value] : before)
      if (after.find(name) == after.end())
        return join({name, value}, " = ") +
               ", which this version of strait does not know";
    return "";
  }

  void
  refuse_results_of_another_scene(const Scene &scene, MPI_Comm comm)
  {
    run_on_root(comm, [&scene]() {
      const std::string &folder           = scene.output.directory;
      const fs::path     scene_of_results = fs::path(folder) / "parameters.prm";
      const fs::path     log              = fs::path(folder) / "log.txt";
      const bool         has_scene        = fs::exists(scene_of_results);
      for (const fs::path &file : results_in(folder))
        {
          const std::string name = file.filename().string();
          if (file == log || file == scene_of_results) // not results
            continue;
          const std::string difference =
            has_scene ? foreign_scene(scene_of_results, scene)
                      : "whose parameters.prm is missing beside " + name;
          if (difference.empty())
            return;
          throw InputError(
            join({"The folder '" + folder + "' holds the results of another scene",
                  difference},
                 ", ") +
            "; choose another folder with --output, or overwrite them with --force.");
        }
      std::error_code error;
      if (has_scene ? !is_written_scene(scene_of_results)
                    : fs::file_size(log, error) > 0 && !error)
        throw InputError("The folder '" + folder + "' has a " +
                         (has_scene ? "parameters.prm" : "log.txt") +
                         " that no run has written; choose another folder with --output, "
                         "or overwrite it with --force.");
    });
  }

  std::shared_ptr<const void>
  begin_results(const Scene &scene, MPI_Comm comm, Log &log, const bool resumed)
  {
    const std::string          &folder = scene.output.directory;
    std::shared_ptr<const void> lock;
    run_on_root(comm, [&]() {
      if (!resumed)
        make_folder(folder);
      lock = lock_folder(folder);
      if (!resumed)
        remove_results(folder);
    });
    log.attach_file(folder + "/log.txt", resumed);
    run_on_root(comm, [&]() { write_text(folder + "/parameters.prm", scene.resolved); });
    return lock;
  }
} // namespace strait
