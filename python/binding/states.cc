// SPDX-License-Identifier: GPL-2.0-or-later
// Values: controls, states, jumps, transitions, flows.
#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"

namespace strait::python
{
  namespace
  {
    /** A field of a state, or none; the array shares it and keeps the state alive. */
    template <typename Find>
    auto
    field(Find find)
    {
      return [find](const py::object &self) -> py::object {
        const SlabField *values = find(*self.cast<State>());
        if (values == nullptr || values->empty())
          return py::none();
        return as_array(values->layout(), values->data(), self);
      };
    }

    /** A number of the contact, or none. */
    template <typename Number>
    auto
    of_contact(Number ContactState::*member)
    {
      return [member](const State &state) -> std::optional<Number> {
        if (!state->contact)
          return {};
        return (*state->contact).*member;
      };
    }

    void
    bind_state(py::module_ &module)
    {
      py::class_<SealState, State>(module, "State")
        .def_property_readonly("control",
                               [](const State &state) { return state->control; })
        .def_property_readonly("gap",
                               field([](const SealState &state) { return &state.gap(); }))
        .def_property_readonly("pressure", field([](const SealState &state) {
                                 return state.contact ? &state.contact->pressure
                                                      : nullptr;
                               }))
        .def_property_readonly("fluid_pressure", field([](const SealState &state) {
                                 return state.fluid ? &state.fluid->pressure : nullptr;
                               }))
        .def_property_readonly("indentation", field([](const SealState &state) {
                                 return state.contact && state.contact->plasticity
                                          ? &state.contact->plasticity->indentation
                                          : nullptr;
                               }))
        .def_property_readonly("first_row",
                               [](const State &state) {
                                 return state->gap().layout().first_row();
                               })
        .def_property_readonly("mean_gap",
                               [](const State &state) { return state->mean_gap; })
        .def_property_readonly("nominal_pressure",
                               of_contact(&ContactState::nominal_pressure))
        .def_property_readonly("contact_area", of_contact(&ContactState::contact_area))
        .def_property_readonly("contact_area_corrected",
                               of_contact(&ContactState::contact_area_corrected))
        .def_property_readonly("residual", of_contact(&ContactState::residual))
        .def_property_readonly("iterations", of_contact(&ContactState::iterations))
        .def_property_readonly("adhesive_energy",
                               [](const State &state) -> std::optional<double> {
                                 if (!state->contact || !state->contact->adhesion)
                                   return {};
                                 return state->contact->adhesion->adhesive_energy;
                               })
        .def_property_readonly("plastic_area",
                               [](const State &state) -> std::optional<double> {
                                 if (!state->contact || !state->contact->plasticity)
                                   return {};
                                 return state->contact->plasticity->area;
                               })
        .def_property_readonly("fluid_load",
                               [](const State &state) -> std::optional<double> {
                                 if (!state->fluid)
                                   return {};
                                 return state->fluid->load;
                               })
        .def_property_readonly("converged",
                               [](const State &state) { return state->converged(); });
    }

    /** A field of a flow, likewise. */
    auto
    flow_field(std::optional<SlabField> Flow::*member)
    {
      return [member](const py::object &self) -> py::object {
        const auto &flow = self.cast<const Flow &>();
        if (!(flow.*member))
          return py::none();
        return as_array(*flow.layout, (flow.*member)->data(), self);
      };
    }

    void
    bind_flow(py::module_ &module)
    {
      const auto of = [](auto member) {
        return [member](const Flow &flow) { return flow.leakage.*member; };
      };
      py::class_<Flow, std::shared_ptr<Flow>>(module, "Flow")
        .def_readonly("percolates", &Flow::percolates)
        .def_property_readonly("leak_rate", of(&Leakage::rate))
        .def_property_readonly("lower", of(&Leakage::lower))
        .def_property_readonly("upper", of(&Leakage::upper))
        .def_property_readonly("cells", of(&Leakage::cells))
        .def_property_readonly("unknowns", of(&Leakage::unknowns))
        .def_property_readonly("status", of(&Leakage::status))
        .def_readonly("effective_gap", &Flow::effective_gap)
        .def_readonly("constriction_x", &Flow::x)
        .def_readonly("constriction_y", &Flow::y)
        .def_readonly("constriction_gap", &Flow::gap)
        .def_property_readonly("clusters",
                               [](const py::object &self) {
                                 const auto &flow = self.cast<const Flow &>();
                                 return as_array(*flow.layout,
                                                 flow.clusters.data(),
                                                 self);
                               })
        .def_property_readonly("pressure", flow_field(&Flow::pressure))
        .def_property_readonly("current", flow_field(&Flow::current));
    }
  } // namespace

  void
  bind_states(py::module_ &module)
  {
    py::class_<Control>(module, "Control")
      .def_readonly("target", &Control::target)
      .def_readonly("inlet_pressure", &Control::inlet_pressure)
      .def_readonly("slip_length", &Control::slip_length);
    bind_state(module);
    bind_flow(module);
    py::class_<PathPoint>(module, "PathPoint")
      .def_readonly("pressure", &PathPoint::pressure)
      .def_readonly("mean_gap", &PathPoint::mean_gap)
      .def_readonly("contact_area", &PathPoint::contact_area)
      .def_readonly("energy", &PathPoint::energy);
    py::class_<Jump>(module, "Jump")
      .def_readonly("before", &Jump::before)
      .def_readonly("after", &Jump::after)
      .def_readonly("dissipated", &Jump::dissipated)
      .def_readonly("is_pull_off", &Jump::is_pull_off);
    py::class_<Transition>(module, "Transition")
      .def_readonly("slip_length", &Transition::slip_length)
      .def_readonly("lower", &Transition::lower)
      .def_readonly("upper", &Transition::upper)
      .def_property_readonly("middle", &Transition::middle)
      .def_readonly("contact_area", &Transition::contact_area)
      .def_readonly("place", &Transition::bottleneck)
      .def_readonly("n_solves", &Transition::n_solves);
    py::class_<BlowOut>(module, "BlowOut")
      .def_readonly("load", &BlowOut::load)
      .def_readonly("opening", &BlowOut::opening)
      .def_readonly("closing", &BlowOut::closing);
  }
} // namespace strait::python
