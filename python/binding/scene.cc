// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/log.h>
#include <strait/base/scene_text.h>
#include <strait/base/table.h>
#include <strait/base/text.h>
#include <strait/run/run_state.h>
#include <strait/run/simulation.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/read_scene.h>
#include <strait/surface/statistics.h>

#include <pybind11/stl.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <ostream>
#include <streambuf>

#include "arrays.h"
#include "bindings.h"
#include "environment.h"

namespace strait::python
{
  namespace
  {
    /**
     * Passes lines on to a text stream of Python, with ? for characters that it does not
     * know. As neither streams nor destructors may throw, an error of that stream, such
     * as a full disk, is kept for rethrow(), and nothing more is passed on.
     */
    class PythonOutput : public std::streambuf
    {
    public:
      explicit PythonOutput(py::object stream_)
        : stream(std::move(stream_))
      {
      }

      void
      rethrow() const
      {
        if (error)
          std::rethrow_exception(error);
      }

    protected:
      int_type
      overflow(const int_type character) override
      {
        if (character != traits_type::eof())
          text += traits_type::to_char_type(character);
        return traits_type::not_eof(character);
      }

      std::streamsize
      xsputn(const char *characters, const std::streamsize n) override
      {
        text.append(characters, static_cast<std::size_t>(n));
        return n;
      }

      int
      sync() override
      {
        const py::gil_scoped_acquire held;
        if (!error)
          try
            {
              py::object known = py::getattr(stream, "encoding", py::none());
              if (known.is_none())
                known = py::str("utf-8");
              stream.attr("write")(
                py::str(text).attr("encode")(known, "replace").attr("decode")(known));
              stream.attr("flush")();
            }
          catch (const py::error_already_set &)
            {
              error = std::current_exception();
            }
        text.clear();
        return 0;
      }

    private:
      py::object         stream;
      std::string        text;
      std::exception_ptr error;
    };

    SceneSource
    make(const std::string &path, const Overrides &overrides)
    {
      start();
      const Computing computing;
      return {path, overrides, read_scene(path, overrides)};
    }

    /** All parameters, "Section/Name", and their values as they stand in a scene file. */
    py::dict
    values(const SceneSource &source)
    {
      py::dict result;
      for (const SceneEntry &entry : lex_scene(source.scene.resolved, "", ""))
        if (!entry.name.empty())
          result[py::str(entry.path())] = entry.value;
      return result;
    }

    /** The unit of a dimension such as "length³/time"; empty if the scene does not state
     *  all the units that it needs. */
    std::string
    unit(const SceneSource &source, const std::string &dimension)
    {
      const UnitParameters &units = source.scene.units;
      const auto            lacks = [&](const char *quantity, const std::string &own) {
        return own.empty() && dimension.find(quantity) != std::string::npos;
      };
      return lacks("length", units.length) || lacks("pressure", units.pressure) ||
                 lacks("time", units.time)
               ? ""
               : in_units_of(dimension, units);
    }

    py::array
    heights(const SceneSource &source, const py::object &comm)
    {
      MPI_Comm  communicator = communicator_of(comm);
      SlabField field;
      {
        const Computing     computing;
        const SlabLayoutPtr layout = make_layout(grid_of(source.scene), communicator);
        field                      = make_surface(source.scene.surface, layout);
      }
      return as_array(std::move(field));
    }

    py::dict
    statistics_of(const Array &array, const std::array<double, 2> &size)
    {
      start();
      require(array.ndim() == 2 && array.size() > 0,
              "The heights must be an array of two dimensions, neither of them 0.");
      require(size[0] > 0. && size[1] > 0. && std::isfinite(size[0] + size[1]),
              "The size must be lengths above zero.");
      const PeriodicGrid      grid{static_cast<int>(array.shape(1)),
                              static_cast<int>(array.shape(0)),
                              size[0],
                              size[1]};
      const SurfaceStatistics all = [&]() {
        const Computing computing;
        return statistics(as_field(make_layout(grid, MPI_COMM_SELF), array, "heights"));
      }();
      py::dict result;
      result["rms_height"]    = all.rms_height;
      result["rms_slope"]     = all.rms_slope;
      result["rms_curvature"] = all.rms_curvature;
      result["highest"]       = all.highest;
      result["lowest"]        = all.lowest;
      return result;
    }

