// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/base/run_parameters.h>
#include <strait/contact/contact_model.h>
#include <strait/contact/gap_optimisation.h>
#include <strait/contact/half_space_problem.h>
#include <strait/contact/wall.h>

#include <memory>

namespace strait
{
  /**
   * Solves the contact of an adhesive half-space with one surface.
   *
   * The energy is not convex. Each solve goes down in energy from the state that it
   * starts from, or from where the last two lead to, so that the states follow a branch
   * until that ends. At the end it is checked that the energy has a minimum; if not, the
   * state is pushed off and goes down further.
   */
  class AdhesiveContactSolver : public ContactModel
  {
  public:
    /** @p heights on the grid of the contact problem [length]. When unloading, a state
     *  without a past comes from full contact, otherwise from the state of the same load
     *  without adhesion. Collective. */
    AdhesiveContactSolver(const ContactParameters &parameters,
                          const AdhesionLaw       &law,
                          LoadPath                 path,
                          SlabField                heights);

    /**
     * See ContactModel. Under load control the target may be negative, but not without a
     * state to start from when loading. A `detached` state is no equilibrium, and none to
     * start from. Collective.
     */
    ContactState solve(double              target,
                       const ContactState *from           = nullptr,
                       const SlabField    *fluid_pressure = nullptr,
                       Digits              digits         = Digits::all) override;

  private:
    std::unique_ptr<GapOptimiser> make_optimiser(double target);
    void                          check(double target, const ContactState *from) const;
    SlabField                     start_gap(double              target,
                                            double              of_solid,
                                            const ContactState *from,
                                            bool                is_dry) const;
    void push_off(const std::vector<double> &v, SlabField &gap) const;
    ContactState
    state_of(const GapOptimiser &optimiser, GapSolution solution, SlabField gap) const;

    const ContactParameters parameters;
    const bool              unloads;
    Wall                    wall;
    GapProblem              problem;
    const double            traction_scale; // rms of K h, or what a flat surface has
  };
} // namespace strait
