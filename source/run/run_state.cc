// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/run/checkpoint.h>
#include <strait/run/earlier_results.h>
#include <strait/run/run_state.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    void
    transfer_parts(StateArchive    &archive,
                   LoadSweep       &sweep,
                   OutputDirectory &output,
                   Log             &log)
    {
      output.transfer(archive);
      sweep.transfer(archive);
      std::vector<std::string> warnings = log.warnings();
      archive.value(warnings);
      if (archive.is_reading())
        log.keep_warnings(warnings);
    }
  } // namespace

  RunState::RunState(const Scene &scene_, MPI_Comm comm_, const bool resume)
    : scene(scene_)
    , comm(comm_)
    , path(scene.output.directory + "/checkpoint")
  {
    if (!resume)
      return;
    archive = std::make_unique<Checkpoint>(path, comm, Checkpoint::Access::read);
    transfer(*archive);
  }

  /** The scene, and what is known before there is a sweep or once it has ended. */
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
    if (transfer_presence(file, left))
      std::apply([&file](auto &...members) { file.values(members...); }, left->members());
    else
      file.values(surface, surface_energy, has_searched);
  }

  void
  RunState::check_surface(const SlabField &heights)
  {
    const std::vector<double> now = {min_value(heights),
                                     max_value(heights),
                                     rms(heights)};
    // Other ranks, other rounding.
    const double allowed = 1e-9 * std::max(std::abs(now[0]), std::abs(now[1]));
    if (archive)
      for (std::size_t k = 0; k < now.size(); ++k)
        if (surface.size() != now.size() || !(std::abs(now[k] - surface[k]) <= allowed))
          throw InputError("The surface is not the one that the run in '" +
                           scene.output.directory +
                           "' began with; restore Surface/File to resume, or begin anew "
                           "in another folder.");
    surface = now;
  }

  void
  RunState::restore(LoadSweep &sweep, OutputDirectory &output, Log &log)
  {
    if (has_searched)
      sweep.end_searches();
    transfer_parts(*archive, sweep, output, log);
  }

  void
  RunState::save(LoadSweep &sweep, OutputDirectory &output, Log &log)
  {
    if (!scene.output.checkpoint)
      return;
    Checkpoint writer(path, comm, Checkpoint::Access::write);
    transfer(writer);
    transfer_parts(writer, sweep, output, log);
    writer.commit();
  }

  void
  RunState::save_end(const RunSummary &summary)
  {
    left = summary;
    if (!scene.output.checkpoint)
      return;
    Checkpoint writer(path, comm, Checkpoint::Access::write);
    transfer(writer);
    writer.commit();
  }
} // namespace strait
