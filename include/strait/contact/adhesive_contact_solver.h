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
   * The energy is not convex. Each solve goes downhill in energy from the given state, or
   * from the extrapolation of the last two states, so that successive states follow a
   * branch of minima until it ends. The solution is checked to be a minimum; a saddle
   * point is left by a push along its softest direction, and the descent continues.
   */
  class AdhesiveContactSolver : public ContactModel
  {
  public:
    /** @p heights are those on the grid of the contact problem [length]. A state without
     *  a past starts from full contact if the @p path is unloading, otherwise from the
     *  state at the same load (or mean gap) without adhesion. Collective. */
    AdhesiveContactSolver(const ContactParameters &parameters,
                          const AdhesionLaw       &law,
                          LoadPath                 path,
                          SlabField                heights);

    /**
     * See ContactModel. All digits are computed in any case, and the fluid may carry more
     * than the load: adhesion bears tension. Under load control @p target may be
     * negative, except without a state @p from on a loading path. A `detached` state is
     * not an equilibrium and must not be passed as @p from. Collective.
     */
    ContactState solve(double              target,
                       const ContactState *from           = nullptr,
                       const SlabField    *fluid_pressure = nullptr,
                       Digits              digits         = Digits::all) override;

  private:
    std::unique_ptr<GapOptimiser> make_optimiser(double target);
    void                          check(double target, const ContactState *from) const;
    SlabField                     start_gap(double              target,
                                            double              solid_target,
                                            const ContactState *from,
                                            bool                is_dry) const;
    void push_off(const std::vector<double> &v, SlabField &gap) const;
    ContactState
    state_of(const GapOptimiser &optimiser, GapSolution solution, SlabField gap) const;

    const ContactParameters parameters;
    const bool              unloads;
    Wall                    wall;
    GapProblem              problem;
    const double            traction_scale; // rms of K h; 0 if the surface is flat
  };
} // namespace strait
