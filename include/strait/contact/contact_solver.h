// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_contact_solver_h
#define strait_contact_contact_solver_h

#include <strait/base/contact_parameters.h>
#include <strait/contact/contact_model.h>
#include <strait/contact/half_space_problem.h>
#include <strait/contact/optimisation.h>

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

    /** Start the next solve anew, without the states before. */
    void forget() override;

    /** Largest number of bytes held on this rank during a solve so far. */
    std::size_t
    memory_consumption() const override
    {
      return peak_memory;
    }

  private:
    ContactConstraint constraint_for(double target) const;
    ContactTolerance  tolerance_for(double target) const;
    bool              makes_contact(double target) const;
    ContactState      state_without_contact(double mean_gap);
    ContactState      state_of(const ContactSolution &solution, SlabField gap);

    /** Sets `pressure` to a start for @p target. */
    void      choose_start(double target);
    void      extrapolate(double target);
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
    double                            mean_height; // of these
    double                            rms_height;
    std::unique_ptr<HalfSpaceProblem> problem;
    std::size_t                       peak_memory = 0;

    // The pressure of the last state, and that of the one before. Of the latter
    // single precision (in units of `earlier_scale`) is enough to extrapolate.
    SlabField          pressure;
    double             last_target = 0; // 0: there is none
    std::vector<float> earlier_pressure;
    double             earlier_scale  = 0;
    double             earlier_target = 0; // 0: there is none
  };
} // namespace strait

#endif
