// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_solver_h
#define strait_contact_contact_solver_h

#include <strait/base/contact_parameters.h>
#include <strait/contact/contact_model.h>
#include <strait/contact/dual_optimisation.h>
#include <strait/contact/earlier_states.h>
#include <strait/contact/half_space_problem.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace strait
{
  /**
   * Solves the contact of a half-space with one surface, load after load.
   *
   * The first problem starts from those on coarser grids, the next ones from the
   * last states where the load (or mean gap) changes little. The result depends
   * on the start within the tolerance only.
   */
  class ContactSolver : public ContactModel
  {
  public:
    /** Gets a line of text for each grid and solve. */
    using Report = std::function<void(const std::string &)>;

    /**
     * @p heights on the grid of the contact problem [length]. Of @p parameters
     * the modulus, control, method, tolerance and cap on the iterations matter.
     * Collective.
     */
    ContactSolver(const ContactParameters &parameters,
                  SlabField                heights,
                  Report                   report = {});
    ~ContactSolver() override;

    /**
     * The state under the nominal pressure or, in gap control, at the mean gap
     * @p target. Where no peak touches at that mean gap, the pressure is 0 and no
     * iteration is needed. After the cap on iterations the state is admissible
     * but not `converged`. Collective.
     * Throws InputError if @p target is not positive.
     */
    ContactState solve(double target) override;

    /**
     * Let a fluid of the pressure @p fluid_pressure, on the grid of the heights and
     * continued under the contact, press against the wall in the solves to come. It
     * displaces the wall by G p_f and carries its mean pressure of the load; the
     * contact pressure is what the solid bears beyond it, so that a point opens where
     * that would be negative. Of the state, nominal_pressure then includes the
     * fluid's share and pressure does not. Collective; one FFT pair.
     * solve() throws ComputationError if the fluid carries more than the load.
     */
    void set_fluid_pressure(const SlabField &fluid_pressure);

    /** Start the next solve anew, without the states before. */
    void forget() override;

    /** The states before; a fluid must be set again. */
    void transfer(StateArchive &archive) override;

    const SlabLayoutPtr &
    layout() const
    {
      return heights.layout_pointer();
    }

    /** Largest number of bytes held on this rank during a solve so far. */
    std::size_t
    memory_consumption() const override
    {
      return peak_memory;
    }

  private:
    /** What is to carry the load @p target or to keep the mean gap @p target: the
     *  load without the fluid's share, and the mean gap itself. */
    double share_of_solid(double target) const;

    void              lower_highest_peak_to_zero();
    ContactConstraint constraint_for(double target) const;
    ContactTolerance  tolerance_for(double target) const;
    void              check(double target) const;
    bool              makes_contact(double target) const;
    ContactState      state_without_contact(double mean_gap);
    ContactState      state_of(const ContactSolution &solution, SlabField gap);

    SlabField cold_start(const SlabField &grid_heights, double target) const;
    SlabField start_from_coarser_grid(const SlabField &fine_heights, double target);

    ContactSolution optimise(DualProblem            &on_grid,
                             double                  target,
                             const ContactTolerance &tolerance,
                             SlabField              &grid_pressure,
                             SlabField              &grid_gap);
    void            note_memory(std::size_t optimiser_bytes);

    const ContactParameters           parameters;
    const Report                      report;
    SlabField                         heights;     // below the highest peak, <= 0
    SlabField                         dry_heights; // without G p_f, if there is a fluid
    double                            fluid_load = 0; // mean of p_f
    double                            mean_height;    // of these
    double                            rms_height;
    std::unique_ptr<HalfSpaceProblem> problem;
    std::size_t                       peak_memory = 0;

    SlabField     pressure; // of the last state
    EarlierStates earlier;
  };
} // namespace strait

#endif
