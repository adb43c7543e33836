// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/contact/contact_area.h>
#include <strait/contact/contact_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    /** How often a state that is no minimum is pushed off. */
    constexpr int max_pushes = 5;

    /** Largest change of the gap by a push, in ranges. */
    constexpr double push = .1;

    /** A quotient of this size is rounding. */
    constexpr double curvature_noise = 1e-7;

    /** The rms of K h, E* times the rms slope over 2. */
    double
    flattening_traction(const SlabField &heights, const double modulus)
    {
      HalfSpaceGapProblem problem(heights, modulus, {});
      SlabField           traction(heights.layout_pointer());
      problem.apply(heights.data(), traction.data(), no_pass);
      return rms(traction);
    }
  } // namespace

  AdhesiveContactSolver::AdhesiveContactSolver(const ContactParameters &parameters_,
                                               const AdhesionLaw       &law_,
                                               const AdhesiveStart      start_,
                                               SlabField                heights_)
    : parameters(parameters_)
    , law(law_)
    , start(start_)
    , heights(std::move(heights_))
    , traction_scale(flattening_traction(heights, parameters.effective_modulus))
    , problem(heights, parameters.effective_modulus, law)
    , stability(problem,
                parameters.control == ContactControl::load
                  ? GapConstraint::Kind::nominal_pressure
                  : GapConstraint::Kind::mean_gap)
  {
    if (!std::isfinite(traction_scale))
      throw InputError(
        "The surface has heights that are not finite numbers; mend the "
        "Expression or File of the section Surface.");
  }

  ContactState
  AdhesiveContactSolver::solve(const double target)
  {
    choose_start(target);
    last_target = target;

    const long                  n_before = problem.n_applications();
    std::vector<RelaxationStep> relaxation;
    RelaxationObserver          observer;
    if (parameters.adhesion.write_relaxation)
      observer = [&relaxation](const RelaxationStep &step) {
        relaxation.push_back(step);
      };
    const auto optimiser = make_optimiser(target, observer);
    peak_memory          = std::max(
      peak_memory,
      (heights.size() + 2 * gap.size() + stability.direction().size()) * sizeof(double) +
        earlier_gap.size() * sizeof(float) + problem.memory_consumption() +
        std::max(optimiser->memory_consumption(), stability.memory_consumption()));

    GapSolution solution   = optimiser->solve(gap.data());
    int         iterations = solution.iterations;
    double      curvature  = std::numeric_limits<double>::quiet_NaN();
    for (int pushes = 0; solution.converged && !solution.detached; ++pushes)
      {
        curvature = stability.smallest_curvature(gap.data(), optimiser->curvature());
        if (curvature > -curvature_noise || pushes == max_pushes)
          break;
        push_off();
        solution = optimiser->solve(gap.data());
        iterations += solution.iterations;
      }

    ContactState state                 = state_of(*optimiser, solution);
    state.iterations                   = iterations;
    state.fft_pairs                    = problem.n_applications() - n_before;
    state.adhesion->smallest_curvature = curvature;
    state.adhesion->relaxation         = std::move(relaxation);
    // A saddle point that could not be left is not what was asked for.
    state.converged = state.converged && !(curvature < -curvature_noise);
    return state;
  }

  std::unique_ptr<GapOptimiser>
  AdhesiveContactSolver::make_optimiser(const double target, RelaxationObserver observer)
  {
    const bool          by_load = parameters.control == ContactControl::load;
    const GapConstraint constraint{by_load ? GapConstraint::Kind::nominal_pressure
                                           : GapConstraint::Kind::mean_gap,
                                   target};
    // A flat surface has no traction of its own.
    const double       scale = traction_scale > 0 ? traction_scale
                               : by_load          ? std::abs(target)
                                                  : law.at(0).traction;
    const GapTolerance tolerance{parameters.tolerance,
                                 scale,
                                 parameters.maximum_iterations};
    return make_gap_optimiser(
      parameters.adhesion.method, problem, constraint, tolerance, std::move(observer));
  }

  void
  AdhesiveContactSolver::choose_start(const double target)
  {
    if (!std::isfinite(target) ||
        (parameters.control == ContactControl::mean_gap && !(target > 0)))
      throw InputError("Load programme/Pressures contains " + to_text(target) +
                       " but a mean gap must be positive.");
    if (gap.empty())
      gap = first_gap(target);
    else if (!earlier_gap.empty() && target != last_target)
      extrapolate(target);
    else
      {
        earlier_gap.assign(gap.begin(), gap.end());
        earlier_target = last_target;
      }
  }

  /** Where the last two states lead to; what closes there stays closed. */
  void
  AdhesiveContactSolver::extrapolate(const double target)
  {
    const double ratio   = (target - last_target) / (last_target - earlier_target);
    const bool   is_near = ratio > 0 && ratio <= 2;
    for (std::size_t i = 0; i < gap.size(); ++i)
      {
        const double last = gap[i];
        if (is_near && last > 0)
          gap[i] = std::max(0., last + ratio * (last - earlier_gap[i]));
        earlier_gap[i] = static_cast<float>(last);
      }
    earlier_target = last_target;
  }

  SlabField
  AdhesiveContactSolver::first_gap(const double target) const
  {
    if (start == AdhesiveStart::full_contact)
      return SlabField(heights.layout_pointer());
    if (!(target > 0))
      throw InputError("Load programme/Pressures begins with " + to_text(target) +
                       " but with adhesion it must begin with a positive load that "
                       "makes contact, from which tension can pull.");
    ContactParameters without = parameters;
    without.tolerance         = std::max(1e-4, parameters.tolerance);
    return ContactSolver(without, heights).solve(target).gap;
  }

  /** Leave a saddle point of the energy, towards smaller gaps. */
  void
  AdhesiveContactSolver::push_off()
  {
    const std::vector<double> &v = stability.direction();
    const auto [mean, square] = weighted_sums<2>(problem, [&v](const auto i, auto &sums) {
      sums[0] += v[i];
      sums[1] += v[i] * v[i];
    });
    double largest            = 0;
    for (const double value : v)
      largest = std::max(largest, std::abs(value));
    largest = problem.largest_over_ranks(largest);
    // A mean of zero but for rounding must give the same sign everywhere.
    const bool   inwards = mean > 1e-9 * std::sqrt(square);
    const double factor  = (inwards ? -push : push) * law.range / largest;
    for (std::size_t i = 0; i < gap.size(); ++i)
      gap[i] += factor * v[i];
  }

  ContactState
  AdhesiveContactSolver::state_of(const GapOptimiser &optimiser,
                                  const GapSolution  &solution) const
  {
    ContactState state;
    state.gap      = gap;
    state.pressure = SlabField(gap.layout_pointer());
    // Within the tolerance a point may be held by no force, but it is held.
    for (std::size_t i = 0; i < gap.size(); ++i)
      state.pressure[i] = gap[i] > 0 ? 0.
                                     : std::max(optimiser.reaction()[i],
                                                std::numeric_limits<double>::min());
    const ContactArea area       = contact_area(state.pressure);
    state.nominal_pressure       = solution.nominal_pressure;
    state.mean_gap               = mean(state.gap);
    state.contact_area           = area.fraction;
    state.contact_area_corrected = area.corrected_fraction;
    state.residual               = solution.residual;
    state.converged              = solution.converged;

    AdhesiveState &adhesion  = state.adhesion.emplace();
    adhesion.adhesive_energy = solution.adhesive_energy;
    adhesion.total_energy    = solution.energy;
    adhesion.detached        = solution.detached;
    return state;
  }

  void
  AdhesiveContactSolver::forget()
  {
    recall({});
  }

  ContactMemory
  AdhesiveContactSolver::memory() const
  {
    return {gap, last_target};
  }

  void
  AdhesiveContactSolver::recall(const ContactMemory &memory)
  {
    gap         = memory.gap;
    last_target = memory.target;
    earlier_gap = std::vector<float>();
  }

  void
  AdhesiveContactSolver::transfer(StateArchive &archive)
  {
    const SlabLayoutPtr &grid = heights.layout_pointer();
    archive.field(gap, grid);
    archive.value(last_target);
    archive.field(earlier_gap, *grid);
    archive.value(earlier_target);
    archive.field(stability.direction(), *grid);
  }

  std::size_t
  AdhesiveContactSolver::memory_consumption() const
  {
    return peak_memory;
  }
} // namespace strait
