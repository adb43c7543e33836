// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_adhesive_contact_solver_h
#define strait_contact_adhesive_contact_solver_h

#include <strait/base/contact_parameters.h>
#include <strait/contact/contact_model.h>
#include <strait/contact/gap_optimisation.h>
#include <strait/contact/gap_stability.h>
#include <strait/contact/half_space_problem.h>

#include <memory>
#include <vector>

namespace strait
{
  /** Where the first state of a path comes from. */
  enum class AdhesiveStart
  {
    without_adhesion, // the state of the same load without adhesion: loading
    full_contact      // all points in contact: unloading
  };

  /**
   * Solves the contact of an adhesive half-space with one surface, load after load.
   *
   * The energy is not convex. Each solve goes down in energy from the last state, or
   * from where the last two lead to, so that the states follow a branch until that
   * ends. At the end it is checked that the energy has a minimum; if not, the state is
   * pushed off and goes down further.
   */
  class AdhesiveContactSolver : public ContactModel
  {
  public:
    /** @p heights on the grid of the contact problem [length]. Collective. */
    AdhesiveContactSolver(const ContactParameters &parameters,
                          const AdhesionLaw       &law,
                          AdhesiveStart            start,
                          SlabField                heights);

    /**
     * See ContactModel. Under load control the target may be negative, but not in the
     * first solve. A `detached` state is no equilibrium; recall() an earlier one before
     * the next solve. Collective.
     */
    ContactState solve(double target) override;

    void          forget() override;
    ContactMemory memory() const override;
    void          recall(const ContactMemory &memory) override;
    void          transfer(StateArchive &archive) override;
    std::size_t   memory_consumption() const override;

  private:
    std::unique_ptr<GapOptimiser> make_optimiser(double target, RelaxationObserver);

    SlabField    first_gap(double target) const;
    void         choose_start(double target);
    void         extrapolate(double target);
    void         push_off();
    ContactState state_of(const GapOptimiser &, const GapSolution &) const;

    const ContactParameters parameters;
    const AdhesionLaw       law;
    const AdhesiveStart     start;
    SlabField               heights;
    double                  traction_scale; // rms of K h, or what a flat surface has
    HalfSpaceGapProblem     problem;
    GapStability            stability;
    std::size_t             peak_memory = 0;

    // The gap of the last state, and of the one before.
    SlabField          gap;
    double             last_target = 0;
    std::vector<float> earlier_gap;
    double             earlier_target = 0;
  };
} // namespace strait

#endif
