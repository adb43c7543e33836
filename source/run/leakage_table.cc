// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/result_tables.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // Values of columns of trapped fluid, 0 where the walls have lifted off.
    const auto of_trapped = [](double TrappedFluid::*member) {
      return [member](const Step &step) {
        const std::optional<TrappedFluid> &trapped = step.state.fluid->trapped;
        return trapped ? *trapped.*member : 0.;
      };
    };

    void
    add_leak_rates(Table<Step> &table, const Scene &scene, const Condition &with_flow)
    {
      const FluidParameters fluid = scene.fluid;
      table.when(with_flow)
        .add(
          [](const Step &step) { return step.flow->leakage.rate; },
          "leak_rate [length³/time]: Q, volume per time from inlet to outlet: geometric "
          "mean of its bounds, or the upper one if they differ by more than a factor of "
          "two; with `Fluid/Rarefaction` the same of those that enclose what leaks if the "
          "gas slips as it does in the solution, `mesh_error` apart, but within "
          "`leak_rate_lower` and `leak_rate_upper`; 0 if nothing percolates; negative if "
          "the outlet has the higher pressure")
        .add([](const Step &step) { return step.flow->leakage.lower; },
             "leak_rate_lower [length³/time]: lower bound of its magnitude, the best of "
             "all meshes; with `Wall feedback` bounds are widened by what the last mesh "
             "changed of it through the gap")
        .add([](const Step &step) { return step.flow->leakage.upper; },
             "leak_rate_upper [length³/time]: upper bound, likewise");
      table
        .when({"with `Contact/Zoom` or `Output/Error budget`",
               scene.fluid.enabled &&
                 (scene.contact.zoom.enabled || scene.output.error_budget)})
        .add([](const Step &step) { return step.errors.sum(); },
             "leak_rate_error [1]: relative error of the leak rate: mesh, contact grid, "
             "gap interpolation and tolerances together, see "
             "[run.json](#runjson); `nan` if nothing percolates or one of them is not "
             "known");
      table.when({"with `Output/Leak rate units`", scene.fluid.enabled});
      for (const std::string &name : scene.output.leak_rate_units)
        {
          const LeakRateUnit  *unit  = find_row(leak_rate_units, name);
          const UnitParameters units = scene.units;
          table.add(
            [=](const Step &step) {
              const double rate = step.flow->leakage.rate;
              return in_trade_unit(rate, *unit, units, fluid);
            },
            std::string(unit->column) + " [" + unit->name + "]: " +
              (unit->is_throughput
                 ? "throughput of a gas, Q (p_in + p_out)/2" +
                     std::string(name == "sccm" ? ", at 0 °C and 101325 Pa" : "")
                 : "`leak_rate` in this unit"));
        }
      table
        .when({"with `Seal/Two in a row`, which patches of a seal have",
               scene.has_two_boxes()})
        .add(
          [](const Step &step) { return step.two_boxes->rate; },
          "two_boxes_leak_rate [length³/time]: Q through two such boxes, one behind the "
          "other, under the same pressure drop")
        .add([](const Step &step) { return step.two_boxes->relative_width(); },
             "two_boxes_error [1]: relative width of its bracket");
      table
        .when({"with `Fluid/Rarefaction`",
               scene.fluid.enabled && scene.fluid.rarefaction != Rarefaction::none})
        .add(
          [=](const Step &step) {
            return step.flow->leakage.rate * fluid.mean_pressure();
          },
          "throughput [pressure length³/time]: of the gas, `leak_rate` times the mean "
          "pressure of the reservoirs")
        .add([](const Step &step) { return step.flow->leakage.knudsen; },
             "knudsen [1]: mean free path over gap at the worst constriction, at the "
             "pressure where the path of least resistance has as much of its viscous "
             "resistance before it: an estimate, up to half off against vacuum; `nan` if "
             "nothing percolates")
        .add(
          [](const Step &step) { return step.flow->leakage.bound; },
          "bound: which bounds of the nonlinear problem `leak_rate_lower` and "
          "`leak_rate_upper` are, the mesh's error included: `any-order`, which hold "
          "whichever gap the gas meets at which pressure, `two-gases`, with the lower one "
          "that of a viscous and a molecular gas side by side, or `none`; see "
          "[gas](gas_and_metals.md#gas)")
        .add(
          [](const Step &step) { return step.flow->leakage.mesh_width; },
          "mesh_error [1]: relative width of the bracket that the mesh alone leaves, if "
          "the gas slips as it does in the solution; this is what `Target accuracy` is "
          "for; `nan` if nothing percolates");
      table.when(with_flow)
        .add(
          [=](const Step &step) { return effective_gap(step.flow->leakage, fluid); },
          "effective_gap [length]: (12 η K_eff)^(1/3) with K_eff = Q L/(W Δp), or in a "
          "mesh ([meshes](meshes.md)) Q/(S Δp) with Q = S K Δp at a uniform K: smooth "
          "plates with this gap leak as much; with `Fluid/Rarefaction` the gap of smooth "
          "plates through which as much of the rarefied gas leaks, which is smaller")
        .add([](const Step &step) { return step.place_of_bottleneck()[0]; },
             "worst_constriction_x [length]: narrowest grid point of the path of least "
             "resistance ∫ds/g³; at the outlet, the copy of x = 0 at x = Lx; `nan` if "
             "nothing percolates")
        .add([](const Step &step) { return step.place_of_bottleneck()[1]; },
             "worst_constriction_y [length]: its y, likewise")
        .add(
          [](const Step &step) {
            const std::vector<FlowPath> &paths = step.flow->channel.paths;
            return paths.empty() ? std::nan("") : paths.front().bottleneck_gap;
          },
          "worst_constriction_gap [length]: the gap that the fluid sees there");
      table
        .when({"with `Contact/Zoom`", scene.fluid.enabled && scene.contact.zoom.enabled})
        .add(
          [](const Step &step) {
            int levels = 0;
            for (const ZoomWindow &window : step.state.gap().layout().windows())
              levels = std::max(levels, window.level);
            return levels;
          },
          "zoom_levels [1]: how often the spacing of the contact grid is divided by "
          "three where it is finest")
        .add(
          [](const Step &step) {
            return step.flow->channel.paths.empty() ? std::nan("")
                                                    : step.flow->channel.throat.points;
          },
          "points_along_throat [1]: finest points along the flow, from the worst "
          "constriction to where the gap is twice as large");
    }
  } // namespace

  Table<Step>
  leakage_table(const Scene &scene)
  {
    const bool      theory_alone = scene.is_theory_only();
    const Condition with_contact = {"", scene.contact.enabled};
    const Condition with_flow    = {"", scene.fluid.enabled};

    Table<Step> table(
      "leakage.csv",
      {},
      "One row a step, written as soon as the step is done. Columns of an effect that is "
      "off (`Contact/Enabled = false`, `Fluid/Enabled = false`) are absent.");
    table
      .add(&Step::number,
           "step [1]: number of the row, from 1: a load with one slip length")
      .when(with_contact)
      .add(&Step::branch,
           "branch: the load path, `loading` or `unloading`; with adhesion, yielding or "
           "wall feedback and in a cycle the direction of the last change of the load")
      .when({"", scene.contact.enabled || theory_alone})
      .add(
        [](const Step &step) {
          return step.state.contact ? step.state.contact->nominal_pressure
                                    : step.theory->pressure;
        },
        "pressure [pressure]: nominal pressure: external load over the area of the "
        "box; tension is negative")
      .when({"", !theory_alone})
      .add([](const Step &step) { return step.state.mean_gap; },
           "mean_gap [length]: mean of the gap over the box; points in contact count as "
           "zero")
      .when(with_contact)
      .add(
        [](const Step &step) { return step.state.contact->contact_area; },
        "contact_area [1]: fraction of the area in contact, where the hard wall pushes "
        "back")
      .add([](const Step &step) { return step.state.contact->contact_area_corrected; },
           "contact_area_corrected [1]: the same for the continuum: A − 0.118 S a, with "
           "the lattice perimeter S of the contact, less where it yields up to its edge, "
           "and the spacing a = √(dx dy) of the points")
      .when({"if some slip length is not zero",
             scene.fluid.has_slip() && (scene.fluid.enabled || theory_alone)})
      .add([](const Step &step) { return step.state.control.slip_length; },
           "slip_length [length]: d0")
      .when(with_flow)
      .add([](const Step &step) { return step.flow->channel.percolates(); },
           "percolates [1]: 1 if an open channel connects inlet and outlet, 0 if not")
      .when(
        {"with `Find threshold`", scene.fluid.enabled && scene.programme.find_threshold})
      .add(
        [](const Step &step) { return step.reduced_load.value_or(std::nan("")); },
        "reduced_load [1]: 1 − L/L_c with the middle of the bracket of L_c; `nan` on the "
        "other branch of a path that matters");
    add_leak_rates(table, scene, with_flow);
    table.when(with_contact)
      .add(
        [](const Step &step) { return step.state.contact->residual; },
        "contact_residual [1]: max( max over contact of \\|g\\|, max elsewhere of −g "
        ") / rms height, at exact force balance; where the contact flows g counts in "
        "place of \\|g\\|; with adhesion the largest traction that is not balanced, over "
        "E* × rms slope / 2")
      .add([](const Step &step) { return step.state.costs.iterations; },
           "contact_iterations [1]: on the finest grid; with adhesion those of all loads "
           "since the last step, and of the check of the minimum")
      .add([](const Step &step) { return step.state.costs.fft_pairs; },
           "fft_pairs [1]: transforms there and back, counted likewise")
      .when(with_flow)
      .add([](const Step &step) { return step.flow->leakage.cells; },
           "cells [1]: active cells of the last mesh")
      .add([](const Step &step) { return step.flow->leakage.unknowns; },
           "unknowns [1]: of pressure and stream function together, on the last mesh")
      .add([](const Step &step) { return step.flow->leakage.refinements; },
           "refinements [1]: meshes after the first")
      .add([](const Step &step) { return step.flow->leakage.iterations; },
           "flow_iterations [1]: of the linear solver, all meshes, both problems")
      .when({"with adhesion", scene.contact.enabled && scene.contact.adhesion.enabled})
      .add([](const Step &step) { return step.state.contact->adhesion->adhesive_energy; },
           "adhesive_energy [pressure length]: mean over the box of the law's γ(g) = "
           "−γ0 f(g/z0), energy per area")
      .add(&Step::dissipated_energy,
           "dissipated_energy [pressure length]: by the jumps since the last step, see "
           "[jumps.csv](#jumpscsv)")
      .when({"with `Contact/Yielding`", scene.contact.enabled && scene.contact.yields})
      .add(
        [](const Step &step) { return step.state.contact->plasticity->area; },
        "plastic_area [1]: fraction of grid points where the pressure is the hardness, "
        "to a thousandth")
      .add(
        [](const Step &step) { return step.state.contact->plasticity->mean_indentation; },
        "mean_indentation [length]: mean over the box of what the surface was indented "
        "by at this load and all before it; rows at `Reduced loads` begin with the "
        "surface as it was")
      .when(with_contact)
      .add([](const Step &step) { return step.state.costs.contact_seconds; },
           "contact_seconds [s]: wall-clock time of the contact")
      .when(with_flow)
      .add(&Step::flow_seconds, "flow_seconds [s]: wall-clock time of the flow")
      .when({"with `Wall feedback`", scene.fluid.feedback.enabled})
      .add([](const Step &step) { return step.state.fluid->load; },
           "fluid_load [pressure]: mean fluid pressure over the nominal area, part of "
           "`pressure`")
      .add(
        [](const Step &step) { return step.state.costs.rounds; },
        "feedback_iterations [1]: rounds of contact and flow, in all parts of a halved step")
      .when({"with `Trapped fluid` other than `drained`",
             scene.fluid.feedback.keeps_trapped_fluid()})
      .add(
        of_trapped(&TrappedFluid::area),
        "trapped_area [1]: of open regions that no reservoir reaches, over the nominal "
        "area")
      .add(of_trapped(&TrappedFluid::pressure),
           "trapped_pressure [pressure]: of the fluid in these, mean over their area")
      .when({"with `Theory/Enabled`, and not where the gap is given",
             scene.theory.enabled && (scene.contact.enabled || theory_alone)})
      .add(
        [](const Step &step) { return step.theory->contact_area; },
        "theory_contact_area [1]: of Persson's theory; `nan` under tension, as all of the "
        "theory")
      .add([](const Step &step) { return step.theory->mean_gap; },
           "theory_mean_gap [length]: likewise")
      .when({"with `Theory/Enabled` and `Contact/Yielding`",
             scene.theory.enabled && scene.contact.yields &&
               (scene.contact.enabled || theory_alone)})
      .add([](const Step &step) { return step.theory->yielding->elastic; },
           "theory_elastic_area [1]: in contact below the hardness, of Persson's theory "
           "with the same cut-off; the other columns of the theory are those without")
      .add([](const Step &step) { return step.theory->yielding->plastic; },
           "theory_plastic_area [1]: in contact at the hardness, likewise")
      .when({"with `Theory/Enabled`", scene.theory.enabled})
      .add([](const Step &step) { return step.theory->leak_rate; },
           "theory_leak_rate [length³/time]: Q of the effective medium in the same box; "
           "0 where it seals; see [theory.md](theory.md)")
      .add([](const Step &step) { return step.theory->error; },
           "theory_error [1]: of mean gap and leak rate by the theory's quadrature, "
           "relative")
      .when()
      .add(&Step::status, "status: `ok`, or words joined by `+`, see below")
      .add(
        &Step::validity,
        "validity: `ok` if the model holds in all that the scene allows to check, or a "
        "word for each limit that is passed, joined by `+`, see "
        "[validity.md](validity.md)");
    return table;
  }
} // namespace strait
