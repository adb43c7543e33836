// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/contact/contact_model.h>
#include <strait/contact/dual_optimisation.h>
#include <strait/contact/half_space_problem.h>
#include <strait/contact/wall.h>
#include <strait/contact/zoomed_problem.h>

#include <optional>

namespace strait
{
  /**
   * Solves the contact of a half-space with one surface. It is elastic or, where the
   * pressure reaches the hardness, perfectly plastic: the solution's gap is negative
   * there, and by that amount the surface stays indented in all states that are reached
   * from this one (Almqvist et al., Tribol. Int. 40, 574, 2007). Volume is not conserved.
   *
   * If the load (or mean gap) changes little, the optimiser starts from the given state,
   * otherwise from solutions on coarser grids. Apart from the indentation, the start
   * affects the result only within the tolerance. The result has the windows of the fluid
   * pressure or, without a fluid, those of a given state that it starts from.
   */
  class ContactSolver : public ContactModel
  {
  public:
    /**
     * @p heights are those on the grid of the contact problem [length]. Of @p parameters
     * the modulus, hardness, yielding, control, method, tolerance and maximum number of
     * iterations matter. Collective.
     */
    ContactSolver(const ContactParameters &parameters, SlabField heights);

    /**
     * See ContactModel. If no peak touches at the mean gap @p target, the pressure is 0
     * and no iteration is needed. After the maximum number of iterations the state is
     * admissible but not `converged`, and the surface is not indented further.
     * Collective. Throws InputError if @p target is not positive or, where the contact
     * yields, not less than the hardness; ComputationError if the fluid carries all the
     * load.
     */
    ContactState solve(double              target,
                       const ContactState *from           = nullptr,
                       const SlabField    *fluid_pressure = nullptr,
                       Digits              digits         = Digits::all) override;

  private:
    void check(double target, double solid_target) const;
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

    // The problem with the windows of the last state, if it had any.
    std::optional<Wall>            zoomed_wall;
    std::unique_ptr<ZoomedProblem> zoomed;
  };
} // namespace strait
