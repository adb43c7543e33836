// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/files.h>
#include <strait/run/field_output.h>
#include <strait/run/hdf5_file.h>

#include <deal.II/base/hdf5.h>

#include <array>
#include <map>
#include <sstream>
#include <type_traits>
#include <vector>

namespace strait
{
  namespace
  {
    /** A regular grid of points on a rectangle in the plane z = 0, with data sets. */
    struct GridPiece
    {
      std::string           path; // of its group in the HDF5 file, ending with a slash
      int                   nx, ny;
      std::array<double, 2> origin, spacing;
    };

    /** A data set of shape (ny, nx) in an HDF5 file. */
    struct GridDataset
    {
      std::string name;
      bool        is_whole = false; // 4-byte integers rather than doubles
    };

    /** Return the text of an XDMF file (version 2, as ParaView reads it) that lies beside
     *  the HDF5 file @p file and has all @p datasets on each of @p pieces. A piece is a
     *  slice of a three-dimensional grid, because ParaView puts a two-dimensional one
     *  into another plane than z = 0. */
    std::string
    grid_description(const std::string              &file,
                     const std::vector<GridPiece>   &pieces,
                     const std::vector<GridDataset> &datasets)
    {
      const char *const three_numbers =
        "<DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">";
      std::ostringstream out;
      out.precision(17);
      out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n";
      if (pieces.size() > 1)
        out << "<Grid Name=\"windows\" GridType=\"Collection\" "
               "CollectionType=\"Spatial\">\n";
      for (const GridPiece &piece : pieces)
        {
          const std::string shape =
            "\"1 " + std::to_string(piece.ny) + " " + std::to_string(piece.nx) + "\"";
          out << "<Grid Name=\"grid\" GridType=\"Uniform\">\n"
              << "  <Topology TopologyType=\"3DCoRectMesh\" Dimensions=" << shape
              << "/>\n"
              << "  <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
              // From the slowest index to the fastest; the spacing in z does not matter.
              << "    " << three_numbers << "0 " << piece.origin[1] << ' '
              << piece.origin[0] << "</DataItem>\n"
              << "    " << three_numbers << piece.spacing[0] << ' ' << piece.spacing[1]
              << ' ' << piece.spacing[0] << "</DataItem>\n  </Geometry>\n";
          for (const GridDataset &dataset : datasets)
            out
              << "  <Attribute Name=\"" << dataset.name
              << "\" AttributeType=\"Scalar\" Center=\"Node\">\n    <DataItem Dimensions="
              << shape << " NumberType="
              << (dataset.is_whole ? "\"Int\" Precision=\"4\""
                                   : "\"Float\" Precision=\"8\"")
              << " Format=\"HDF\">" << file << ":/" << piece.path << dataset.name
              << "</DataItem>\n  </Attribute>\n";
          out << "</Grid>\n";
        }
      if (pieces.size() > 1)
        out << "</Grid>\n";
      out << "</Domain>\n</Xdmf>\n";
      return out.str();
    }

    /** Write the fields of a step in window @p w, or on the grid if @p w is −1, as data
     *  sets of shape (@p n_rows, @p n_columns) to @p group, and return these.
     *  Collective. */
    std::vector<GridDataset>
    write_fields(dealii::HDF5::Group    &group,
                 const Step             &step,
                 const std::vector<int> &labels,
                 const int               w,
                 const hsize_t           n_columns,
                 const hsize_t           n_rows)
    {
      const SlabLayout &layout = step.state.gap().layout();
      std::size_t       begin  = 0;
      hsize_t           first = layout.first_row(), n_here = layout.n_rows();
      if (w >= 0) // all ranks hold the values, rank 0 writes them
        {
          begin  = layout.start_of_window(w);
          first  = 0;
          n_here = layout.rank() == 0 ? n_rows : 0;
        }
      std::vector<GridDataset> datasets;
      const auto               write = [&](const char *name, const auto *values) {
        using Number = std::decay_t<decltype(*values)>;
        dealii::HDF5::DataSet dataset =
          group.create_dataset<Number>(name, {n_rows, n_columns});
        if (n_here == 0)
          dataset.write_none<Number>();
        else
          dataset.write_hyperslab(
            std::vector<Number>(values + begin, values + begin + n_here * n_columns),
            {first, 0},
            {n_here, n_columns});
        datasets.push_back({name, std::is_same<Number, int>::value});
      };
      write("gap", step.state.gap().data());
      if (step.state.contact)
        write("pressure", step.state.contact->pressure.data());
      if (step.state.contact && step.state.contact->plasticity)
        write("indentation", step.state.contact->plasticity->indentation.data());
      if (step.flow)
        write("labels", labels.data());
      return datasets;
    }

