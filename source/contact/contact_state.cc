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
    /** What flowed before and is loaded as much again is at the hardness but for the
     *  solver's tolerance, and some points are on either side of it. */
    bool
    flows(const double pressure, const double hardness)
    {
      // Half or double of it changes the area under a first load by 0.05 % of itself.
      constexpr double almost = 1e-3;
      return pressure > (1. - almost) * hardness;
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
    SlabField is_plastic(gap.layout_pointer());
    for (std::size_t i = 0; i < gap.size(); ++i)
      {
        is_plastic[i] = flows(pressure[i], hardness) ? 1. : 0.;
        if (pressure[i] == hardness && is_solution)
          state.indentation[i] += std::max(0., -gap[i]);
      }
    state.mean_indentation = mean(state.indentation);
    state.area             = mean(is_plastic);
    return state;
  }

  namespace
  {
    /** The contact line on a lattice, by the pairs of neighbours of which one touches. */
    class LatticeLine
    {
    public:
      /** Where the pressure ends at @p limit the lattice does not count too much. */
      LatticeLine(const SlabField &pressure_, const double limit_)
        : pressure(pressure_)
        , limit(limit_)
        , layout(pressure.layout())
        , aspect(layout.grid().dy() / layout.grid().dx())
      {
      }

      /** Its length times the spacing of the points, over the area of the box, S a.
       *  Collective. */
      double
      times_spacing()
      {
        add_grid();
        // All ranks hold the windows.
        if (layout.rank() == 0)
          for (std::size_t w = 0; w < layout.windows().size(); ++w)
            add_window(static_cast<int>(w));
        return sum(layout.communicator(), total) /
               static_cast<double>(layout.grid().n_points());
      }

    private:
      void
      add_grid()
      {
        const int        nx = layout.grid().nx, ny = layout.grid().ny;
        const RowsAround rows(pressure);
        for (int row = 0; row < layout.n_rows(); ++row)
          for (int ix = 0; ix < nx; ++ix)
            {
              const int    next = ix + 1 < nx ? ix + 1 : 0, iy = layout.first_row() + row;
              const double here = rows[row][ix];
              add_pair(here, rows[row][next], {-1, ix, iy}, {-1, next, iy});
              add_pair(here, rows[row + 1][ix], {-1, ix, iy}, {-1, ix, (iy + 1) % ny});
            }
      }

      void
      add_window(const int w)
      {
        const int     n_columns = layout.windows()[w].n_columns();
        const int     n_rows    = layout.windows()[w].n_rows();
        const double *values    = pressure.data() + layout.start_of_window(w);
        for (int iy = 0; iy < n_rows; ++iy)
          for (int ix = 0; ix < n_columns; ++ix)
            {
              const double *here = values + static_cast<std::size_t>(iy) * n_columns + ix;
              if (ix + 1 < n_columns)
                add_pair(here[0], here[1], {w, ix, iy}, {w, ix + 1, iy});
              if (iy + 1 < n_rows)
                add_pair(here[0], here[n_columns], {w, ix, iy}, {w, ix, iy + 1});
            }
      }

      /** A point of a window, −1 for the grid. */
      struct Place
      {
        int window, ix, iy;
      };

      /** Of two points that finer ones cover nothing is known here. */
      void
      add_pair(const double pressure_here,
               const double pressure_there,
               const Place &here,
               const Place &there)
      {
        if ((pressure_here > 0) == (pressure_there > 0) ||
            flows(std::max(pressure_here, pressure_there), limit) ||
            (is_covered(here) && is_covered(there)))
          return;
        const int    level = here.window < 0 ? 0 : layout.windows()[here.window].level;
        const double side  = std::sqrt(here.iy == there.iy ? aspect : 1. / aspect);
        total += side * std::pow(9., -level);
      }

      bool
      is_covered(const Place &place) const
      {
        return layout.covered_by(place.window, place.ix, place.iy) >= 0;
      }

      const SlabField  &pressure;
      const double      limit;
      const SlabLayout &layout;
      const double      aspect;
      double            total = 0; // in areas of a grid point
    };
  } // namespace

  ContactState::ContactState(SlabField pressure_, SlabField gap_, const double limit)
    : pressure(std::move(pressure_))
    , gap(std::move(gap_))
    , mean_gap(mean(gap))
  {
    const SlabLayout &layout  = pressure.layout();
    double            touches = 0; // in areas of a grid point
    for (const SlabLayout::Range &range : layout.ranges())
      touches += range.area * std::count_if(pressure.begin() + range.begin,
                                            pressure.begin() + range.end,
                                            [](const double p) { return p > 0; });
    contact_area =
      sum(layout.communicator(), touches) / static_cast<double>(layout.grid().n_points());
    contact_area_corrected =
      contact_area -
      (M_PI - 1 + std::log(2.)) / 24 * LatticeLine(pressure, limit).times_spacing();
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
