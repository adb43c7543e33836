// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/load_sweep.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // Grid points along a throat. Half of it lets exponents pass that the grid spoils,
    // double of it doubts results that a finer grid would hardly change.
    constexpr double points_along_needed = 7.;

    // An error δ of L_c spoils the local exponent at reduced loads ε below about 20 δ:
    // there it changes ε, and with it the slope of the leak rate, by a twentieth. Half of
    // it lets a tenth pass, double of it doubts a fortieth.
    constexpr double load_errors_needed = 20.;

    // Exponent of the leak rate near the threshold, from the paper.
    constexpr double leak_rate_exponent = 69. / 20;

    /** Return how much the leak rate through @p gap differs, relative, from that of
     *  @p step. Collective. */
    double
    change_to(const SlabField &gap, const Step &step, const FluidParameters &fluid)
    {
      Log       silent(gap.layout().communicator(), true);
      Timers    timers;
      FlowStage flow(fluid, gap.layout_pointer(), silent, timers);
      return flow.change_to(gap, step.state.control.slip_length, *step.flow);
    }

    void
    add_contact_grid(const Step   &step,
                     const bool    by_reduced_load,
                     const Scene  &scene,
                     CoarserSeals &coarser,
                     StepErrors   &errors)
    {
      // Leak rates on every second and every fourth point, as far as there are such
      // grids, over that on all points; 0 if the gap seals there.
      std::vector<double> leaks;
      for (int h = 1; h <= std::min(coarser.size(), n_compared_grids(scene)); ++h)
        {
          const auto gap =
            coarser.gap(h,
                        step.state.control,
                        by_reduced_load ? step.reduced_load : std::nullopt);
          leaks.push_back(gap ? 1. + change_to(*gap, step, scene.fluid) : std::nan(""));
        }
      // Not a number if there is no coarser grid.
      const double first = leaks.empty() ? std::nan("") : 1. - leaks[0];
      double       error = CoarserSeals::safety_factor * std::abs(first);
      if (leaks.size() > 1 && leaks[0] != 0)
        {
          const double second = leaks[0] - leaks[1];
          const double order  = std::log2(std::abs(second / first));
          // Outside of these orders it is chance rather than convergence.
          if (second * first > 0 && order > .5 && order < 4.)
            {
              const double beyond = first / (std::exp2(order) - 1.);
              errors.grid_order   = order;
              errors.extrapolated = step.flow->leakage.rate * (1. + beyond);
              error               = std::abs(beyond);
            }
        }
      errors.items.push_back({"contact grid", error, "Contact/Grid points"});
    }
  } // namespace

  StepErrors
  assess_errors(const Step       &step,
                const Transition *reference_critical_load,
                const Scene      &scene,
                const double      rms_height,
                const FlowStage  &flow,
                CoarserSeals     &coarser)
  {
    StepErrors     errors;
    const Leakage &leakage     = step.flow->leakage;
    const double   by_wall     = step.state.fluid ? step.state.fluid->mesh_error : 0.;
    const bool     is_rarefied = scene.fluid.rarefaction != Rarefaction::none;
    const double   of_mesh =
      is_rarefied ? .5 * leakage.mesh_width : leakage.relative_error();
    errors.items.push_back({"mesh", of_mesh - by_wall, "Fluid/Target accuracy"});
    if (is_rarefied)
      errors.items.push_back(
        {"order of gaps", leakage.relative_error() - of_mesh, "Fluid/Rarefaction"});
    errors.items.push_back(
      {"linear solver", leakage.linear_error, "Fluid/Target accuracy"});
    if (step.state.contact)
      errors.items.push_back({"contact tolerance",
                              3. * step.state.contact->residual * rms_height /
                                step.flow->channel.paths.front().bottleneck_gap,
                              "Contact/Tolerance"});
    if (step.state.fluid)
      errors.items.push_back(
        {"fluid pressure on the wall", by_wall, "Fluid/Target accuracy"});
    if (reference_critical_load != nullptr)
      errors.items.push_back(
        {"critical load",
         std::pow(1. +
                    .5 * reference_critical_load->relative_width() / *step.reduced_load,
                  leak_rate_exponent) -
           1.,
         "Load programme/Threshold tolerance"});
    if (n_compared_grids(scene) > 0)
      {
        add_contact_grid(
          step, reference_critical_load != nullptr, scene, coarser, errors);
        errors.items.push_back({"gap interpolation",
                                std::abs(flow.change_by_interpolation(*step.flow)),
                                "Contact/Grid points"});
      }
    else
      errors.items.push_back(
        {"contact grid",
         std::nan(""),
         scene.fluid.mesh_file.empty() ? "Output/Error budget" : "Contact/Grid points"});
    std::stable_sort(errors.items.begin(),
                     errors.items.end(),
                     [](const ErrorItem &a, const ErrorItem &b) {
                       return std::isnan(a.relative) ? !std::isnan(b.relative)
                                                     : a.relative > b.relative;
                     });
    return errors;
  }

  std::vector<std::string>
  doubts_near_threshold(const Step       &step,
                        const Transition &threshold,
                        const bool        zooms,
                        Log              &log)
  {
    std::vector<std::string> doubts;
    const double             reduced     = *step.reduced_load;
    const double             load_error  = .5 * threshold.relative_width();
    const bool               leaks       = step.flow->channel.percolates();
    const bool               contradicts = leaks == (reduced < 0);
    const bool               leaks_below = reduced > 0 && step.flow->constrictions;
    if (contradicts && std::abs(reduced) > load_error)
      {
        doubts.emplace_back("uncertain-threshold");
        log.warn(
          format("at a reduced load of %.3g the seal %s, which contradicts its "
                 "critical load: shorter steps of Load programme may follow the "
                 "state that was found there",
                 reduced,
                 leaks ? "leaks" : "does not leak"));
      }
    else if (contradicts || (leaks_below && reduced < load_errors_needed * load_error))
      {
        doubts.emplace_back("uncertain-threshold");
        log.warn(
          format("at a reduced load of %.3g the critical load, known to %.1e, is too "
                 "uncertain: a threshold tolerance of %.1e would do",
                 reduced,
                 load_error,
                 2. * std::abs(reduced) / load_errors_needed));
      }
    else if (!leaks && -reduced < threshold.grid_error)
      {
        doubts.emplace_back("uncertain-threshold");
        log.warn(
          format("the load is %.2g %% above the critical one, and finer points may "
                 "have that %s: whether it seals is uncertain",
                 -100. * reduced,
                 std::isinf(threshold.grid_error)
                   ? "anywhere above"
                   : format("%.2g %% higher", 100. * threshold.grid_error).c_str()));
      }
    if (!leaks_below)
      return doubts;
    const double points_along = step.flow->constrictions->points_along;
    if (!(points_along >= points_along_needed))
      {
        doubts.emplace_back("unresolved-throat");
        log.warn(
          std::isnan(points_along)
            ? format("at a reduced load of %.3g the narrowest point is no saddle of the "
                     "gap: how well the grid resolves it cannot be told",
                     reduced)
            : format("at a reduced load of %.3g the throat has %.2g grid points along "
                     "it, %.0f are needed: ",
                     reduced,
                     points_along,
                     points_along_needed) +
                (zooms ? "raise Contact/Zoom/Points along throat"
                       : format("a grid finer by a factor of %.3g would do",
                                std::ceil(100. * points_along_needed / points_along) /
                                  100.)));
      }
    return doubts;
  }
} // namespace strait
