// SPDX-License-Identifier: GPL-2.0-or-later
#include "seal.h"

#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/run/guards.h>
#include <strait/run/load_sweep.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/read_scene.h>
#include <strait/surface/self_affine_surface.h>
#include <strait/surface/statistics.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait::python
{
  namespace
  {
    /** Throw InputError unless a scene could state @p number, which has this @p name. */
    void
    require_usable(const std::string &name, const double number)
    {
      require(has_usable_magnitude(number),
              name + " must be a finite number, 0 or of a magnitude from 1e-30 to 1e30.");
    }
  } // namespace

  Seal::Seal(const SceneSource          &source,
             const std::optional<Array> &array,
             const py::object           &comm)
    : scene(source.scene)
    , communicator(communicator_of(comm))
    , log(communicator, nowhere, Log::Screen::silent)
    , layout(make_layout(grid_of(scene), communicator))
  {
    // A critical load may be asked for, and must not depend on the solver's residual.
    scene.programme.find_threshold =
      scene.contact.enabled && scene.fluid.enabled && scene.contact.is_load_controlled();
    for (const std::string &warning : scene.warnings())
      log.warn(warning);
    {
      const Computing computing;
      SlabField       heights;
      if (array)
        {
          const MapParameters &map = scene.surface.map;
          if (scene.surface.invert || scene.surface.rotate ||
              map.detrend != Detrend::none || map.make_periodic != MakePeriodic::no ||
              map.shortest_wavelength > 0. || map.longest_wavelength > 0.)
            log.warn(
              "Surface/Invert, Rotate and the processing of maps do not act on "
              "heights that are given");
          heights                              = as_field(layout, *array, "heights");
          scene.contact.adhesion.sphere_radius = 0.; // may be another surface
        }
      else
        {
          for (const std::string &warning :
               check_resolution(scene.surface, layout->grid()))
            log.warn(warning);
          Remarks remarks;
          heights = make_surface(scene.surface, layout, &remarks);
          for (const std::string &warning : remarks.warnings)
            log.warn(warning);
        }
      slope = statistics(heights).rms_slope;
      check_slope(scene, slope, log);
      contact = complete_contact(scene, heights, 0., log);
      if (scene.fluid.enabled)
        stage = std::make_unique<FlowStage>(scene.fluid, layout, log, timers);
      model = make_seal(scene, contact, std::move(heights), stage.get(), log);
    }
    pass_warnings_on(); // which may throw
    free_at_exit(this, [this]() { free(); });
  }

  Seal::~Seal()
  {
    forget_at_exit(this);
    if (!model) // freed at exit
      return;
    const Computing computing;
    free();
  }

  void
  Seal::free()
  {
    model = nullptr;
    stage.reset();
  }

  const SealModel &
  Seal::open() const
  {
    if (!model)
      throw std::runtime_error("MPI has ended, and with it this seal.");
    return model;
  }

  void
  Seal::require_fluid()
  {
    open();
    require(stage != nullptr, "Fluid/Enabled is false, so there is no flow.");
  }

  /** Throw InputError unless @p state has the grid, communicator and contact of this. */
  void
  Seal::require_own(const SealState &state) const
  {
    const PeriodicGrid &here = layout->grid(), &there = state.gap().grid();
    require(here.nx == there.nx && here.ny == there.ny && here.lx == there.lx &&
              here.ly == there.ly &&
              state.gap().layout().communicator() == communicator &&
              state.contact.has_value() == scene.contact.enabled &&
              (scene.contact.yields || !state.contact || !state.contact->plasticity),
            "The state is one of another seal: its grid, communicator or contact are "
            "not those of this one.");
  }

  void
  Seal::pass_warnings_on()
  {
    const py::object category = py::module_::import("strait").attr("SceneWarning");
    for (; n_warnings < log.warnings().size(); ++n_warnings)
      if (PyErr_WarnEx(category.ptr(), log.warnings()[n_warnings].c_str(), 2) != 0)
        throw py::error_already_set();
  }

  Control
  Seal::control(const double                target,
                const std::optional<double> inlet_pressure,
                const std::optional<double> slip_length) const
  {
    const Control result = {target,
                            inlet_pressure.value_or(scene.fluid.inlet_pressure),
                            slip_length.value_or(scene.fluid.slip_lengths.front())};
    require_usable("The load or mean gap", target);
    require_usable("The inlet pressure", result.inlet_pressure);
    require_usable("The slip length", result.slip_length);
    require(!scene.fluid.is_gas || result.inlet_pressure >= 0.,
            "Fluid/State = gas needs absolute pressures, but the inlet pressure is "
            "negative.");
    require(result.slip_length <= 0.,
            "The slip length must be a finite number of at most 0.");
    return result;
  }

  /** The control of @p at; throws InputError if its pressures have no meaning. */
  Control
  Seal::control_of(const LoadOrControl &at) const
  {
    const auto *const target = std::get_if<double>(&at);
    const Control     asked =
      target != nullptr ? control(*target, {}, {}) : std::get<Control>(at);
    FluidParameters fluid = scene.fluid;
    fluid.inlet_pressure  = asked.inlet_pressure;
    require_bearable(scene, asked.target, fluid);
    return asked;
  }

  Aim
  Seal::aim() const
  {
    return stage ? Aim::leak_rate : Aim::verdict;
  }

  State
  Seal::solve(const LoadOrControl &at, const State &from)
  {
    State state;
    {
      const SealModel &seal = open();
      const Use        use(*this);
      if (from)
        require_own(*from);
      state = std::make_shared<SealState>(seal(control_of(at), from.get(), aim()));
    }
    pass_warnings_on();
    return state;
  }

  Seal::Followed
  Seal::follow(const std::vector<LoadOrControl> &through, const State &from)
  {
    Followed path;
    auto &[states, jumps, parted] = path;
    {
      const SealModel &seal = open();
      const Use        use(*this);
      if (from)
        require_own(*from);
      std::vector<Control> controls;
      double               largest = 0.; // sets the tolerance of jumps
      for (const LoadOrControl &at : through)
        {
          controls.push_back(control_of(at));
          largest = std::max(largest, std::abs(controls.back().target));
        }
      State last = from;
      for (const Control &next : controls)
        {
          Arrival arrival =
            strait::follow(seal, next, last.get(), aim(), step_rule(scene, largest));
          jumps.insert(jumps.end(), arrival.jumps.begin(), arrival.jumps.end());
          parted = !arrival.state;
          if (parted)
            break;
          last = std::make_shared<SealState>(std::move(*arrival.state));
          states.push_back(last);
          check_signals();
        }
    }
    pass_warnings_on();
    return path;
  }

  std::shared_ptr<Flow>
  Seal::flow(const State &state, const bool with_fields)
  {
    require_fluid();
    std::shared_ptr<Flow> result;
    {
      const Use use(*this);
      require_own(*state);
      stage->set_inlet_pressure(state->control.inlet_pressure);
      const StepFlow flow = leak_through(*state, scene, *stage);
      result = record_of(flow, state->gap().layout(), layout, stage->fluid());
      if (with_fields && flow.solution)
        add_fields(*result, *flow.solution);
      else if (with_fields)
        {
          const double nowhere = std::numeric_limits<double>::quiet_NaN();
          result->pressure.emplace(layout, nowhere);
          result->current.emplace(layout, nowhere);
        }
    }
    pass_warnings_on();
    return result;
  }

  std::vector<Transition>
  Seal::find_transitions(const std::optional<double> first)
  {
    require_fluid();
    require(scene.programme.find_threshold,
            "A critical load needs Contact/Enabled and Contact/Control = load.");
    require_usable("The first load of a search", first.value_or(1.));
    require(first.value_or(1.) > 0.,
            "The first load of a search must be a finite number above 0.");
    const Use  use(*this);
    SealSearch search(scene, open(), layout, stage->domain(), log);
    search.after_probe = check_signals;
    SearchStart start  = search_start(scene, contact, slope);
    start.value        = first.value_or(start.value);
    return search.find_critical_loads(start);
  }

  std::vector<BlowOut>
  Seal::find_blow_outs(const std::vector<double> &loads)
  {
    require_fluid();
    require(scene.fluid.feedback.enabled && scene.programme.find_threshold,
            "A blow-out pressure needs Fluid/Wall feedback/Enabled and "
            "Contact/Control = load.");
    for (const double load : loads)
      {
        require(load > 0., "A blow-out pressure needs a load above 0.");
        control_of(load); // throws if it has no meaning
      }
    const Use use(*this);
    Scene     of_loads           = scene;
    of_loads.programme.pressures = loads;
    SealSearch search(of_loads, open(), layout, stage->domain(), log);
    search.after_probe = check_signals;
    return search.find_blow_outs();
  }

  void
  bind_seal(py::module_ &module)
  {
    py::class_<Seal>(module, "Seal")
      .def(py::init<const SceneSource &, std::optional<Array>, py::object>(),
           py::arg("scene"),
           py::arg("heights") = py::none(),
           py::arg("comm")    = py::none())
      .def("control",
           &Seal::control,
           py::arg("target"),
           py::arg("inlet_pressure") = py::none(),
           py::arg("slip_length")    = py::none(),
           "A control; parts that are not given are those of the scene.")
      .def("solve", &Seal::solve, py::arg("control") = 0., py::arg("from_") = State())
      .def("_follow", &Seal::follow, py::arg("controls"), py::arg("from_") = State())
      .def("flow", &Seal::flow, py::arg("state").none(false), py::arg("fields") = false)
      .def("find_transitions",
           &Seal::find_transitions,
           py::arg("first") = py::none(),
           "The critical load of each slip length of the scene.")
      .def("find_blow_outs", &Seal::find_blow_outs, py::arg("loads"))
      .def_property_readonly("rms_slope", &Seal::rms_slope, "Rms slope of the surface.");
  }
} // namespace strait::python
