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

    /** Contribution of each active cell to upper − lower, over upper. */
    dealii::Vector<float> contributions;
  };

  /**
   * Return the bracket of a pressure p and a stream function ψ, without hierarchical
   * correction. A cell contributes ∫ K |∇p + Q_lower/Δp K⁻¹ curl ψ|², which is zero where
   * the fluxes of both agree. Collective.
   */
  Bracket plain_bracket(const PotentialProblem &pressure,
                        const PotentialProblem &stream_function);

  /**
   * Solves the Reynolds equation ∇·(K ∇p_f) = 0 in a percolating gap, on a mesh that is
   * refined until the bracket of the leak rate is as narrow as asked.
   *
   * The pressure problem gives an upper bound, the stream-function problem on the same
   * mesh a lower one. A cell is marked for its share of their difference
   * (plain_bracket()), or for the flow through it on which the two disagree (mark()). K
   * and 1/K are integrated from above, so that both energies remain too large
   * (CellQuadrature); a cell where this is only roughly possible adds to the difference
   * and is therefore marked as well.
   *
   * For a rarefied gas, Q is the volume at the mean pressure of the reservoirs. Its
   * problem is nonlinear (RarefiedFlow): on each mesh, pressure and weights, one for each
   * cell, are computed from each other until they agree. The bracket for these weights
   * shows the error of the mesh and where to refine. The bounds of the leak rate are
   * those for the extremes of the weight, on the last mesh.
   */
  class ReynoldsSolver
  {
  public:
    /** As many unknowns as the accuracy takes, up to Fluid/Maximum unknowns. */
    static constexpr auto unlimited = std::numeric_limits<unsigned long long>::max();

    /** Called after each mesh with the result so far. */
    using Observer = std::function<void(const Leakage &)>;

    /** Prepare the flow in the box or in @p seal, on a coarse mesh. @p gap, @p fluid and
     *  @p seal must outlive the solver. */
    ReynoldsSolver(const FluidParameters &fluid,
                   const GapField        &gap,
                   const SealMesh        *seal = nullptr);

    /**
     * Run the adaptive cycle for the gap of @p channel, from the mesh and the solution of
     * the last run if there was one, to @p tolerance_factor times the target accuracy. A
     * mesh of more than @p most_unknowns is not refined, nor one that meets the target
     * and has more than eight times the unknowns that the target took. To miss only what
     * is beyond the target is no failure. Collective.
     */
    Leakage run(const Channel     &channel,
                const Observer    &observer         = {},
                double             tolerance_factor = 1.,
                unsigned long long most_unknowns    = unlimited);

    /**
     * Solve for the pressure alone on the mesh of run(), after a small change of the gap.
     * Return the upper bound of the leak rate; not for a rarefied gas. Collective.
     */
    double solve_pressure();

    /** Return the relative change of the leak rate if the gap were that of @p other,
     *  which may be known on every second, fourth … point only. On the mesh of run() it
     *  is the geometric mean of what both problems find, of which one is too large and
     *  the other as much too small; infinite if the linear solver fails. Collective. */
    double change_in(const GapField &other);

    /** Return the fluid's pressure where the pressure problem has the @p potential. */
    double pressure_at(double potential) const;

    /** The mesh of run(). */
    const FlowMesh &
    mesh() const
    {
      return flow_mesh;
    }

    /** The potential of run(), 1 at the inlet and 0 at the outlet: linear in p for a
     *  liquid, in p² for a gas and in Ψ for a rarefied gas. */
    const PotentialProblem &
    pressure() const
    {
      return pressure_problem;
    }

    /** The stream function of run(), for a leak rate of 1. */
    const PotentialProblem &
    stream_function() const
    {
      return stream_problem;
    }

  private:
    /** Another mesh pays only if the last few narrowed the bracket to this part of its
     *  width. A value closer to 1 makes more meshes in vain where the grid is too coarse,
     *  a smaller one gives up where the bracket narrows slowly. */
    static constexpr double useful_narrowing = .97;

    LinearAccuracy accuracy() const;
    LinearSolve    solve(PotentialProblem &problem);
    double         drive() const;

    /** Solve in turn for the pressure of the gas and for the weights of its conductivity,
     *  until new weights hardly change the energy. */
    LinearSolve solve_rarefied();

    /** Replace the bounds of @p leakage, which hold for the weights that were found, by
     *  those of the nonlinear problem of the gas (RarefiedFlow), from linear problems on
     *  the last mesh. Also set the Knudsen number in the throat of @p path. */
    void bound_rarefied(const FlowPath &path, Leakage &leakage);

    /** Solve both problems on this mesh and count that in @p leakage. @return whether the
     *  linear solver converged; the bounds hold either way. */
    bool solve_on_mesh(Leakage &leakage);

    /** The plain bracket after hierarchical correction, for elements of degree 1; without
     *  contributions of cells. Collective. */
    Bracket corrected_bracket() const;

    /** Update @p leakage by the @p bracket of this mesh. */
    void take_bracket(const Bracket &bracket, Leakage &leakage) const;

    /** Record the width of the bracket. @return why another mesh would not pay; empty if
     *  it would. */
    std::string reason_to_stop(const Leakage &leakage);

    /** Refine a mesh of as many @p unknowns, see mark(). @return false, without refining,
     *  if another mesh would not pay or not fit. */
    bool refine(unsigned long long unknowns, const Channel &channel, double excess);

    /**
     * Mark cells to refine, at most the fraction @p affordable of all, if the part
     * @p excess > 0 of the bracket's width (plain_bracket()) is too much: cells that
     * contribute more to it than others, and cells on whose flow the two solutions
     * disagree by more than the part of the width that falls to one of several cells side
     * by side at one constriction of the first path of @p channel. Return false if there
     * are none, or if so few may be marked that another mesh does not pay; nothing is
     * marked then. Collective.
     */
    bool mark(const Channel &channel, double excess, double affordable);

    dealii::Vector<float> disputed_flows(const Channel &channel) const;

    const FluidParameters &parameters;
    const GapField        &gap_field;
    double                 pressure_drop;
    FlowMesh               flow_mesh;
    PotentialProblem       pressure_problem;
    PotentialProblem       stream_problem;
    std::vector<double> widths; // log(upper/lower) on the meshes that reach the spacing
    Bracket             plain;  // without correction; guides refinement
    unsigned long long  unknowns_needed = 0; // for the target accuracy; 0: not known
  };
} // namespace strait
