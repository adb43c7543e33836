// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/rounding.h>
#include <strait/base/text.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/contact/contact_solver.h>
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    /** Largest change of the gap in a push off a saddle point, in units of the range z0.
     *  With half of it the optimiser takes longer to leave the saddle point, or does not;
     *  double of it may push past the next state. */
    constexpr double push = .1;

    /** A Rayleigh quotient up to this size is 0 but for rounding. */
    const double curvature_noise = std::sqrt(std::numeric_limits<double>::epsilon());

    /** Return the rms of K h, which is E* times the rms slope over 2. Collective. */
    double
    flattening_traction(GapProblem &problem, const SlabLayoutPtr &layout)
    {
      SlabField traction(layout);
      problem.apply(problem.heights, traction.data());
      return rms(traction);
    }
  } // namespace

  AdhesiveContactSolver::AdhesiveContactSolver(const ContactParameters &parameters_,
                                               const AdhesionLaw       &law,
                                               const LoadPath           path,
                                               SlabField                heights_)
    : parameters(parameters_)
    , unloads(path == LoadPath::unloading)
    , wall(std::move(heights_), parameters.effective_modulus)
    , problem(wall.heights, parameters.effective_modulus, law)
    , traction_scale(flattening_traction(problem, wall.heights.layout_pointer()))
  {
  }

  ContactState
  AdhesiveContactSolver::solve(const double        target,
                               const ContactState *from,
                               const SlabField    *fluid_pressure,
                               Digits)
  {
    check(target, from);
    wall.deform(fluid_pressure);
    const bool   is_dry = fluid_pressure == nullptr;
    const double solid_target =
      parameters.is_load_controlled() ? target - wall.fluid_load : target;
    SlabField           gap = start_gap(target, solid_target, from, is_dry);
    std::vector<double> softest;
    if (from != nullptr && from->adhesion)
      softest = from->adhesion->softest_direction;

    const long n_before  = problem.n_applications();
    const auto optimiser = make_optimiser(solid_target);

    GapSolution                 solution;
    int                         iterations = 0;
    std::vector<RelaxationStep> relaxation;
    double                      curvature = std::numeric_limits<double>::quiet_NaN();
    double                      energy    = std::numeric_limits<double>::infinity();
    while (true)
      {
        solution = optimiser->solve(gap.data());
        iterations += solution.iterations;
        const AdhesiveState &found = solution.adhesion;
        relaxation.insert(relaxation.end(),
                          found.relaxation.begin(),
                          found.relaxation.end());
        if (!solution.converged || found.detached)
          break;
        curvature = optimiser->smallest_curvature(softest);
        // A state that was pushed off and has no lower energy came back to the saddle.
        if (curvature > -curvature_noise || !(found.total_energy < energy))
          break;
        energy = found.total_energy;
        push_off(softest, gap);
      }
    // A saddle point that could not be left is no solution.
    solution.converged &= !(curvature < -curvature_noise);
    solution.iterations                  = iterations;
    solution.adhesion.smallest_curvature = curvature;
    solution.adhesion.softest_direction  = std::move(softest);
    solution.adhesion.relaxation         = parameters.adhesion.write_relaxation
                                             ? std::move(relaxation)
                                             : std::vector<RelaxationStep>();

    ContactState state = state_of(*optimiser, std::move(solution), std::move(gap));
    state.fft_pairs    = problem.n_applications() - n_before;
    state.approach     = from != nullptr && is_dry
                           ? Approach(solid_target, from->gap, from->approach.target())
                           : Approach(solid_target);
    return state;
  }

  std::unique_ptr<GapOptimiser>
  AdhesiveContactSolver::make_optimiser(const double target)
  {
    const bool by_load = parameters.is_load_controlled();
    // A flat surface has no traction scale of its own.
    const double           scale = traction_scale > 0 ? traction_scale
                                   : by_load          ? std::abs(target)
                                                      : problem.adhesion.at(0).traction;
    const GapConstraint    constraint{!by_load, target};
    const ContactTolerance tolerance{parameters.tolerance,
                                     scale,
                                     parameters.maximum_iterations};
    if (parameters.adhesion.method == AdhesionMethod::newton_cg)
      return std::make_unique<GapNewton>(problem, constraint, tolerance);
    if (parameters.adhesion.method == AdhesionMethod::gfmd)
      return std::make_unique<GapDynamics>(problem, constraint, tolerance);
    return std::make_unique<GapConjugateGradients>(problem, constraint, tolerance);
  }

  void
  AdhesiveContactSolver::check(const double target, const ContactState *from) const
  {
    if (!std::isfinite(target) || (!parameters.is_load_controlled() && !(target > 0)))
      throw InputError("Load programme/Pressures contains " + to_text(target) +
                       " but a mean gap must be positive.");
    if (from == nullptr && !unloads && !(target > 0))
      throw InputError("Load programme/Pressures begins with " + to_text(target) +
                       " but with adhesion it must begin with a positive load that "
                       "makes contact, from which tension can pull.");
  }

  /** Return a start: without a state @p from as the constructor says; after a short step
   *  the extrapolation of @p from and the state before, with points that close in it at
   *  0; else the gap of @p from. The solid carries @p solid_target of the @p target.
   *  Collective. */
  SlabField
  AdhesiveContactSolver::start_gap(const double        target,
                                   const double        solid_target,
                                   const ContactState *from,
                                   const bool          is_dry) const
  {
    if (from == nullptr && unloads)
      return SlabField(wall.heights.layout_pointer());
    if (from == nullptr)
      {
        ContactParameters without = parameters;
        without.tolerance         = std::max(1e-4, parameters.tolerance);
        return ContactSolver(without, wall.heights)
          .solve(solid_target > 0 ? solid_target : target)
          .gap;
      }
    const double steps   = from->approach.steps_to(solid_target);
    const bool   is_near = is_dry && steps > 0 && steps <= 2;
    return is_near ? from->approach.extrapolated(from->gap, solid_target) : from->gap;
  }

  /** Push @p gap off a saddle point of the energy along @p v, towards smaller gaps.
   *  Collective. */
  void
  AdhesiveContactSolver::push_off(const std::vector<double> &v, SlabField &gap) const
  {
    const auto [mean, square] = weighted_sums<2>(problem, [&v](const auto i, auto &sums) {
      sums[0] += v[i];
      sums[1] += v[i] * v[i];
    });
    double largest            = 0;
    for (const double value : v)
      largest = std::max(largest, std::abs(value));
    largest = maximum(problem.communicator, largest);
    // If the mean is 0 but for rounding, the sign must not depend on rounding.
    const bool   inwards = mean > rounding * std::sqrt(square);
    const double factor  = (inwards ? -push : push) * problem.adhesion.range / largest;
    for (std::size_t i = 0; i < gap.size(); ++i)
      gap[i] += factor * v[i];
  }

  ContactState
  AdhesiveContactSolver::state_of(const GapOptimiser &optimiser,
                                  GapSolution         solution,
                                  SlabField           gap) const
  {
    SlabField pressure(wall.heights.layout_pointer());
    // Within the tolerance the reaction at a closed point may not be positive. The point
    // is in contact all the same.
    for (std::size_t i = 0; i < gap.size(); ++i)
      pressure[i] = gap[i] > 0 ? 0.
                               : std::max(optimiser.reaction()[i],
                                          std::numeric_limits<double>::min());
    ContactState state(std::move(pressure), std::move(gap));
    static_cast<ContactSolution &>(state) = solution;
    state.nominal_pressure                = solution.nominal_pressure + wall.fluid_load;
    state.adhesion                        = std::move(solution.adhesion);
    return state;
  }
} // namespace strait
