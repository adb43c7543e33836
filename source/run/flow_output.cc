// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/files.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/run/field_output.h>

#include <deal.II/numerics/data_out.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace strait
{
  namespace
  {
    /** Write flow.pvd, the series of the steps up to @p last that have a flow. */
    void
    list_flow_fields(const std::string &directory, const int last)
    {
      std::vector<std::pair<double, std::string>> steps;
      for (int step = 1; step <= last; ++step)
        {
          const std::string name = "flow-" + std::to_string(step) + ".pvtu";
          if (std::filesystem::exists(std::filesystem::path(directory) / name))
            steps.emplace_back(step, name);
        }
      std::ostringstream series;
      dealii::DataOutBase::write_pvd_record(series, steps);
      write_text(directory + "/flow.pvd", series.str());
    }
  } // namespace

  void
  write_flow_fields(const std::string &directory, const Step &step)
  {
    if (!step.flow || !step.flow->solution)
      return;
    const PotentialProblem &problem = step.flow->solution->pressure();
    const auto             &dofs    = problem.dof_handler();
    const auto             &tria    = dofs.get_triangulation();
    MPI_Comm                comm    = step.state.gap().layout().communicator();

    PotentialProblem::Vector owned_pressure(dofs.locally_owned_dofs(), comm);
    owned_pressure = problem.solution();
    for (const auto k : dofs.locally_owned_dofs())
      owned_pressure(k) = step.flow->solution->pressure_at(owned_pressure(k));
    owned_pressure.compress(dealii::VectorOperation::insert);
    PotentialProblem::Vector pressure(problem.solution());
    pressure = owned_pressure;

    dealii::Vector<float> conductivity(tria.n_active_cells());
    dealii::Vector<float> level(tria.n_active_cells());
    dealii::Vector<float> leaks(tria.n_active_cells());
    std::size_t           owned = 0;
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto k    = cell->active_cell_index();
          leaks(k)        = problem.is_active(owned) ? 1.F : 0.F;
          conductivity(k) = static_cast<float>(problem.mean_coefficient(owned++));
          level(k)        = static_cast<float>(cell->level());
        }

    dealii::DataOut<2> out;
    out.attach_dof_handler(dofs);
    out.add_data_vector(pressure, "fluid_pressure");
    // The conductivity of a rarefied gas depends on its pressure; the coefficient of the
    // linear problem is not that.
    if (std::isnan(step.flow->leakage.knudsen))
      out.add_data_vector(conductivity, "mean_conductivity");
    out.add_data_vector(level, "level");
    out.add_data_vector(leaks, "leaks");
    out.build_patches(step.flow->solution->mesh().mapping(), dofs.get_fe().degree);
    const std::string name = directory + "/flow-" + std::to_string(step.number);
    // About the compressed size. Without this check deal.II would print its own errors.
    const std::uintmax_t bytes_per_cell =
      30 * dofs.get_fe().degree * dofs.get_fe().degree;
    require_space(name + ".vtu", bytes_per_cell * tria.n_global_active_cells(), comm);
    if (n_ranks_in(comm) > 1)
      out.write_vtu_in_parallel(name + ".vtu", comm);
    else // without MPI-IO, see write_hdf5_file()
      {
        std::ofstream file(name + ".vtu");
        out.write_vtu(file);
      }
    run_on_root(comm, [&]() {
      require_end(name + ".vtu", "</VTKFile>\n");
      std::ostringstream record;
      out.write_pvtu_record(record, {"flow-" + std::to_string(step.number) + ".vtu"});
      write_text(name + ".pvtu", record.str());
      list_flow_fields(directory, step.number);
    });
  }
} // namespace strait
