// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_reynolds_solver_h
#define strait_flow_reynolds_solver_h

#include <strait/flow/bracket.h>
#include <strait/flow/potential_problem.h>
#include <strait/percolation/flow_path.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace strait
{
  /** The leak rate Q of one gap and how it was found. */
  struct FlowResult
  {
    double leak_rate  = 0.; // best value within the bracket
    double lower      = 0.; // from the stream function, best of all meshes
    double upper      = 0.; // from the pressure, likewise
    double mesh_lower = 0.; // the same on the last mesh alone
    double mesh_upper = 0.;

    unsigned long long cells       = 0;
    unsigned long long unknowns    = 0; // of both problems, on the last mesh
    unsigned int       refinements = 0;
    unsigned int       iterations  = 0; // of the linear solver, all meshes
    std::string        status      = "ok";
    std::string        reason; // why the target accuracy was missed

    /** Relative width of the bracket. */
    double
    relative_width() const
    {
      return upper > 0 ? (upper - lower) / upper : 0.;
    }
  };

  /**
   * The Reynolds equation ∇·(K ∇p_f) = 0 in a percolating gap, on a mesh that is
   * refined until the leak rate is bracketed as closely as asked.
   *
   * The pressure problem gives an upper, the stream-function problem on the same
   * mesh a lower bound, and the part of their difference that a cell is responsible
   * for, ∫ K |∇p + Q_lower/Δp K⁻¹ curl ψ|², marks the cells to refine: it is zero
   * where the flux of both agrees. The bounds allow for what the quadrature of K and
   * 1/K may be wrong by (Bracket::safe_lower), which marks cells as well; where the gap
   * goes to zero that makes them asymptotic rather than proven.
   */
  class ReynoldsSolver
  {
  public:
    /** How much smaller than the target accuracy the linear solver's error is. */
    static constexpr double linear_share = 1e-12;

    /** Of a mesh that may have as many unknowns as the accuracy takes. */
    static constexpr auto unlimited = std::numeric_limits<unsigned long long>::max();

    /** Called after each mesh with what is known so far. */
    using Observer = std::function<void(const FlowResult &)>;

    /** In the box or in @p seal. @p gap, @p fluid and @p seal must outlive the solver. */
    ReynoldsSolver(const FluidParameters       &fluid,
                   const GapField              &gap,
                   const std::vector<FlowPath> &paths,
                   const SealMesh              *seal = nullptr);

    /**
     * Run the adaptive cycle, from the mesh and the solution that are there if it ran
     * before, to @p share of the target accuracy, but with at most some ten times the
     * unknowns that the target itself needs; to miss only the share is no failure. A mesh
     * of more than @p most_unknowns is not refined. Collective.
     */
    FlowResult run(const Observer    &observer      = {},
                   double             share         = 1.,
                   unsigned long long most_unknowns = unlimited);

    /**
     * Solve for the pressure alone on the mesh of run(), after the gap has changed a
     * little. Returns the upper bound of the leak rate. Collective.
     */
    double solve_pressure();

    /** The mesh and the pressure (1 at the inlet, 0 at the outlet) of run(). */
    const FlowMesh &
    mesh() const
    {
      return flow_mesh;
    }

    const PotentialProblem &
    pressure() const
    {
      return pressure_problem;
    }

    /** The stream function of run(), for a leak of 1. */
    const PotentialProblem &
    stream_function() const
    {
      return stream_problem;
    }

  private:
    LinearSolve solve(PotentialProblem &problem);

    /** @return whether the linear solver converged; the bounds hold either way. */
    bool solve_on_mesh(FlowResult &result);

    bool is_enough(const FlowResult &result) const;

    /** @return why another mesh would not pay; empty if it would. */
    std::string obstacle(const FlowResult &result);

    /** @return false, without refining, if the unknowns would become too many. */
    bool refine(const FlowResult &result);

    const FluidParameters      &parameters;
    const GapField             &gap_field;
    double                      pressure_drop;
    FlowMesh                    flow_mesh;
    PotentialProblem            pressure_problem;
    PotentialProblem            stream_problem;
    std::unique_ptr<Enrichment> enrichment; // of solutions of degree 1
    std::vector<double>         widths;     // of the bracket, on all meshes
    Bracket                     plain;      // without enrichment; says where to refine
    unsigned long long unknowns_needed = 0; // for the target accuracy; 0: not known
  };
} // namespace strait

#endif
