// SPDX-License-Identifier: GPL-2.0-or-later
// Classes of values: controls, states, jumps, transitions, flows.
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

    /** A number of a part of a state, or none if that part is missing. */
    template <typename Find>
    auto
    number(Find find)
    {
      using Number = std::decay_t<decltype(*find(SealState()))>;
      return [find](const State &state) -> std::optional<Number> {
        const Number *value = find(*state);
        return value != nullptr ? std::optional<Number>(*value) : std::nullopt;
      };
    }

    /** A number of the contact. */
    template <typename Member>
    auto
    of_contact(const Member member)
    {
      return number([member](const SealState &state) {
        return state.contact ? &((*state.contact).*member) : nullptr;
      });
    }

    void
    bind_fields(py::class_<SealState, State> &state)
    {
      state
        .def_property_readonly("gap",
                               field([](const SealState &self) { return &self.gap(); }),
                               "The gap at the grid points; at most 0 where closed.")
        .def_property_readonly("pressure",
                               field([](const SealState &self) {
                                 return self.contact ? &self.contact->pressure : nullptr;
                               }),
                               "The contact pressure; None for a given gap.")
        .def_property_readonly("fluid_pressure",
                               field([](const SealState &self) {
                                 return self.fluid ? &self.fluid->pressure : nullptr;
                               }),
                               "The fluid's pressure on the wall, continued under the "
                               "contact; None without Wall feedback.")
        .def_property_readonly("indentation",
                               field([](const SealState &self) {
                                 return self.contact && self.contact->plasticity
                                          ? &self.contact->plasticity->indentation
                                          : nullptr;
                               }),
                               "Indentation so far; None without Yielding.")
        .def_property_readonly(
          "first_row",
          [](const State &self) { return self->gap().layout().first_row(); },
          "The row of the grid with which the arrays on this rank begin.");
    }

    void
    bind_numbers(py::class_<SealState, State> &state)
    {
      state
        .def_property_readonly(
          "control",
          [](const State &self) { return self->control; },
          "The control that was prescribed.")
        .def_property_readonly(
          "mean_gap",
          [](const State &self) { return self->mean_gap; },
          "Mean gap; closed points count as 0.")
        .def_property_readonly("nominal_pressure",
                               of_contact(&ContactState::nominal_pressure),
                               "Load over nominal area.")
        .def_property_readonly("contact_area",
                               of_contact(&ContactState::contact_area),
                               "Fraction of the grid points in contact.")
        .def_property_readonly("contact_area_corrected",
                               of_contact(&ContactState::contact_area_corrected),
                               "The same for the continuum, from the perimeter.")
        .def_property_readonly("residual",
                               of_contact(&ContactState::residual),
                               "The residual that the contact solver left.")
        .def_property_readonly("iterations",
                               number([](const SealState &self) {
                                 return self.contact ? &self.costs.iterations : nullptr;
                               }),
                               "Iterations of the contact solver.")
        .def_property_readonly("adhesive_energy",
                               number([](const SealState &self) {
                                 return self.contact && self.contact->adhesion
                                          ? &self.contact->adhesion->adhesive_energy
                                          : nullptr;
                               }),
                               "Energy per area of the adhesion, at most 0; or None.")
        .def_property_readonly("plastic_area",
                               number([](const SealState &self) {
                                 return self.contact && self.contact->plasticity
                                          ? &self.contact->plasticity->area
                                          : nullptr;
                               }),
                               "Fraction of the points that yield; or None.")
        .def_property_readonly("fluid_load",
                               number([](const SealState &self) {
                                 return self.fluid ? &self.fluid->load : nullptr;
                               }),
                               "Load on the fluid over nominal area; or None.")
        .def_property_readonly(
          "converged",
          [](const State &self) { return self->converged(); },
          "Whether the solvers reached what was asked of them.");
    }

    /** A field of a flow, or none; the array keeps the flow alive. */
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
      py::class_<Flow, std::shared_ptr<Flow>>(module, "Flow", "The flow through one gap.")
        .def_readonly("percolates", &Flow::percolates, "Whether anything leaks.")
        .def_property_readonly("leak_rate",
                               of(&Leakage::rate),
                               "Volume per time; the best value within the bounds.")
        .def_property_readonly("lower", of(&Leakage::lower), "Lower bound of its size.")
        .def_property_readonly("upper", of(&Leakage::upper), "Upper bound of its size.")
        .def_readonly("effective_gap",
                      &Flow::effective_gap,
                      "The gap of smooth plates that would leak as much.")
        .def_property_readonly("status",
                               of(&Leakage::status),
                               "'ok', or a word for what failed.")
        .def_property_readonly("cells", of(&Leakage::cells), "Cells of the last mesh.")
        .def_property_readonly("unknowns", of(&Leakage::unknowns), "On the last mesh.")
        .def_readonly("constriction_x",
                      &Flow::x,
                      "x of the narrowest point on the path of least resistance.")
        .def_readonly("constriction_y", &Flow::y, "y of it; both NaN without a path.")
        .def_readonly("constriction_gap", &Flow::gap, "The gap there.")
        .def_property_readonly(
          "clusters",
          [](const py::object &self) {
            const auto &flow = self.cast<const Flow &>();
            return as_array(*flow.layout, flow.clusters.data(), self);
          },
          "Kind of each grid point: 0 closed, 1 open and joined to neither reservoir, "
          "2 to the inlet, 3 to the outlet, 4 to both, 5 outside of the seal mesh.")
        .def_property_readonly("pressure",
                               flow_field(&Flow::pressure),
                               "Pressure where it leaks, else NaN; None unless wanted.")
        .def_property_readonly("current",
                               flow_field(&Flow::current),
                               "Current, volume per time and width, likewise.");
    }

    void
    bind_jump(py::module_ &module)
    {
      py::class_<PathPoint>(module, "PathPoint", "One end of a jump.")
        .def_readonly("pressure", &PathPoint::pressure)
        .def_readonly("mean_gap", &PathPoint::mean_gap)
        .def_readonly("contact_area", &PathPoint::contact_area)
        .def_readonly("energy", &PathPoint::energy);
      py::class_<Jump>(module,
                       "Jump",
                       "A discontinuity on a path of an adhesive contact.")
        .def_readonly("before", &Jump::before)
        .def_readonly("after", &Jump::after, "Meaningless at a pull-off.")
        .def_readonly("dissipated",
                      &Jump::dissipated,
                      "Energy per area; NaN for a pull-off.")
        .def_property_readonly("is_pull_off",
                               &Jump::is_pull_off,
                               "Whether the surfaces part.");
    }
  } // namespace

  void
  bind_states(py::module_ &module)
  {
    py::class_<Control>(module, "Control", "What is prescribed from outside.")
      .def_readonly("target", &Control::target, "Nominal pressure, or mean gap.")
      .def_readonly("inlet_pressure", &Control::inlet_pressure)
      .def_readonly("slip_length", &Control::slip_length);
    py::class_<SealState, State> state(
      module,
      "State",
      "The state of a seal, and all that its past leaves behind. Arrays share its memory "
      "and are read-only; their shape is (ny, nx) or, on several ranks, (rows, nx).");
    bind_fields(state);
    bind_numbers(state);
    bind_flow(module);
    bind_jump(module);
    py::class_<Transition>(module,
                           "Transition",
                           "Where a seal begins or ceases to leak, enclosed.")
      .def_readonly("lower", &Transition::lower)
      .def_readonly("upper", &Transition::upper)
      .def_property_readonly("middle", &Transition::middle)
      .def_readonly("contact_area", &Transition::contact_area, "That at the lower end.")
      .def_readonly("place", &Transition::bottleneck, "(x, y) of the last constriction.")
      .def_readonly("slip_length", &Transition::slip_length)
      .def_readonly("n_solves", &Transition::n_solves, "Number of states asked for.");
    py::class_<BlowOut>(module, "BlowOut", "Inlet pressures that open and close a seal.")
      .def_readonly("load", &BlowOut::load)
      .def_readonly("opening", &BlowOut::opening, "0 if it leaks without any pressure.")
      .def_readonly("closing",
                    &BlowOut::closing,
                    "None unless Find re-sealing asks for it.");
  }
} // namespace strait::python
