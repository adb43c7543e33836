// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/run/run_summary.h>
#include <strait/spectral/state_archive.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** The checkpoint of one run: saved after every step, and taken up by a later run of
   *  the same scene in the same folder. Without Output/Checkpoint nothing is saved. */
  class RunState
  {
  public:
    /** With @p resume the checkpoint in the output directory is opened. Collective.
     *  Throws InputError if there is none, or one of another scene or of other files that
     *  it reads, or if another run is at work there; nothing is written then. @p scene
     *  must outlive this object. */
    RunState(const Scene &scene, MPI_Comm comm, bool resume);

    std::optional<RunSummary> finished; // what the run left, if it has come to its end

    bool   has_begun      = false; // there is something that a resumed run goes on from
    double surface_energy = 0.;    // of the adhesion; 0 if it is not known yet

    /** Puts all that a run works with into an archive, or takes it from there. */
    using Parts = std::function<void(StateArchive &)>;

    /** Put the run where it stopped. Collective. */
    void restore(const Parts &parts);

    /** Without @p parts it is a mark of the scene alone, and of what the run left if it
     *  has finished. Collective. Throws ComputationError if the disk is full. */
    void save(const Parts &parts = {});

  private:
    RunState(const Scene &scene, MPI_Comm comm, std::vector<std::string> files);

    void transfer(StateArchive &file);

    friend void refuse_to_replace_results(const Scene &scene, MPI_Comm comm);

    const Scene                   &scene;
    MPI_Comm                       comm;
    std::string                    path;
    std::unique_ptr<StateArchive>  archive; // of the run that is resumed
    const std::vector<std::string> files;   // the scene's, and what is in them
  };

  /** Throws InputError on all ranks if the output directory of @p scene holds results of
   *  another scene, or a run of this one that can be resumed. Collective. */
  void refuse_to_replace_results(const Scene &scene, MPI_Comm comm);
} // namespace strait
