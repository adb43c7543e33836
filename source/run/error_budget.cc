// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/contact/grid_transfer.h>
#include <strait/contact/zoom_in.h>
#include <strait/run/error_budget.h>
#include <strait/run/exponent_fit.h>
#include <strait/seal/dry_seal.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/zoom_placement.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    /** The leak rate of a gap; 0 if it seals. */
    double
    leak_rate_of(const SlabField       &gap,
                 const double           slip_length,
                 const FluidParameters &fluid)
    {
      Log       silent(gap.layout().communicator(), true);
      Timers    timers;
      FlowStage flow(fluid, gap.layout_pointer(), silent, timers);
      return flow.solve(gap, slip_length).leakage.rate;
    }
  } // namespace

  ErrorBudget::ErrorBudget(const Scene             &scene_,
                           const ContactParameters &contact,
                           const SlabField         &heights)
    : scene(scene_)
    , rms_height(rms(heights))
    , silent(heights.layout().communicator(), true)
  {
    if (scene.contact.zoom.enabled && can_be_coarsened(heights.grid()))
      {
        SlabField coarse = restrict_by_injection(heights);
        coarser_layout   = coarse.layout_pointer();
        coarser_zoomed   = std::make_unique<ZoomedSeal>(
          std::make_unique<DrySeal>(
            std::make_unique<ContactSolver>(contact, std::move(coarse))),
          scene.contact.zoom,
          scene.fluid.direction,
          silent);
      }
    // What a contact remembers, and what a fluid does to it, is not that of a coarser
    // grid at the same load alone.
    if (!scene.output.error_budget || !scene.contact.enabled ||
        scene.contact.zoom.enabled || scene.contact.adhesion.enabled ||
        scene.fluid.feedback.enabled)
      return;
    SlabField grid_heights = heights;
    while (coarser.size() < 2 && can_be_coarsened(grid_heights.grid()))
      {
        grid_heights = restrict_by_injection(grid_heights);
        coarser.push_back(std::make_unique<ContactSolver>(contact, grid_heights));
      }
  }

  double
  ErrorBudget::leak_on(const int halvings, const Step &step)
  {
    SlabField gap = step.state.gap();
    if (step.state.contact)
      {
        const bool by_load = scene.contact.control == ContactControl::load;
        gap =
          coarser[halvings - 1]
            ->solve(by_load ? step.state.contact->nominal_pressure : step.state.mean_gap)
            .gap;
      }
    else
      for (int h = 0; h < halvings; ++h)
        gap = restrict_by_injection(gap);
    return leak_rate_of(gap, step.state.control.slip_length, scene.fluid);
  }

  void
  ErrorBudget::add_contact_grid(const Step &step, StepErrors &errors)
  {
    if (step.state.contact ? coarser.size() < 2
                           : !can_be_coarsened(step.state.gap().grid()))
      return;
    const double fine   = step.flow->leakage.rate;
    const double half   = leak_on(1, step);
    const double first  = (fine - half) / fine;
    double       error  = std::abs(first);
    const bool   nested = step.state.contact || std::min(step.state.gap().grid().nx,
                                                       step.state.gap().grid().ny) >= 128;
    if (const double quarter = nested ? leak_on(2, step) : half; half != 0)
      {
        const double second = (half - quarter) / fine;
        const double order  = std::log2(std::abs(second / first));
        // One order of magnitude more than that is no convergence but chance.
        if (second * first > 0 && order > .5 && order < 4.)
          {
            errors.grid_order   = order;
            errors.extrapolated = fine * (1. + first / (std::exp2(order) - 1.));
            error               = std::abs(*errors.extrapolated / fine - 1.);
          }
      }
    errors.items.push_back({"contact grid", error, "Contact/Grid points"});
  }

  Control
  ErrorBudget::coarser_control(const Step &step, const Transition *counted_from)
  {
    Control control = step.state.control;
    if (counted_from == nullptr)
      return control;
    if (coarser_thresholds.empty())
      {
        const FlowDomain box(scene.fluid.direction);
        SealSearch       search(scene, *coarser_zoomed, coarser_layout, box, silent);
        coarser_thresholds = search.find_critical_loads(counted_from->lower);
        coarser_state      = search.take_state();
      }
    const Transition *own = threshold_of(coarser_thresholds, counted_from->slip_length);
    control.target        = (1. - *step.reduced_load) * own->middle();
    return control;
  }

  void
  ErrorBudget::add_zoom(const Step       &step,
                        SealModel        &seal,
                        const Transition *counted_from,
                        StepErrors       &errors)
  {
    const double fine = step.flow->leakage.rate, slip = step.state.control.slip_length;
    const auto   change = [&](const SlabField &gap) {
      return std::abs(leak_rate_of(gap, slip, scene.fluid) / fine - 1.);
    };
    const SlabLayout &layout = step.state.gap().layout();
    if (!layout.windows().empty())
      {
        SealState fewer;
        fewer.control = step.state.control;
        fewer.contact = zoom_in(*step.state.contact, without_finest(layout));
        fewer         = seal.solve(fewer.control, &fewer, Aim::comparison);
        errors.items.push_back(
          {"zoom levels", .5 * change(fewer.gap()), "Contact/Zoom/Points along throat"});
      }
    if (coarser_zoomed)
      {
        const Control control = coarser_control(step, counted_from);
        coarser_state         = coarser_zoomed->solve(control,
                                              coarser_state ? &*coarser_state : nullptr,
                                              Aim::leak_rate);
        errors.items.push_back(
          {"contact grid", change(coarser_state->gap()), "Contact/Grid points"});
      }
  }

  void
  ErrorBudget::add_interpolation(const Step &step, StepErrors &errors) const
  {
    FluidParameters other = scene.fluid;
    other.interpolation   = scene.fluid.interpolation == GapInterpolation::monotone_cubic
                              ? GapInterpolation::bilinear
                              : GapInterpolation::monotone_cubic;
    const double leak =
      leak_rate_of(step.state.gap(), step.state.control.slip_length, other);
    errors.items.push_back({"gap interpolation",
                            std::abs(leak / step.flow->leakage.rate - 1.),
                            "Contact/Grid points"});
  }

  StepErrors
  ErrorBudget::assess(const Step &step, SealModel &seal, const Transition *counted_from)
  {
    StepErrors     errors;
    const Leakage &leakage = step.flow->leakage;
    const double   by_wall = step.state.fluid ? step.state.fluid->mesh_error : 0.;
    errors.items.push_back(
      {"mesh", .5 * leakage.relative_width() - by_wall, "Fluid/Target accuracy"});
    errors.items.push_back(
      {"linear solver", leakage.linear_error, "Fluid/Target accuracy"});
    if (step.state.contact)
      errors.items.push_back({"contact tolerance",
                              3. * step.state.contact->residual * rms_height /
                                step.flow->channel.paths.front().bottleneck_gap,
                              "Contact/Tolerance"});
    if (step.state.fluid)
      {
        errors.items.push_back(
          {"fluid pressure on the wall", by_wall, "Fluid/Target accuracy"});
        errors.items.push_back({"feedback iteration",
                                scene.fluid.feedback.tolerance,
                                "Fluid/Wall feedback/Tolerance"});
      }
    if (counted_from != nullptr)
      errors.items.push_back(
        {"critical load",
         leak_rate_exponent * .5 * counted_from->relative_width() / *step.reduced_load,
         "Load programme/Threshold tolerance"});
    if (scene.contact.zoom.enabled)
      add_zoom(step, seal, counted_from, errors);
    else if (scene.output.error_budget)
      add_contact_grid(step, errors);
    if (scene.contact.zoom.enabled || scene.output.error_budget)
      add_interpolation(step, errors);
    std::stable_sort(errors.items.begin(),
                     errors.items.end(),
                     [](const ErrorItem &a, const ErrorItem &b) {
                       return a.relative > b.relative;
                     });
    return errors;
  }

  void
  ErrorBudget::transfer(StateArchive &archive)
  {
    strait::transfer(archive, coarser_thresholds);
    if (transfer_presence(archive, coarser_state))
      strait::transfer(archive, *coarser_state, coarser_layout);
  }

  Json
  to_json(const Step &step)
  {
    Json relative = Json::object();
    for (const ErrorItem &item : step.errors.items)
      relative.set(item.source, item.relative);
    Json record = Json::object();
    record.set("step", step.number).set("relative_errors", relative);
    const ErrorItem &largest = step.errors.items.front();
    record.set("largest", largest.source).set("reduced_by", largest.parameter);
    if (step.errors.extrapolated)
      record.set("contact_grid_order", *step.errors.grid_order)
        .set("leak_rate_extrapolated", *step.errors.extrapolated);
    return record;
  }

  std::string
  describe_errors(const StepErrors &errors)
  {
    const ErrorItem &largest = errors.items.front();
    std::string      text = format("  largest error of the leak rate: %s, %.2g %% (%s)",
                              largest.source.c_str(),
                              100. * largest.relative,
                              largest.parameter.c_str());
    if (errors.extrapolated)
      text += format("; order in the grid %.2f, extrapolated leak rate %.5g",
                     *errors.grid_order,
                     *errors.extrapolated);
    return text;
  }
} // namespace strait
