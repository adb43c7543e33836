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
  /** The checkpoint of one run: saved after every step, so that a later run of the same
   *  scene in the same folder can resume. Without Output/Checkpoint nothing is saved. */
  class RunState
  {
  public:
    /** With @p resume, open the checkpoint in the output directory. Collective. Throws
     *  InputError, before anything is written, if another run is at work there or, with
     *  @p resume, if there is no checkpoint, or if it is one of another scene or of other
     *  input files. @p scene must outlive this object. */
    RunState(const Scene &scene, MPI_Comm comm, bool resume);

    std::optional<RunSummary> finished; // the summary of the run, if it has finished

    bool   has_begun      = false; // there is something to resume
    double surface_energy = 0.;    // of the adhesion; 0 if it is not known yet

    /** Writes all that a run works with to an archive, or reads it from there. */
    using Parts = std::function<void(StateArchive &)>;

    /** Restore @p parts from the checkpoint that was opened. Collective. */
    void restore(const Parts &parts);

    /** Write the checkpoint. Without @p parts it holds only the scene and, if the run has
     *  finished, its summary. Collective. Throws ComputationError if the disk is full. */
    void save(const Parts &parts = {});

  private:
    RunState(const Scene &scene, MPI_Comm comm, std::vector<std::string> files);

    void transfer(StateArchive &file);

    friend void refuse_to_replace_results(const Scene &scene, MPI_Comm comm);

    const Scene                   &scene;
    MPI_Comm                       comm;
    std::string                    path;
    std::unique_ptr<StateArchive>  archive; // of the run that is resumed
    const std::vector<std::string> files;   // names and checksums of the input files
  };

  /** Throws InputError on all ranks if the output directory of @p scene holds results of
   *  another scene, or a run of this one that can be resumed. Collective. */
  void refuse_to_replace_results(const Scene &scene, MPI_Comm comm);
} // namespace strait
