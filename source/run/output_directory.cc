// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/build_info.h>
#include <strait/base/exceptions.h>
#include <strait/base/files.h>
#include <strait/run/field_output.h>
#include <strait/run/output_directory.h>

#include <nlohmann/json.hpp>

#include <vector>

namespace strait
{
  namespace
  {
    using RunRecord = nlohmann::ordered_json; // members stay in their order

    /** Units of the quantities that the plotting scripts ask for. */
    RunRecord
    units_of_plots(const UnitParameters &units)
    {
      return {{"length", units.length},
              {"pressure", units.pressure},
              {"time", units.time},
              {"leak_rate", in_units_of("length³/time", units)},
              {"current", in_units_of("length²/time", units)}};
    }

    /** Units of the columns of all tables; equal names have equal units. */
    RunRecord
    units_of_columns(const Scene &scene)
    {
      RunRecord result = RunRecord::object();
      for (const TableInfo &table : all_tables(scene))
        for (const ColumnInfo &column : table.columns)
          if (column.is_written)
            result[column.name] = in_units_of(column.unit, scene.units);
      return result;
    }

    /** The errors of a step's leak rate. */
    RunRecord
    error_record(const Step &step)
    {
      RunRecord relative = RunRecord::object();
      for (const ErrorItem &item : step.errors.items)
        relative[item.source] = item.relative;
      const ErrorItem &largest = step.errors.largest_known();
      RunRecord        record  = {{"step", step.number},
                                  {"relative_errors", relative},
                                  {"largest", largest.source},
                                  {"reduced_by", largest.parameter}};
      if (step.errors.extrapolated)
        {
          record["contact_grid_order"]     = *step.errors.grid_order;
          record["leak_rate_extrapolated"] = *step.errors.extrapolated;
        }
      return record;
    }

    /** All checks of a step, with their numbers. */
    RunRecord
    validity_record(const Step &step)
    {
      RunRecord checks = RunRecord::array();
      for (const ValidityCheck &check : step.checks)
        {
          RunRecord entry = {{"word", check.word},
                             {"number", check.number},
                             {check.is_lower_limit ? "least" : "most", check.limit},
                             {"holds", check.holds()}};
          if (!check.holds())
            entry["advice"] = check.advice;
          checks.push_back(entry);
        }
      return {{"step", step.number}, {"validity", step.validity()}, {"checks", checks}};
    }

    /** Write run.json: what the record of each run has, and the members of @p others. */
    void
    write_record(const Scene     &scene,
                 const int        n_ranks,
                 const Log       &log,
                 const RunRecord &others)
    {
      RunRecord record = {{"program", "strait"},
                          {"version", version},
                          {"ranks", n_ranks},
                          {"grid",
                           {{"nx", scene.contact.grid_points[0]},
                            {"ny", scene.contact.grid_points[1]},
                            {"lx", scene.surface.size[0]},
                            {"ly", scene.surface.size[1]}}}};
      record.update(others);
      record["warnings"]   = log.warnings();
      record["parameters"] = scene.resolved;
      if (scene.units.are_complete())
        {
          record["units"]        = units_of_plots(scene.units);
          record["column_units"] = units_of_columns(scene);
        }
      // Names of files may not be valid UTF-8.
      write_text(scene.output.directory + "/run.json",
                 record.dump(2, ' ', false, RunRecord::error_handler_t::replace));
    }
  } // namespace

  void
  write_record_of_ensemble(const Scene &scene, const int n_ranks, const Log &log)
  {
    write_record(scene, n_ranks, log, RunRecord::object());
  }

  OutputDirectory::OutputDirectory(const Scene &scene_,
                                   MPI_Comm     comm_,
                                   Log         &log_,
                                   const bool   resumed)
    : scene(scene_)
    , comm(comm_)
    , log(log_)
    , path(scene.output.directory)
    , table(leakage_table(scene))
    , constrictions(constriction_table(scene))
  {
    lock = begin_results(scene, comm, log, resumed);
    run_on_root(comm, [&]() {
      table.open(path);
      if (scene.programme.find_threshold)
        constrictions.open(path);
    });
  }

  void
  OutputDirectory::transfer(StateArchive &archive)
  {
    for (const char *name : {"leakage.csv",
                             "constrictions.csv",
                             "threshold.csv",
                             "blow_out.csv",
                             "jumps.csv"})
      {
        std::string text;
        if (!archive.is_reading())
          run_on_root(comm, [&]() { text = text_of(path + "/" + name); });
        archive.value(text);
        if (archive.is_reading() && !text.empty())
          run_on_root(comm, [&]() { write_text(path + "/" + name, text); });
      }
    archive.values(error_budget, validity, summary.status, summary.validity);
  }

  void
  OutputDirectory::write(const Step &step, const bool is_last)
  {
    if (!step.errors.items.empty())
      error_budget.push_back(error_record(step).dump());
    validity.push_back(validity_record(step).dump());
    add_words(summary.status, step.status());
    add_words(summary.validity, step.validity());
    run_on_root(comm, [&]() {
      table.append(step);
      if (step.state.contact && step.state.contact->adhesion &&
          !step.state.contact->adhesion->relaxation.empty())
        relaxation_table(scene, std::to_string(step.number))
          .write_rows(path, step.state.contact->adhesion->relaxation);
      if (step.flow && step.flow->constrictions)
        constrictions.append(step);
    });
    if (step.state.fluid && step.state.fluid->lifted_off)
      return; // there is no state to show
    const bool wanted = scene.output.fields == FieldOutput::all ||
                        (scene.output.fields == FieldOutput::last && is_last);
    if (wanted)
      {
        write_grid_fields(path, step, comm);
        write_flow_fields(path, step);
      }
    if (scene.output.pictures && !step.state.gap().empty())
      write_picture_data(path, step, scene.fluid);
  }

  RunSummary
  OutputDirectory::finish(const std::vector<Transition> &thresholds,
                          const Timers                  &timers,
                          const double                   bytes_per_point)
  {
    log.line(timers.summary());
    log.stage("tables and pictures");
    if (!thresholds.empty())
      run_on_root(comm, [&]() { fit_results(path, log); });
    RunRecord seconds = RunRecord::object();
    for (const Timers::Part &part : timers.table())
      seconds[part.path] = part.seconds;
    const auto of_steps = [](const std::vector<std::string> &records) {
      return RunRecord::parse("[" + join(records, ",") + "]");
    };
    const RunRecord of_run = {{"bytes_per_grid_point", bytes_per_point},
                              {"seconds", seconds},
                              {"error_budget", of_steps(error_budget)},
                              {"validity", of_steps(validity)}};
    run_on_root(comm, [&]() {
      write_record(scene, n_ranks_in(comm), log, of_run);
      draw_results(scene, log);
    });
    log.stage("");
    log.line("results are in " + path);
    if (!thresholds.empty())
      summary.threshold = thresholds.front();
    return summary;
  }
} // namespace strait