    /** Write the fields of a step on the grid and, in groups, in its windows, and an XDMF
     *  file of each level for ParaView. Collective. */
    void
    write_levels(const std::string &directory, dealii::HDF5::File &file, const Step &step)
    {
      const SlabLayout              &layout  = step.state.gap().layout();
      const PeriodicGrid            &grid    = layout.grid();
      const std::vector<ZoomWindow> &windows = layout.windows();
      std::vector<int>               labels;
      if (step.flow)
        for (const NodeState state : step.flow->channel.clusters.states)
          labels.push_back(static_cast<int>(state));
      std::vector<GridDataset>              datasets; // the same in all windows
      std::map<int, std::vector<GridPiece>> pieces;   // by level
      for (int w = -1; w < static_cast<int>(windows.size()); ++w)
        {
          const int         level = w < 0 ? 0 : windows[w].level;
          const int         nx    = w < 0 ? grid.nx : windows[w].n_columns();
          const int         ny    = w < 0 ? grid.ny : windows[w].n_rows();
          const std::string name  = "window-" + std::to_string(w + 1);
          auto group = w < 0 ? file.open_group("/") : file.create_group(name);
          datasets   = write_fields(group, step, labels, w, nx, ny);
          if (w >= 0)
            group.set_attribute("level", level);
          pieces[level].push_back({w < 0 ? "" : name + "/",
                                   nx,
                                   ny,
                                   layout.position(w, 0, 0),
                                   layout.spacing(w)});
        }
      if (step.state.contact)
        file.set_attribute("nominal_pressure", step.state.contact->nominal_pressure);
      if (step.flow)
        file.set_attribute("leak_rate", step.flow->leakage.rate);
      file.set_attribute("lx", grid.lx);
      file.set_attribute("ly", grid.ly);
      file.set_attribute("dx", grid.dx());
      file.set_attribute("dy", grid.dy());
      file.set_attribute("units", std::string("those of the scene"));
      run_on_root(layout.communicator(), [&]() {
        const std::string base  = "fields-" + std::to_string(step.number);
        const std::string begin = directory + "/" + base;
        for (const auto &[level, of_level] : pieces)
          write_text(begin + (level == 0 ? ".xmf" : format("-level-%d.xmf", level)),
                     grid_description(base + ".h5", of_level, datasets));
      });
    }

    /** Write the group gap_distribution. Collective. */
    void
    write_gap_distributions(dealii::HDF5::File &file,
                            const TheoryResult &theory,
                            MPI_Comm            comm)
    {
      auto       group = file.create_group("gap_distribution");
      const auto write = [&](const std::string &name, const std::vector<double> &values) {
        auto dataset = group.create_dataset<double>(name, {values.size()});
        if (rank_in(comm) == 0) // all ranks hold the values
          dataset.write_hyperslab(values, {0}, {values.size()});
        else
          dataset.write_none<double>();
      };
      const auto &persson = theory.persson_gaps, &simulated = theory.simulated_gaps;
      write("edges", (persson ? persson : simulated)->edges);
      for (const auto &[name, gaps] :
           {std::pair<std::string, decltype(persson)>{"persson", persson},
            {"simulated", simulated}})
        if (gaps)
          {
            write(name, gaps->fractions);
            group.set_attribute(name + "_contact_area", gaps->contact_area);
          }
    }
  } // namespace

  void
  write_grid_fields(const std::string &directory, const Step &step, MPI_Comm comm)
  {
    const std::string name = directory + "/fields-" + std::to_string(step.number) + ".h5";
    const bool        is_simulated = !step.state.gap().empty();
    if (is_simulated)
      require_space(name,
                    static_cast<std::uintmax_t>(step.state.gap().grid().n_points()) *
                      (3 * sizeof(double) + sizeof(int)),
                    comm);
    write_hdf5_file(name, comm, [&](dealii::HDF5::File &file) {
      if (is_simulated)
        write_levels(directory, file, step);
      else
        file.set_attribute("nominal_pressure", step.theory->pressure);
      if (step.theory)
        write_gap_distributions(file, *step.theory, comm);
    });
  }
} // namespace strait
