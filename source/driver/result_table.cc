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
  } // namespace

  ResultTable::ResultTable(const Scene &scene)
  {
    add("step", [](const Step &step) { return step.number; });
    if (scene.contact.enabled)
      {
        columns.push_back({"branch", [](const Step &step) { return step.branch; }});
        add("pressure", [](const Step &step) { return step.contact->nominal_pressure; });
        add("mean_gap", [](const Step &step) { return step.mean_gap; });
        add("contact_area", [](const Step &step) { return step.contact->contact_area; });
        add("contact_area_corrected",
            [](const Step &step) { return step.contact->contact_area_corrected; });
      }
    else if (is_theory_only(scene))
      {
        add("pressure", [](const Step &step) { return step.theory->pressure; });
        if (scene.fluid.has_slip())
          add("slip_length", [](const Step &step) { return step.slip_length; });
      }
    else
      add("mean_gap", [](const Step &step) { return step.mean_gap; });
    if (scene.fluid.enabled)
      add_flow_columns(scene);
    if (scene.contact.enabled)
      add_contact_columns();
    if (scene.fluid.enabled)
      {
        add("cells", [](const Step &step) { return step.flow->leakage.cells; });
        add("unknowns", [](const Step &step) { return step.flow->leakage.unknowns; });
        add("refinements",
            [](const Step &step) { return step.flow->leakage.refinements; });
        add("flow_iterations",
            [](const Step &step) { return step.flow->leakage.iterations; });
      }
    if (scene.contact.enabled && scene.contact.adhesion.enabled)
      {
        add("adhesive_energy",
            [](const Step &step) { return step.contact->adhesion->adhesive_energy; });
        add("dissipated_energy", [](const Step &step) { return step.dissipated_energy; });
      }
    if (scene.contact.enabled)
      add("contact_seconds", [](const Step &step) { return step.contact_seconds; });
    if (scene.fluid.enabled)
      add("flow_seconds", [](const Step &step) { return step.flow_seconds; });
    if (scene.fluid.feedback.enabled)
      {
        add("fluid_load", [](const Step &step) { return step.feedback->fluid_load; });
        add("feedback_iterations",
            [](const Step &step) { return step.feedback->iterations; });
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
      add("slip_length", [](const Step &step) { return step.slip_length; });
    add("percolates", [](const Step &step) { return step.flow->channel.percolates(); });
    if (scene.programme.find_threshold)
      add("reduced_load",
          [](const Step &step) { return step.reduced_load.value_or(not_a_number); });
    add("leak_rate", [](const Step &step) { return step.flow->leakage.rate; });
    add("leak_rate_lower", [](const Step &step) { return step.flow->leakage.lower; });
    add("leak_rate_upper", [](const Step &step) { return step.flow->leakage.upper; });
    for (const std::string &name : scene.output.leak_rate_units)
      {
        const LeakRateUnit  *unit  = find_leak_rate_unit(name);
        const UnitParameters units = scene.units;
        add(unit->column, [=](const Step &step) {
          return in_trade_unit(step.flow->leakage.rate, *unit, units, fluid);
        });
      }
    add("effective_gap",
        [fluid](const Step &step) { return effective_gap(step.flow->leakage, fluid); });
    const auto add_constriction = [this](const std::string &name, auto value) {
      add(name, [value](const Step &step) {
        return step.flow->channel.paths.empty()
                 ? not_a_number
                 : value(step.flow->channel.paths.front(), step.gap.grid());
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
    add("contact_residual", [](const Step &step) { return step.contact->residual; });
    add("contact_iterations", [](const Step &step) { return step.contact->iterations; });
    add("fft_pairs", [](const Step &step) { return step.contact->fft_pairs; });
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
