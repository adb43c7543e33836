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
          "leak_rate [length³/time]: volume Q per time from inlet to outlet, negative if "
          "the outlet has the higher pressure; 0 if nothing percolates. It is the "
          "geometric mean of its bounds, or the upper one if they differ by more than a "
          "factor of two. With `Fluid/Rarefaction` the bounds used for this are "
          "`mesh_error` apart and hold if the gas slips as it does in the solution; Q "
          "stays within `leak_rate_lower` and `leak_rate_upper`")
        .add([](const Step &step) { return step.flow->leakage.lower; },
             "leak_rate_lower [length³/time]: lower bound of the magnitude of the leak "
             "rate, the best of all meshes (with `Fluid/Rarefaction` of the last one); "
             "with `Wall feedback` bounds are widened by how the last mesh changed the "
             "leak rate through the gap")
        .add([](const Step &step) { return step.flow->leakage.upper; },
             "leak_rate_upper [length³/time]: upper bound of this magnitude, likewise");
      table
        .when({"with `Contact/Zoom` or `Output/Error budget`",
               scene.fluid.enabled &&
                 (scene.contact.zoom.enabled || scene.output.error_budget)})
        .add([](const Step &step) { return step.errors.sum(); },
             "leak_rate_error [1]: estimated relative error of the leak rate, summed "
             "over mesh, contact grid, gap interpolation and tolerances, see "
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
        .when({"with `Seal/Two in a row`, or in patches of a wider seal",
               scene.has_two_boxes()})
        .add(
          [](const Step &step) { return step.two_boxes->rate; },
          "two_boxes_leak_rate [length³/time]: leak rate through two copies of the box, "
          "one behind the other, under the same pressure drop")
        .add([](const Step &step) { return step.two_boxes->relative_width(); },
             "two_boxes_error [1]: relative width of the bracket of this leak rate");
      table
        .when({"with `Fluid/Rarefaction`",
               scene.fluid.enabled && scene.fluid.rarefaction != Rarefaction::none})
        .add(
          [=](const Step &step) {
            return step.flow->leakage.rate * fluid.mean_pressure();
          },
          "throughput [pressure length³/time]: throughput of the gas: `leak_rate` times "
          "the mean pressure of the reservoirs")
        .add([](const Step &step) { return step.flow->leakage.knudsen; },
             "knudsen [1]: Knudsen number, mean free path over gap, at the worst "
             "constriction. The pressure there follows from the part of the viscous "
             "resistance before it on the path of least resistance: an estimate, up to "
             "half off against vacuum; `nan` if nothing percolates")
        .add(
          [](const Step &step) { return step.flow->leakage.bound; },
          "bound: kind of the bounds `leak_rate_lower` and `leak_rate_upper` of the "
          "nonlinear problem, the error of the mesh included. `any-order`: they hold "
          "whichever gap the gas meets at which pressure; `two-gases`: the lower one is "
          "that of a viscous and a molecular gas side by side; `none`: nothing leaks; "
          "see [gas](gas_and_metals.md#gas)")
        .add(
          [](const Step &step) { return step.flow->leakage.mesh_width; },
          "mesh_error [1]: relative width of the bracket that is due to the mesh alone, "
          "for a gas that slips as it does in the solution; `Target accuracy` refers to "
          "it; `nan` if nothing percolates");
      table.when(with_flow)
        .add(
          [=](const Step &step) { return effective_gap(step.flow->leakage, fluid); },
          "effective_gap [length]: gap of smooth plates that leak as much, (12 η "
          "K_eff)^(1/3) with K_eff = Q L/(W Δp); in a mesh ([meshes](meshes.md)) K_eff = "
          "Q/(S Δp), where Q = S K Δp at a uniform K. With `Fluid/Rarefaction` it is the "
          "gap of smooth plates through which as much of the rarefied gas leaks, which "
          "is smaller; `nan` without a pressure difference")
        .add([](const Step &step) { return step.place_of_bottleneck()[0]; },
             "worst_constriction_x [length]: x of the narrowest grid point on the path "
             "of least resistance ∫ds/g³; at the outlet Lx, as that of the copy of x = "
             "0; `nan` if nothing percolates or there is no pressure difference")
        .add([](const Step &step) { return step.place_of_bottleneck()[1]; },
             "worst_constriction_y [length]: y of this point, likewise")
        .add(
          [](const Step &step) {
            const std::vector<FlowPath> &paths = step.flow->channel.paths;
            return paths.empty() ? std::nan("") : paths.front().bottleneck_gap;
          },
          "worst_constriction_gap [length]: gap that the fluid sees at this point");
      table
        .when({"with `Contact/Zoom`", scene.fluid.enabled && scene.contact.zoom.enabled})
        .add(
          [](const Step &step) {
            int levels = 0;
            for (const ZoomWindow &window : step.state.gap().layout().windows())
              levels = std::max(levels, window.level);
            return levels;
          },
          "zoom_levels [1]: how often the finest windows divide the spacing of the "
          "contact grid by three")
        .add(
          [](const Step &step) {
            return step.flow->channel.paths.empty() ? std::nan("")
                                                    : step.flow->channel.throat.points;
          },
          "points_along_throat [1]: number of the finest points along the flow from the "
          "worst constriction to where the gap is twice as large");
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
      "One row for each step, written as soon as it is done. Columns of an effect that "
      "is off (`Contact/Enabled = false`, `Fluid/Enabled = false`) are absent.");
    table
      .add(&Step::number,
           "step [1]: number of the row, from 1: a load with one slip length")
      .when(with_contact)
      .add(&Step::branch,
           "branch: load path, `loading` or `unloading`: that of the scene or, with "
           "adhesion, yielding or wall feedback and in a cycle, the direction of the "
           "last change of the load")
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
           "mean_gap [length]: mean gap over the box, in which points in contact count "
           "as zero")
      .when(with_contact)
      .add(
        [](const Step &step) { return step.state.contact->contact_area; },
        "contact_area [1]: fraction of the area in contact, where the hard wall pushes "
        "back")
      .add([](const Step &step) { return step.state.contact->contact_area_corrected; },
           "contact_area_corrected [1]: `contact_area` A corrected to the continuum: A − "
           "0.118 S a, with the lattice perimeter S of the contact over the nominal "
           "area, less where it yields up to its edge, and the spacing a = √(dx dy) of "
           "the points")
      .when({"if some slip length is not zero",
             scene.fluid.has_slip() && (scene.fluid.enabled || theory_alone)})
      .add([](const Step &step) { return step.state.control.slip_length; },
           "slip_length [length]: slip length d0")
      .when(with_flow)
      .add([](const Step &step) { return step.flow->channel.percolates(); },
           "percolates [1]: 1 if an open channel connects inlet and outlet, 0 if not")
      .when(
        {"with `Find threshold`", scene.fluid.enabled && scene.programme.find_threshold})
      .add(
        [](const Step &step) { return step.reduced_load.value_or(std::nan("")); },
        "reduced_load [1]: 1 − L/L_c with the middle of the bracket of L_c; if states "
        "depend on the load path, `nan` once it has turned back, until it goes further "
        "than before");
    add_leak_rates(table, scene, with_flow);
    table.when(with_contact)
      .add(
        [](const Step &step) { return step.state.contact->residual; },
        "contact_residual [1]: residual of the contact at exact force balance: max( max "
        "over contact of \\|g\\|, max elsewhere of −g ) / rms height, with g in place of "
        "\\|g\\| where the contact yields; with adhesion the largest unbalanced "
        "traction, over E* × rms slope / 2")
      .add([](const Step &step) { return step.state.costs.iterations; },
           "contact_iterations [1]: iterations of the contact solver on the finest grid; "
           "with adhesion, of all loads since the last step")
      .add([](const Step &step) { return step.state.costs.fft_pairs; },
           "fft_pairs [1]: pairs of Fourier transforms there and back, likewise; with "
           "adhesion also those of the check of the minimum")
      .when(with_flow)
      .add([](const Step &step) { return step.flow->leakage.cells; },
           "cells [1]: active cells of the last flow mesh")
      .add([](const Step &step) { return step.flow->leakage.unknowns; },
           "unknowns [1]: unknowns of pressure and stream function together on the last "
           "mesh")
      .add([](const Step &step) { return step.flow->leakage.refinements; },
           "refinements [1]: number of meshes after the first")
      .add([](const Step &step) { return step.flow->leakage.iterations; },
           "flow_iterations [1]: iterations of the linear solver for pressure and stream "
           "function, on all meshes")
      .when({"with adhesion", scene.contact.enabled && scene.contact.adhesion.enabled})
      .add([](const Step &step) { return step.state.contact->adhesion->adhesive_energy; },
           "adhesive_energy [pressure length]: energy of adhesion per area: mean over "
           "the box of the law γ(g) = −γ0 f(g/z0)")
      .add(&Step::dissipated_energy,
           "dissipated_energy [pressure length]: energy per area that the jumps since "
           "the last step dissipated, see [jumps.csv](#jumpscsv)")
      .when({"with `Contact/Yielding`", scene.contact.enabled && scene.contact.yields})
      .add([](const Step &step) { return step.state.contact->plasticity->area; },
           "plastic_area [1]: fraction of grid points where the pressure equals the "
           "hardness to a thousandth")
      .add(
        [](const Step &step) { return step.state.contact->plasticity->mean_indentation; },
        "mean_indentation [length]: mean over the box of the indentation left by this "
        "load and all before it; rows at `Reduced loads` begin with the surface as it "
        "was, or with `Path = unloading` as the first of `Pressures` left it")
      .when(with_contact)
      .add([](const Step &step) { return step.state.costs.contact_seconds; },
           "contact_seconds [s]: wall-clock time of the contact")
      .when(with_flow)
      .add(&Step::flow_seconds, "flow_seconds [s]: wall-clock time of the flow")
      .when({"with `Wall feedback`", scene.fluid.feedback.enabled})
      .add([](const Step &step) { return step.state.fluid->load; },
           "fluid_load [pressure]: part of `pressure` that the fluid carries: its mean "
           "pressure over the nominal area")
      .add(
        [](const Step &step) { return step.state.costs.rounds; },
        "feedback_iterations [1]: rounds of contact and flow, in all parts of a halved "
        "step")
      .when({"with `Trapped fluid` other than `drained`",
             scene.fluid.feedback.keeps_trapped_fluid()})
      .add(of_trapped(&TrappedFluid::area),
           "trapped_area [1]: fraction of the nominal area in open regions that no "
           "reservoir reaches")
      .add(of_trapped(&TrappedFluid::pressure),
           "trapped_pressure [pressure]: mean fluid pressure over the area of these "
           "regions")
      .when({"with `Theory/Enabled`, and not where the gap is given",
             scene.theory.enabled && (scene.contact.enabled || theory_alone)})
      .add(
        [](const Step &step) { return step.theory->contact_area; },
        "theory_contact_area [1]: contact area of Persson's theory; `nan` under tension, "
        "as all of the theory but a leak rate from simulated gaps")
      .add([](const Step &step) { return step.theory->mean_gap; },
           "theory_mean_gap [length]: mean gap of Persson's theory, likewise")
      .when({"with `Theory/Enabled` and `Contact/Yielding`",
             scene.theory.enabled && scene.contact.yields &&
               (scene.contact.enabled || theory_alone)})
      .add([](const Step &step) { return step.theory->yielding->elastic; },
           "theory_elastic_area [1]: fraction in contact below the hardness, by "
           "Persson's theory with the same cut-off; the other columns of the theory are "
           "without cut-off")
      .add([](const Step &step) { return step.theory->yielding->plastic; },
           "theory_plastic_area [1]: fraction in contact at the hardness, likewise")
      .when({"with `Theory/Enabled`", scene.theory.enabled})
      .add([](const Step &step) { return step.theory->leak_rate; },
           "theory_leak_rate [length³/time]: leak rate Q of the effective medium in the "
           "same box; 0 where it seals; see [theory.md](theory.md)")
      .add([](const Step &step) { return step.theory->error; },
           "theory_error [1]: relative error of mean gap and leak rate by the theory's "
           "quadrature, the larger one")
      .when()
      .add(&Step::status, "status: `ok`, or words joined by `+`, see below")
      .add(
        &Step::validity,
        "validity: `ok` if the model holds as far as the scene allows a check, or a word "
        "for each limit that is exceeded, joined by `+`, see [validity.md](validity.md)");
    return table;
  }
} // namespace strait
