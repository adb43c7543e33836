// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/contact/contact_model.h>
#include <strait/contact/dual_optimisation.h>
#include <strait/contact/half_space_problem.h>
#include <strait/contact/wall.h>
#include <strait/contact/zoomed_problem.h>

namespace strait
{
  /**
   * Solves the contact of a half-space with one surface, elastic or, beyond the hardness,
   * perfectly plastic: there the gap of the solution is negative, and by that much the
   * surface is indented for all states that are reached from this one (Almqvist et al.,
   * Tribol. Int. 40, 574, 2007). Volume is not conserved.
   *
   * A problem starts from the state that is given if the load (or mean gap) changes
   * little, and from those on coarser grids otherwise. The result depends on the start
   * within the tolerance only, but for its indentation; it has the windows of the fluid's
   * pressure or, without a fluid, of the state that is given.
   */
  class ContactSolver : public ContactModel
  {
  public:
    /**
     * @p heights on the grid of the contact problem [length]. Of @p parameters
     * the modulus, hardness, control, method, tolerance and cap on the iterations matter.
     * Collective.
     */
    ContactSolver(const ContactParameters &parameters, SlabField heights);

    /**
     * See ContactModel. Where no peak touches at the mean gap @p target, the pressure is
     * 0 and no iteration is needed. After the cap on iterations the state is admissible
     * but not `converged`, and the surface is indented no further. Collective. Throws
     * InputError if @p target is not positive, or more than the hardness bears.
     */
    ContactState solve(double              target,
                       const ContactState *from           = nullptr,
                       const SlabField    *fluid_pressure = nullptr,
                       Digits              digits         = Digits::all) override;

  private:
    void check(double target, double of_solid) const;
    ContactState
    state_of(const ContactSolution &solution, SlabField pressure, SlabField gap) const;

    SlabField       cold_start(const SlabField &grid_heights, double target) const;
    SlabField       start_from_coarser_grid(const SlabField &fine_heights, double target);
    ContactSolution optimise(DualProblem &on_grid,
                             double       target,
                             double       residual,
                             SlabField   &grid_pressure,
                             SlabField   &grid_gap);
    DualProblem &problem_on(const SlabLayoutPtr &layout, const SlabField *fluid_pressure);
    SlabField    start_without(const SlabLayoutPtr &layout, double target);

    const ContactParameters parameters;
    Wall                    wall;
    HalfSpaceProblem        problem;

    // With windows, those of the last state.
    SlabField                      zoomed_heights;
    SlabField                      zoomed_at_rest; // empty before the first fluid
    std::unique_ptr<ZoomedProblem> zoomed;
  };
} // namespace strait
