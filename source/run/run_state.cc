// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/run/output_directory.h>
#include <strait/run/run_state.h>

#include <zlib.h>

#include <fstream>
#include <utility>

namespace strait
{
  namespace
  {
    /** List the input files of @p scene, each with a checksum of its content.
     *  Collective. */
    std::vector<std::string>
    files_of(const Scene &scene, MPI_Comm comm)
    {
      std::vector<std::string> names, files;
      if (scene.surface.kind == SurfaceKind::file)
        names = {scene.surface.map.file, scene.surface.map.second_file};
      if (scene.fluid.enabled)
        names.push_back(scene.fluid.mesh_file);
      for (const std::string &name : names)
        {
          if (name.empty())
            continue;
          std::string checksum;
          run_on_root(comm, [&]() {
            std::ifstream     file(name, std::ios::binary);
            std::vector<char> block(1 << 20);
            uLong             sum = crc32_z(0, nullptr, 0);
            while (file.read(block.data(), static_cast<std::streamsize>(block.size())) ||
                   file.gcount() > 0)
              sum = crc32_z(sum,
                            reinterpret_cast<const Bytef *>(block.data()),
                            static_cast<std::size_t>(file.gcount()));
            checksum = std::to_string(sum);
          });
          files.push_back("'" + name + "' (checksum " + broadcast(comm, checksum) + ")");
        }
      return files;
    }
  } // namespace

  RunState::RunState(const Scene &scene_, MPI_Comm comm_, std::vector<std::string> files_)
    : scene(scene_)
    , comm(comm_)
    , path(scene.output.directory + "/checkpoint")
    , files(std::move(files_))
  {
    // Fail now if another run holds the lock, and not at the first output.
    run_on_root(comm, [this]() {
      const auto nobody_else = lock_folder(scene.output.directory);
    });
  }

  RunState::RunState(const Scene &scene_, MPI_Comm comm_, const bool resume)
    : RunState(scene_,
               comm_,
               resume || scene_.output.checkpoint ? files_of(scene_, comm_)
                                                  : std::vector<std::string>())
  {
    if (!resume)
      return;
    archive = std::make_unique<StateArchive>(path, comm, StateArchive::Access::read);
    transfer(*archive);
  }

  /** Transfer the scene, which must be the same, and what is known outside of a sweep. */
  void
  RunState::transfer(StateArchive &file)
  {
    std::string resolved = scene.resolved;
    file.value(resolved);
    const std::string difference =
      file.is_reading() ? difference_of_scenes(resolved, scene.resolved) : "";
    if (!difference.empty())
      throw InputError("The run in '" + scene.output.directory + "' had " + difference +
                       "; restore the scene to resume, or begin anew in another folder.");
    std::vector<std::string> then = files;
    file.value(then);
    for (std::size_t k = 0; k < files.size(); ++k)
      if (k >= then.size() || then[k] != files[k])
        throw InputError("The file " + files[k] + " is not the one that the run in '" +
                         scene.output.directory +
                         "' began with; restore it to resume, or begin anew in another "
                         "folder.");
    if (transfer_presence(file, finished))
      file.values(finished->converged,
                  finished->status,
                  finished->validity,
                  finished->threshold);
    else
      file.values(surface_energy, has_begun);
  }

  void
  RunState::restore(const Parts &parts)
  {
    parts(*archive);
    has_begun = true;
  }

  void
  RunState::save(const Parts &parts)
  {
    if (!scene.output.checkpoint)
      return;
    StateArchive writer(path, comm, StateArchive::Access::write);
    transfer(writer);
    if (parts)
      parts(writer);
    writer.commit();
    has_begun = true; // only now: at the first save nothing is done yet
  }

  void
  refuse_to_replace_results(const Scene &scene, MPI_Comm comm)
  {
    refuse_results_of_another_scene(scene, comm);
    try
      {
        // Input files are not compared: those that have changed may be restored.
        RunState     earlier(scene, comm, std::vector<std::string>());
        StateArchive file(earlier.path, comm, StateArchive::Access::read);
        earlier.transfer(file);
        if (earlier.finished || !earlier.has_begun)
          return;
      }
    catch (const InputError &)
      {
        return; // nothing to resume, or another run's lock, which is found again later
      }
    throw InputError("The folder '" + scene.output.directory +
                     "' holds a run of this scene that has not come to its end; go on "
                     "with --resume, or begin anew with --force.");
  }
} // namespace strait
