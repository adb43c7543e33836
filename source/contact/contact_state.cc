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

  namespace
  {
    /** Whether the @p pressure counts as at the hardness. Points that yielded and are
     *  loaded as much again lie on either side of it within the solver's tolerance. */
    bool
    flows(const double pressure, const double hardness)
    {
      // Half or double of it changes the yielding area under a first load by 0.05 %.
      constexpr double almost = 1e-3;
      return pressure > (1. - almost) * hardness;
    }

    /**
     * Return S a, the length of the contact line on the lattice times the spacing of the
     * points over the nominal area, from the pairs of neighbours of which one touches.
     * Edges where the pressure is at @p limit are left out: there the lattice does not
     * overestimate the area. Collective.
     */
    double
    line_times_spacing(const SlabField &pressure, const double limit)
    {
      const SlabLayout &layout = pressure.layout();
      const double      aspect = layout.grid().dy() / layout.grid().dx();
      double            total  = 0; // in units of a grid point's area
      const RowsAround  rows(pressure);
      layout.for_each_point([&](const GridPoint &here) {
        if (here.window >= 0 && layout.rank() != 0) // all ranks hold the windows
          return;
        const int    level  = here.window < 0 ? 0 : layout.windows()[here.window].level;
        const double p_here = rows.at(here);
        for (const GridPoint &there : {GridPoint{here.ix + 1, here.iy, here.window},
                                       GridPoint{here.ix, here.iy + 1, here.window}})
          {
            const double p_there = rows.at(there);
            // Between two points that finer ones cover, the finer ones decide.
            if (!std::isnan(p_there) && (p_here > 0) != (p_there > 0) &&
                !flows(std::max(p_here, p_there), limit) &&
                !(layout.finer(here) && layout.finer(there)))
              total += std::sqrt(here.iy == there.iy ? aspect : 1. / aspect) *
                       std::pow(9., -level);
          }
      });
      return sum(layout.communicator(), total) /
             static_cast<double>(layout.grid().n_points());
    }
  } // namespace

  PlasticState
  indent(const SlabField *before,
         const SlabField &pressure,
         const SlabField &gap,
         const double     hardness,
         const bool       is_solution)
  {
    PlasticState state;
    state.indentation = before != nullptr ? *before : SlabField(gap.layout_pointer());
    for (std::size_t i = 0; i < gap.size(); ++i)
      if (pressure[i] == hardness && is_solution)
        state.indentation[i] += std::max(0., -gap[i]);
    state.mean_indentation = mean(state.indentation);
    state.area             = mean_of(pressure, [hardness](const double p) {
      return flows(p, hardness) ? 1. : 0.;
    });
    return state;
  }

  ContactState::ContactState(SlabField pressure_, SlabField gap_, const double limit)
    : pressure(std::move(pressure_))
    , gap(std::move(gap_))
    , mean_gap(mean(gap))
    , contact_area(mean_of(pressure, [](const double p) { return p > 0 ? 1. : 0.; }))
    , contact_area_corrected(contact_area - (M_PI - 1 + std::log(2.)) / 24 *
                                              line_times_spacing(pressure, limit))
  {
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
    archive.value(adhesion.relaxation);
  }
} // namespace strait
