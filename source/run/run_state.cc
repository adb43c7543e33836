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
    transfer_summary(StateArchive &archive, RunSummary &summary)
    {
      std::apply([&archive](auto &...members) { archive.values(members...); },
                 summary.members());
    }

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
    archive = std::make_unique<CheckpointReader>(path, comm);
    std::string earlier;
    archive->value(earlier);
    const std::string difference = difference_of_scenes(earlier, scene.resolved);
    if (!difference.empty())
      throw InputError("The run in '" + scene.output.directory + "' had " + difference +
                       "; restore the scene to resume, or begin anew in another folder.");
    if (transfer_presence(*archive, left))
      transfer_summary(*archive, *left);
    else
      archive->values(surface, surface_energy, has_searched);
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
    transfer_parts(*archive, sweep, output, log);
  }

  void
  RunState::save(LoadSweep &sweep, OutputDirectory &output, Log &log)
  {
    if (!scene.output.checkpoint)
      return;
    CheckpointWriter writer(path, comm);
    std::string      resolved = scene.resolved;
    bool             at_end   = false;
    writer.values(resolved, at_end, surface, surface_energy, has_searched);
    transfer_parts(writer, sweep, output, log);
    writer.commit();
  }

  void
  RunState::save_end(const RunSummary &summary) const
  {
    if (!scene.output.checkpoint)
      return;
    CheckpointWriter writer(path, comm);
    std::string      resolved = scene.resolved;
    bool             at_end   = true;
    RunSummary       result   = summary;
    writer.values(resolved, at_end);
    transfer_summary(writer, result);
    writer.commit();
  }
} // namespace strait
