// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/contact_state.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace strait
{
  Approach::Approach(const double     target,
                     const SlabField &before,
                     const double     target_before)
    : at(target)
    , came_from(target_before)
  {
    const double largest = max_value(before);
    if (target == target_before || !(largest > 0))
      return;
    scale = largest;
    earlier.resize(before.size());
    for (std::size_t i = 0; i < earlier.size(); ++i)
      earlier[i] = static_cast<float>(before[i] / scale);
  }

  double
  Approach::steps_to(const double next) const
  {
    return scale > 0 ? (next - at) / (at - came_from)
                     : std::numeric_limits<double>::infinity();
  }

  SlabField
  Approach::extrapolated(const SlabField &here, const double next) const
  {
    const double ratio = steps_to(next);
    SlabField    field = here;
    for (std::size_t i = 0; i < field.size(); ++i)
      if (here[i] > 0)
        field[i] = std::max(0., here[i] + ratio * (here[i] - earlier[i] * scale));
    return field;
  }

  void
  Approach::transfer(StateArchive &archive, const SlabLayout &layout)
  {
    archive.values(at, came_from);
    archive.field(earlier, layout);
    archive.value(scale);
  }

  PlasticState
  indent(const SlabField *before,
         const SlabField &pressure,
         const SlabField &gap,
         const double     hardness,
         const bool       is_solution)
  {
    // What flowed before and is loaded as much again is at the hardness but for the
    // solver's tolerance, and some points are on either side of it. Half or double of
    // it changes the area under a first load by 0.05 % of itself.
    constexpr double almost = 1e-3;

    PlasticState state;
    state.indentation = before != nullptr ? *before : SlabField(gap.layout_pointer());
    SlabField is_plastic(gap.layout_pointer());
    for (std::size_t i = 0; i < gap.size(); ++i)
      {
        is_plastic[i] = pressure[i] > (1. - almost) * hardness ? 1. : 0.;
        if (pressure[i] == hardness && is_solution)
          state.indentation[i] += std::max(0., -gap[i]);
      }
    state.mean_indentation = mean(state.indentation);
    state.area             = mean(is_plastic);
    return state;
  }

  ContactState::ContactState(SlabField pressure_, SlabField gap_)
    : pressure(std::move(pressure_))
    , gap(std::move(gap_))
    , mean_gap(mean(gap))
  {
    const SlabLayout &layout = pressure.layout();
    const int         nx     = layout.grid().nx;

    // The row after the last one belongs to another rank (or is the first one).
    const RowsAround rows(pressure);

    double counts[2] = {}; // points in contact, and edges of the lattice that leave it
    for (int row = 0; row < layout.n_rows(); ++row)
      {
        const double *here = rows[row], *below = rows[row + 1];
        for (int ix = 0; ix < nx; ++ix)
          {
            const bool touches = here[ix] > 0;
            counts[0] += touches;
            counts[1] += touches != (here[ix + 1 < nx ? ix + 1 : 0] > 0);
            counts[1] += touches != (below[ix] > 0);
          }
      }
    sum_in_place(layout.communicator(), counts, 2);

    // An edge is dx or dy long and its points dy or dx apart, so that S a is
    // dx dy an edge on a rectangular grid as well.
    const double n_points = static_cast<double>(layout.grid().n_points());
    contact_area          = counts[0] / n_points;
    contact_area_corrected =
      (counts[0] - (M_PI - 1 + std::log(2.)) / 24 * counts[1]) / n_points;
  }

  void
  transfer(StateArchive &archive, ContactState &state, const SlabLayoutPtr &layout)
  {
    archive.field(state.pressure, layout);
    archive.field(state.gap, layout);
    archive.values(state.nominal_pressure,
                   state.mean_gap,
                   state.contact_area,
                   state.contact_area_corrected,
                   state.residual,
                   state.converged);
    state.approach.transfer(archive, state.pressure.layout());
    if (transfer_presence(archive, state.plasticity))
      {
        archive.field(state.plasticity->indentation, layout);
        archive.values(state.plasticity->mean_indentation, state.plasticity->area);
      }
    if (!transfer_presence(archive, state.adhesion))
      return;
    AdhesiveState &adhesion = *state.adhesion;
    archive.values(adhesion.adhesive_energy,
                   adhesion.attraction,
                   adhesion.total_energy,
                   adhesion.smallest_curvature,
                   adhesion.detached);
    archive.field(adhesion.softest_direction, *layout);
    transfer_all(archive, adhesion.relaxation, [&](RelaxationStep &step) {
      archive.values(step.iteration, step.energy, step.residual, step.step);
    });
  }
} // namespace strait