    /** Run a scene as main() does. Returns whether all steps converged. */
    bool
    run(const SceneSource &source,
        const bool         verbose,
        const bool         resume,
        const bool         force)
    {
      PythonOutput buffer(py::module_::import("sys").attr("stdout"));
      std::ostream screen(&buffer);
      bool         converged = false;
      {
        const SignalsOfProgram signals;
        const Computing        computing;
        Log                    log(MPI_COMM_WORLD,
                screen,
                verbose ? Log::Screen::plain : Log::Screen::silent);
        if (!force && !resume)
          refuse_to_replace_results(source.scene, MPI_COMM_WORLD);
        converged = run_all_realisations(source.scene, log, resume);
        MPI_Barrier(MPI_COMM_WORLD); // all ranks may read what rank 0 wrote
      }
      buffer.rethrow();
      return converged;
    }

    void
    describe_scene(const SceneSource &source)
    {
      PythonOutput buffer(py::module_::import("sys").attr("stdout"));
      std::ostream screen(&buffer);
      {
        const Computing computing;
        Log             log(MPI_COMM_WORLD, screen, Log::Screen::plain);
        describe(source.scene, log);
      }
      buffer.rethrow();
    }

    std::string
    broadcast_text(const std::string &text)
    {
      start();
      const Computing computing;
      return broadcast(MPI_COMM_WORLD, text);
    }

    /** The current folder of the first rank, which reads the files. */
    std::string
    current_folder()
    {
      start();
      const Computing computing;
      std::string     here;
      run_on_root(MPI_COMM_WORLD,
                  [&]() { here = std::filesystem::current_path().string(); });
      return broadcast(MPI_COMM_WORLD, here);
    }

    void
    wait_for_all_ranks()
    {
      start();
      const Computing computing;
      MPI_Barrier(MPI_COMM_WORLD);
    }

    /** The number of this rank, and how many there are. */
    std::pair<int, int>
    rank()
    {
      start();
      return {rank_in(MPI_COMM_WORLD), n_ranks_in(MPI_COMM_WORLD)};
    }
  } // namespace

  void
  bind_scene(py::module_ &module)
  {
    py::class_<SceneSource, std::shared_ptr<SceneSource>>(
      module, "Scene", "A scene file, and its content.")
      .def(py::init(&make), py::arg("path"), py::arg("overrides"))
      .def_readonly("path", &SceneSource::path)
      .def_readonly("overrides", &SceneSource::overrides)
      .def_property_readonly("values",
                             &values,
                             "The values of all parameters as texts, by their names.")
      .def_property_readonly(
        "text",
        [](const SceneSource &source) { return source.scene.resolved; },
        "The scene file, with every default filled in.")
      .def_property_readonly("directory",
                             [](const SceneSource &source) {
                               return source.scene.output.directory;
                             })
      .def_property_readonly(
        "shape",
        [](const SceneSource &source) {
          const auto &[nx, ny] = source.scene.contact.grid_points;
          return py::make_tuple(ny, nx);
        },
        "(ny, nx) of the grid, the shape of arrays.")
      .def_property_readonly(
        "size",
        [](const SceneSource &source) {
          const auto &[lx, ly] = source.scene.surface.size;
          return py::make_tuple(lx, ly);
        },
        "(Lx, Ly) of the box.")
      .def("unit",
           &unit,
           py::arg("dimension"),
           "The unit of a dimension such as 'length³/time'.")
      .def("heights",
           &heights,
           py::arg("comm") = py::none(),
           "The surface, an array of shape (ny, nx), or the rows of this rank of comm.")
      .def("describe",
           &describe_scene,
           "Print what a run would do: sizes, memory, time, warnings.")
      .def("_run", &run, py::arg("verbose"), py::arg("resume"), py::arg("force"));
    module.def("statistics", &statistics_of, py::arg("heights"), py::arg("size"));
    module.def("broadcast", &broadcast_text);
    module.def("current_folder", &current_folder);
    module.def("rank", &rank);
    module.def("wait_for_all_ranks", &wait_for_all_ranks);
  }
} // namespace strait::python
