// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/files.h>
#include <strait/flow/reynolds_solver.h>
#include <strait/flow/seal_mesh.h>
#include <strait/flow/solution_on_grid.h>
#include <strait/run/field_output.h>
#include <strait/run/hdf5_file.h>

#include <deal.II/base/hdf5.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace strait
{
  namespace
  {
    // Points along a side of a picture: with half of it contacts look ragged, double of
    // it makes files four times as large.
    constexpr int most_points = 1024;

    /** The stride of the grid points that are shown, from (0, 0) on in both
     *  directions. */
    int
    stride_on(const PeriodicGrid &grid)
    {
      return (std::max(grid.nx, grid.ny) + most_points - 1) / most_points;
    }

    /** Gather on rank 0 the values that are shown of @p local, one per local grid point.
     *  Collective. */
    std::vector<float>
    thin_out(const SlabLayout &layout, const double *local)
    {
      const int        nx     = layout.grid().nx;
      const int        stride = stride_on(layout.grid());
      std::vector<int> rows;
      if (layout.rank() == 0)
        for (int row = 0; row < layout.grid().ny; row += stride)
          rows.push_back(row);
      const auto         whole = fetch_rows(layout, local, nx, rows);
      std::vector<float> result;
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (int ix = 0; ix < nx; ix += stride)
          result.push_back(static_cast<float>(whole[k * nx + ix]));
      return result;
    }

    /** 0: closed, 1: open but not percolating, 2: percolating, 3: outside of the region
     *  of the fluid. */
    std::vector<double>
    openness(const Step &step)
    {
      std::vector<double> result(step.state.gap().size());
      for (std::size_t k = 0; k < result.size(); ++k)
        if (!step.flow)
          result[k] = step.state.gap()[k] > 0 ? 1 : 0;
        else
          {
            const NodeState state = step.flow->channel.clusters.states[k];
            result[k]             = state == NodeState::closed        ? 0
                                    : state == NodeState::percolating ? 2
                                    : state == NodeState::outside     ? 3
                                                                      : 1;
          }
      return result;
    }

    /** Collect the fields of a picture by name. Collective; complete on rank 0. */
    std::map<std::string, std::vector<float>>
    collect(const Step &step)
    {
      constexpr float   none   = std::numeric_limits<float>::quiet_NaN();
      const SlabLayout &layout = step.state.gap().layout();
      const auto        open   = thin_out(layout, openness(step).data());

      std::map<std::string, std::vector<float>> fields;
      fields["gap"]  = thin_out(layout, step.state.gap().data());
      fields["open"] = open;
      if (step.state.contact)
        fields["pressure"] = thin_out(layout, step.state.contact->pressure.data());
      if (!step.flow || !step.flow->solution)
        return fields;

      const FlowAtPoints flow =
        flow_at_points(*step.flow->solution,
                       rows_of_grid(layout.grid(), stride_on(layout.grid())));
      const double        leak           = std::abs(step.flow->leakage.rate);
      std::vector<float> &fluid_pressure = fields["fluid_pressure"];
      std::vector<float> &current        = fields["current"];
      for (std::size_t k = 0; k < open.size(); ++k)
        {
          const bool leaks = open[k] == 2.F;
          fluid_pressure.push_back(
            leaks ? static_cast<float>(step.flow->solution->pressure_at(flow.pressure[k]))
                  : none);
          current.push_back(leaks ? static_cast<float>(leak * flow.current[k]) : none);
        }
      return fields;
    }

    void
    write_dataset(dealii::HDF5::File       &file,
                  const std::string        &name,
                  const std::size_t         n_columns,
                  const std::vector<float> &values)
    {
      file.create_dataset<float>(name, {values.size() / n_columns, n_columns})
        .write(values);
    }

    /** Write the outline of a seal mesh, one row (x0, y0, x1, y1, kind) per edge, where
     *  kind is 0 for the inlet, 1 for the outlet and 2 for a wall. */
    void
    write_outline(dealii::HDF5::File &file, const Step &step)
    {
      if (!step.flow || step.flow->seal == nullptr)
        return;
      const PeriodicGrid &grid = step.state.gap().grid();
      std::vector<float>  values;
      for (const OutlineEdge &e :
           step.flow->seal->outline(std::min(grid.dx(), grid.dy())))
        for (const double value :
             {e.x0, e.y0, e.x1, e.y1, std::min(static_cast<double>(e.kind), 2.)})
          values.push_back(static_cast<float>(value));
      write_dataset(file, "outline", 5, values);
    }

    void
    write_attributes(dealii::HDF5::File    &file,
                     const Step            &step,
                     const FluidParameters &fluid)
    {
      file.set_attribute("lx", step.state.gap().grid().lx);
      file.set_attribute("ly", step.state.gap().grid().ly);
      file.set_attribute("inlet_pressure", fluid.inlet_pressure);
      file.set_attribute("outlet_pressure", fluid.outlet_pressure);
      file.set_attribute("validity", step.validity());
      file.set_attribute("direction",
                         std::string(!fluid.mesh_file.empty()              ? "mesh"
                                     : fluid.direction == FlowDirection::x ? "x"
                                                                           : "y"));
      if (step.state.contact)
        {
          file.set_attribute("nominal_pressure", step.state.contact->nominal_pressure);
          file.set_attribute("contact_area", step.state.contact->contact_area);
        }
      if (!step.flow)
        return;
      file.set_attribute("leak_rate", step.flow->leakage.rate);
      file.set_attribute("percolates", step.flow->channel.percolates() ? 1. : 0.);
      if (!step.flow->channel.paths.empty())
        {
          const auto [x, y] = step.place_of_bottleneck();
          file.set_attribute("worst_x", x);
          file.set_attribute("worst_y", y);
        }
    }

    /** Write the window in which the worst constriction lies, if there is one. */
    void
    write_window(dealii::HDF5::File &file, const Step &step)
    {
      if (!step.flow || step.flow->channel.paths.empty() ||
          step.flow->channel.paths.front().bottleneck.window < 0)
        return;
      const int                 w   = step.flow->channel.paths.front().bottleneck.window;
      const SlabField          &gap = step.state.gap();
      const SlabLayout         &layout = gap.layout();
      const ZoomWindow         &window = layout.windows()[w];
      const std::vector<double> open   = openness(step);
      const auto                write  = [&](const char *name, const auto &field) {
        write_dataset(file,
                      name,
                      window.n_columns(),
                      std::vector<float>(field.data() + layout.start_of_window(w),
                                         field.data() + layout.start_of_window(w + 1)));
      };
      write("window_gap", gap);
      write("window_open", open);
      const auto [x, y]   = layout.position(w, 0, 0);
      const auto [dx, dy] = layout.spacing(w);
      file.set_attribute("window_x", x);
      file.set_attribute("window_y", y);
      file.set_attribute("window_lx", window.n_columns() * dx);
      file.set_attribute("window_ly", window.n_rows() * dy);
    }
  } // namespace

  void
  write_picture_data(const std::string     &directory,
                     const Step            &step,
                     const FluidParameters &fluid)
  {
    const auto          fields    = collect(step);
    const PeriodicGrid &grid      = step.state.gap().grid();
    const int           n_columns = (grid.nx - 1) / stride_on(grid) + 1;
    MPI_Comm            comm      = step.state.gap().layout().communicator();
    const std::string   path =
      directory + "/picture-" + std::to_string(step.number) + ".h5";
    require_space(path, fields.size() * fields.at("gap").size() * sizeof(float), comm);
    run_on_root(comm, [&]() {
      write_hdf5_file(path, MPI_COMM_SELF, [&](dealii::HDF5::File &file) {
        for (const auto &[name, values] : fields)
          write_dataset(file, name, n_columns, values);
        write_outline(file, step);
        write_window(file, step);
        write_attributes(file, step, fluid);
      });
    });
  }
} // namespace strait
