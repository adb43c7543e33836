// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_field.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  GapField::GapField(const SlabLayoutPtr &layout, const FluidParameters &fluid)
    : slab_layout(layout)
    , grid_rows{layout->grid(), {fluid.interpolation, fluid.direction}, 0, {}}
    , quadrature(fluid)
    , is_rigorous(fluid.rigorous_bounds)
    , unit_gap_conductivity(1. / (12. * fluid.viscosity))
    , halvings(fluid.mesh_file.empty() ? layout->grid().n_halvings() : 0)
  {
  }

  CoefficientLaw
  GapField::law(const Coefficient coefficient) const
  {
    CoefficientLaw law{unit_gap_conductivity,
                       floor_value,
                       coefficient != Coefficient::conductivity &&
                         coefficient != Coefficient::largest_conductivity};
    if (rarefied)
      switch (coefficient)
        {
          case Coefficient::largest_conductivity:
            law.factor = &rarefied->largest_weight;
            break;
          case Coefficient::largest_resistivity:
            law.factor = &rarefied->least_weight;
            break;
          case Coefficient::molecular_resistivity:
            law.factor = &*rarefied->molecular_weight;
            break;
          case Coefficient::viscous_resistivity:
            break;
          default:
            law.factor = &rarefied->middle_weight;
        }
    return law;
  }

  double
  GapField::gap_of(const double conductivity) const
  {
    // The factor of a rarefied gas falls no faster than 1/gap, so each cubic root divides
    // the error by three or more. After that many rounds it is 10⁻⁶.
    double gap = std::cbrt(conductivity / unit_gap_conductivity);
    if (rarefied)
      for (int round = 0; round < 14; ++round)
        gap =
          std::cbrt(conductivity / unit_gap_conductivity / rarefied->middle_weight(gap));
    return gap;
  }

  void
  GapField::update(const SlabField &gap, const double conductivity_floor)
  {
    floor_value = conductivity_floor;
    slab_layout = gap.layout_pointer();
    std::vector<int> wanted;
    const int        begin = layout().first_row(), n_rows = layout().n_rows();
    if (n_rows > 0)
      // Enough rows for the stencils in a pyramid cell that begins in the last own row.
      for (int row = begin - 1; row < begin + n_rows + (1 << finest) + 1; ++row)
        wanted.push_back(row);
    grid_rows.first_row = begin - 1;
    grid_rows.rows      = fetch_rows(gap, wanted);
    window_values.assign(gap.begin() +
                           static_cast<std::ptrdiff_t>(layout().n_local_points()),
                         gap.end());
    known.clear();
    std::vector<Coefficient> coefficients{Coefficient::conductivity};
    if (floor_value > 0)
      coefficients.push_back(Coefficient::resistivity);
    build(coefficients);
  }

  GapStencil
  GapField::stencil(const GridPoint &cell) const
  {
    if (cell.window < 0)
      return grid_rows.stencil(cell.ix, cell.iy);
    GapStencil gap;
    for (int b = 0; b < 4; ++b)
      std::copy_n(window_values.data() +
                    position({cell.ix - 1, cell.iy - 1 + b, cell.window}),
                  4,
                  gap[b].begin());
    return gap;
  }

  std::size_t
  GapField::position(const GridPoint &cell) const
  {
    return layout().index_of(cell) - layout().n_local_points();
  }

  GapRows
  GapField::rows(const double y_low, const double y_high) const
  {
    const PeriodicGrid &grid  = layout().grid();
    int                 first = 0;
    std::vector<int>    wanted;
    if (y_low <= y_high) // else this rank has no cells
      {
        first = std::clamp(static_cast<int>(y_low / grid.dy()), 0, grid.ny - 1) - 1;
        const int last = std::min(static_cast<int>(y_high / grid.dy()), grid.ny - 1) + 2;
        for (int row = first; row <= last; ++row)
          wanted.push_back(row);
      }
    // grid_rows begins one row before those of this rank.
    const double *own_rows =
      grid_rows.rows.data() + (grid_rows.rows.empty() ? 0 : grid.nx);
    return {grid,
            grid_rows.interpolant,
            first,
            fetch_rows(layout(), own_rows, grid.nx, wanted)};
  }
} // namespace strait
