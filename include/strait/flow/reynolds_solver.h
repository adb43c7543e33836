// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/flow/hierarchical_correction.h>
#include <strait/flow/leakage.h>
#include <strait/percolation/channel.h>

#include <deal.II/lac/vector.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace strait
{
  /** Bounds of the conductance Q/Δp on one mesh. */
  struct Bracket
  {
    double lower = 0.;
    double upper = 0.;

    /** Of each active cell: what it contributes to upper − lower, over upper. */
    dealii::Vector<float> contributions;
  };

  /**
   * The bracket of a pressure p and a stream function ψ. A cell contributes
   * ∫ K |∇p + Q_lower/Δp K⁻¹ curl ψ|², which is zero where the flux of both agrees.
   * Collective.
   */
  Bracket plain_bracket(const PotentialProblem &pressure,
                        const PotentialProblem &stream_function);

  /**
   * The Reynolds equation ∇·(K ∇p_f) = 0 in a percolating gap, on a mesh that is
   * refined until the leak rate is bracketed as closely as asked.
   *
   * The pressure problem gives an upper, the stream-function problem on the same mesh a
   * lower bound. Their difference on a cell (plain_bracket()), and the flow through it on
   * which the two disagree, mark the cells to refine (mark()). K and 1/K are integrated
   * from above, so that both energies are still too large (CellQuadrature); a cell where
   * that can be done roughly only is marked as well, as it contributes to the difference.
   *
   * Of a rarefied gas Q is the volume at the mean pressure of the reservoirs. Its problem
   * is not linear (RarefiedFlow): on each mesh pressure and weights follow from each
   * other until they agree, with one weight for each cell. The bracket for these weights
   * tells what the mesh leaves over, and where to refine; the bounds of the leak rate are
   * those for the extremes of the weight, on the last mesh.
   */
  class ReynoldsSolver
  {
  public:
    /** Of a mesh that may have as many unknowns as the accuracy takes. */
    static constexpr auto unlimited = std::numeric_limits<unsigned long long>::max();

    /** Called after each mesh with what is known so far. */
    using Observer = std::function<void(const Leakage &)>;

    /** In the box or in @p seal, from a coarse mesh. @p gap, @p fluid and @p seal must
     *  outlive the solver. */
    ReynoldsSolver(const FluidParameters &fluid,
                   const GapField        &gap,
                   const SealMesh        *seal = nullptr);

    /**
     * Run the adaptive cycle for the gap of @p channel, from the mesh and the solution
     * that are there if it ran before, to @p tolerance_factor times the target accuracy,
     * but with at most some ten times the unknowns that the target itself needs; to miss
     * only what is beyond the target is no failure. A mesh of more than @p most_unknowns
     * is not refined. Collective.
     */
    Leakage run(const Channel     &channel,
                const Observer    &observer         = {},
                double             tolerance_factor = 1.,
                unsigned long long most_unknowns    = unlimited);

    /**
     * Solve for the pressure alone on the mesh of run(), after the gap has changed a
     * little. Returns the upper bound of the leak rate. Collective.
     */
    double solve_pressure();

    /** By how much the leak rate would change, relative, if the gap were that of @p
     * other, which may be known on every second, fourth … point only, on the mesh of
     * run(): from the energies of both problems, of which one is
     * too large and the other as much too small; infinite if the linear solver fails.
     * Collective. */
    double change_in(const GapField &other);

    /** The fluid's pressure where the solution of the pressure problem is @p potential.
     */
    double pressure_at(double potential) const;

    /** The mesh and the pressure (1 at the inlet, 0 at the outlet; of a rarefied gas Ψ)
     * of run(). */
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
    /** What another mesh must leave of the bracket at most to pay. One closer to one
     *  makes more meshes in vain where the grid is too coarse, a smaller one gives up
     *  where the bracket narrows slowly. */
    static constexpr double progress = .97;

    LinearAccuracy accuracy() const;
    LinearSolve    solve(PotentialProblem &problem);
    double         drive() const;

    /** Solve for the pressure of the gas, and for the weights of its conductivity, in
     * turn, until the weights hardly change the energy. */
    LinearSolve solve_rarefied();

    /** Replace the bounds of @p leakage, which are for the weights that were found, by
     *  those of the nonlinear problem of the gas (RarefiedFlow), from linear problems on
     *  the last mesh, and tell the Knudsen number in the throat of @p path. */
    void bound_rarefied(const FlowPath &path, Leakage &leakage);

    /** @return whether the linear solver converged; the bounds hold either way. */
    bool solve_on_mesh(Leakage &leakage);

    /** @return why another mesh would not pay; empty if it would. */
    std::string obstacle(const Leakage &leakage);

    /** @return false, without refining, if another mesh would not pay or not fit. */
    bool refine(const Leakage &leakage, const Channel &channel, double wanted);

    /**
     * Mark the cells to refine, at most @p affordable of all, for the bracket of both
     * solutions (plain_bracket()), of which the part @p excess is too much: those that
     * contribute more than others, and those on whose flow the solutions disagree by more
     * than the part of the bracket's width that is that of one constriction of the first
     * path of @p channel. Returns false, with none marked, if there are none or if so few
     * could be that another mesh does not pay. Collective.
     */
    bool mark(const Channel &channel, double excess, double affordable);

    dealii::Vector<float> hidden_flows(const Channel &channel) const;

    const FluidParameters &parameters;
    const GapField        &gap_field;
    double                 pressure_drop;
    FlowMesh               flow_mesh;
    PotentialProblem       pressure_problem;
    PotentialProblem       stream_problem;
    std::vector<double> widths; // log(upper/lower) on the meshes that reach the spacing
    Bracket             plain;  // without correction; says where to refine
    unsigned long long  unknowns_needed = 0; // for the target accuracy; 0: not known
  };
} // namespace strait
