// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/driver/result_table.h>
#include <strait/driver/result_units.h>
#include <strait/driver/theory_run.h>

#include <cmath>
#include <limits>
#include <utility>

namespace strait
{
  namespace
  {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

    /** (12 η K_eff)^(1/3) with K_eff = Q L_along/(L_across Δp); in a mesh the uniform gap
     *  that leaks as much. */
    double
    effective_gap(const FluidParameters &fluid,
                  const PeriodicGrid    &grid,
                  const StepFlow        &flow)
    {
      const double aspect = flow.shape_factor > 0                 ? 1. / flow.shape_factor
                            : fluid.direction == FlowDirection::x ? grid.lx / grid.ly
                                                                  : grid.ly / grid.lx;
      return std::cbrt(12. * fluid.viscosity * flow.result.leak_rate * aspect /
                       (fluid.inlet_pressure - fluid.outlet_pressure));
    }
  } // namespace

  ResultTable::ResultTable(const Scene &scene)
  {
    add("step", [](const Step &step) { return step.number; });
    if (scene.contact.enabled)
      {
        columns.push_back({"branch", [](const Step &step) { return step.branch; }});
        add("pressure",
            [](const Step &step) { return step.state.contact->nominal_pressure; });
        add("mean_gap", [](const Step &step) { return step.state.mean_gap; });
        add("contact_area",
            [](const Step &step) { return step.state.contact->contact_area; });
        add("contact_area_corrected",
            [](const Step &step) { return step.state.contact->contact_area_corrected; });
      }
    else if (is_theory_only(scene))
      {
        add("pressure", [](const Step &step) { return step.theory->pressure; });
        if (scene.fluid.has_slip())
          add("slip_length",
              [](const Step &step) { return step.state.control.slip_length; });
      }
    else
      add("mean_gap", [](const Step &step) { return step.state.mean_gap; });
    if (scene.fluid.enabled)
      add_flow_columns(scene);
    if (scene.contact.enabled)
      add_contact_columns();
    if (scene.fluid.enabled)
      {
        add("cells", [](const Step &step) { return step.flow->result.cells; });
        add("unknowns", [](const Step &step) { return step.flow->result.unknowns; });
        add("refinements",
            [](const Step &step) { return step.flow->result.refinements; });
        add("flow_iterations",
            [](const Step &step) { return step.flow->result.iterations; });
      }
    if (scene.contact.enabled && scene.contact.adhesion.enabled)
      {
        add("adhesive_energy", [](const Step &step) {
          return step.state.contact->adhesion->adhesive_energy;
        });
        add("dissipated_energy", [](const Step &step) { return step.dissipated_energy; });
      }
    if (scene.contact.enabled)
      add("contact_seconds", [](const Step &step) { return step.state.contact_seconds; });
    if (scene.fluid.enabled)
      add("flow_seconds", [](const Step &step) { return step.flow_seconds; });
    if (scene.fluid.feedback.enabled)
      {
        add("fluid_load", [](const Step &step) { return step.state.fluid->load; });
        add("feedback_iterations",
            [](const Step &step) { return step.state.fluid->rounds; });
      }
    if (scene.theory.enabled)
      add_theory_columns(scene);
    columns.push_back({"status", [](const Step &step) { return step.status(); }});
  }

  void
  ResultTable::add_flow_columns(const Scene &scene)
  {
    const FluidParameters fluid = scene.fluid;
    if (fluid.has_slip())
      add("slip_length", [](const Step &step) { return step.state.control.slip_length; });
    add("percolates", [](const Step &step) { return step.flow->clusters.percolates; });
    if (scene.programme.find_threshold)
      add("reduced_load",
          [](const Step &step) { return step.reduced_load.value_or(not_a_number); });
    add("leak_rate", [](const Step &step) { return step.flow->result.leak_rate; });
    add("leak_rate_lower", [](const Step &step) { return step.flow->result.lower; });
    add("leak_rate_upper", [](const Step &step) { return step.flow->result.upper; });
    for (const std::string &name : scene.output.leak_rate_units)
      {
        const LeakRateUnit  *unit  = find_leak_rate_unit(name);
        const UnitParameters units = scene.units;
        add(unit->column, [=](const Step &step) {
          return in_trade_unit(step.flow->result.leak_rate, *unit, units, fluid);
        });
      }
    add("effective_gap", [fluid](const Step &step) {
      return effective_gap(fluid, step.state.gap().grid(), *step.flow);
    });
    const auto add_constriction = [this](const std::string &name, auto value) {
      add(name, [value](const Step &step) {
        return step.flow->paths.empty()
                 ? not_a_number
                 : value(step.flow->paths.front(), step.state.gap().grid());
      });
    };
    add_constriction("worst_constriction_x",
                     [](const FlowPath &path, const PeriodicGrid &grid) {
                       return path.bottleneck.ix * grid.dx();
                     });
    add_constriction("worst_constriction_y",
                     [](const FlowPath &path, const PeriodicGrid &grid) {
                       return path.bottleneck.iy * grid.dy();
                     });
    add_constriction("worst_constriction_gap",
                     [](const FlowPath &path, const PeriodicGrid &) {
                       return path.bottleneck_gap;
                     });
  }

  void
  ResultTable::add_theory_columns(const Scene &scene)
  {
    if (scene.contact.enabled || is_theory_only(scene))
      {
        add("theory_contact_area",
            [](const Step &step) { return step.theory->contact_area; });
        add("theory_mean_gap", [](const Step &step) { return step.theory->mean_gap; });
      }
    add("theory_leak_rate", [](const Step &step) { return step.theory->leak_rate; });
    add("theory_error", [](const Step &step) { return step.theory->error; });
  }

  void
  ResultTable::add_contact_columns()
  {
    add("contact_residual",
        [](const Step &step) { return step.state.contact->residual; });
    add("contact_iterations",
        [](const Step &step) { return step.state.contact->iterations; });
    add("fft_pairs", [](const Step &step) { return step.state.contact->fft_pairs; });
  }

  void
  ResultTable::add(const std::string &name, std::function<double(const Step &)> value)
  {
    columns.push_back({name, [value = std::move(value)](const Step &step) {
                         return full_precision(value(step));
                       }});
  }

  std::vector<std::string>
  ResultTable::column_names() const
  {
    std::vector<std::string> names;
    for (const Column &column : columns)
      names.push_back(column.name);
    return names;
  }

  void
  ResultTable::open(const std::string &path)
  {
    file.open(path, column_names());
  }

  void
  ResultTable::append(const Step &step)
  {
    std::vector<std::string> values;
    for (const Column &column : columns)
      values.push_back(column.value(step));
    file.append(values);
  }
} // namespace strait
