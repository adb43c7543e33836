// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_adhesive_sweep_h
#define strait_driver_adhesive_sweep_h

#include <strait/base/scene.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/driver/branch_follower.h>
#include <strait/percolation/flow_region.h>

namespace strait
{
  /** What a sweep needs besides where the contact remembers its past. */
  class AdhesiveSweep
  {
  public:
    /**
     * @p parameters are those of @p scene, but for the tolerance. Collective. Throws
     * as adhesion_of_scene(). @p scene and @p log must outlive this object.
     */
    AdhesiveSweep(const Scene             &scene,
                  const ContactParameters &parameters,
                  SlabField                heights,
                  Log                     &log);

    /** Of the scene, or what was found to match an area. */
    double
    surface_energy() const
    {
      return law.surface_energy;
    }

    /** The branch that the steps follow. */
    BranchFollower &
    path()
    {
      return follower;
    }

    const std::vector<Jump> &
    jumps() const
    {
      return follower.jumps();
    }

    /**
     * A state on the branch by which the scene approaches the threshold: started from
     * the nearest one on this side of it, so that no trial beyond it leaves a trace.
     * Collective.
     */
    ContactState state_for_search(double load, const FlowDomain &domain);

    /** Forget where the search was. */
    void
    end_search()
    {
      search_start = ContactMemory();
    }

    /** The path, and where a search is. Collective. */
    void transfer(StateArchive &archive);

    std::size_t
    memory_consumption() const
    {
      return solver.memory_consumption();
    }

  private:
    const Scene          &scene;
    const AdhesionLaw     law;
    const SlabLayoutPtr   layout;
    AdhesiveContactSolver solver;
    BranchFollower        follower;
    ContactMemory         search_start;
  };
} // namespace strait

#endif
