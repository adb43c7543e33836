// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/signals.h>
#include <strait/interface/gap_field.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** The grid row that decides which rank owns a cell. */
    int
    first_grid_row(const GridCell &cell)
    {
      return cell.exponent >= 0 ? cell.j << cell.exponent : cell.j >> -cell.exponent;
    }
  } // namespace

  GapField::GapField(const SlabLayoutPtr &layout, const FluidParameters &fluid)
    : slab_layout(layout)
    , grid_rows{layout->grid(), {fluid.interpolation, fluid.direction}, 0, {}}
    , quadrature(fluid)
    , conductivity_of_one(1. / (12. * fluid.viscosity))
    , halvings(fluid.mesh_file.empty() ? layout->grid().n_halvings() : 0)
  {
  }

  CoefficientLaw
  GapField::law(const Coefficient coefficient) const
  {
    CoefficientLaw law{conductivity_of_one,
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
    // The factor of a rarefied gas falls no faster than 1/gap: the cubic root divides
    // the error by three or more. After that many rounds it is 10⁻⁶.
    double gap = std::cbrt(conductivity / conductivity_of_one);
    if (rarefied)
      for (int round = 0; round < 14; ++round)
        gap =
          std::cbrt(conductivity / conductivity_of_one / rarefied->middle_weight(gap));
    return gap;
  }

  void
  GapField::update(const SlabField &gap, const double conductivity_floor)
  {
    floor_value = conductivity_floor;
    ++n_updates;
    slab_layout = gap.layout_pointer();
    std::vector<int> wanted;
    const int        begin = layout().first_row(), n_rows = layout().n_rows();
    if (n_rows > 0)
      for (int row = begin - 1; row < begin + n_rows + 3; ++row)
        wanted.push_back(row);
    grid_rows.first_row = begin - 1;
    grid_rows.rows      = fetch_rows(gap, wanted);
    window_values.assign(gap.begin() +
                           static_cast<std::ptrdiff_t>(layout().n_local_points()),
                         gap.end());
    known.clear();
    build(Coefficient::conductivity);
    if (floor_value > 0)
      build(Coefficient::resistivity);
  }

  std::optional<GridPoint>
  GapField::first_finer_cell(const GridPoint &cell) const
  {
    const int w = layout().covered_by(cell.window, cell.ix, cell.iy);
    if (w < 0)
      return {};
    const ZoomWindow &window = layout().windows()[w];
    int               a = cell.ix - window.x, b = cell.iy - window.y;
    if (cell.window < 0)
      {
        const PeriodicGrid &grid = layout().grid();
        a                        = (a + grid.nx) % grid.nx;
        b                        = (b + grid.ny) % grid.ny;
      }
    if (a + 1 == window.nx || b + 1 == window.ny)
      return {};
    return GridPoint{3 * a + 1, 3 * b + 1, w};
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
    return layout().start_of_window(cell.window) - layout().n_local_points() +
           static_cast<std::size_t>(cell.iy) *
             layout().windows()[cell.window].n_columns() +
           cell.ix;
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
    // The rows of this rank follow the one before them.
    const double *own_rows =
      grid_rows.rows.data() + (grid_rows.rows.empty() ? 0 : grid.nx);
    return {grid,
            grid_rows.interpolant,
            first,
            fetch_rows(layout(), own_rows, grid.nx, wanted)};
  }

  void
  GapField::build(const Coefficient coefficient) const
  {
    const std::size_t   n_moments = moment_set().size();
    std::vector<double> of_window_cells(window_values.size() * n_moments);
    const auto          moments_of = [&](const GridPoint &cell, double *moments) {
      return add_cell(coefficient, cell, Square(), of_window_cells.data(), moments);
    };
    // A window's cells are made of those of the windows in it, which come after it.
    const auto &windows = layout().windows();
    for (int w = static_cast<int>(windows.size()) - 1; w >= 0; --w)
      for (int iy = 1; iy < windows[w].n_rows() - 2; ++iy)
        for (int ix = 1; ix < windows[w].n_columns() - 2; ++ix)
          moments_of({ix, iy, w}, &of_window_cells[position({ix, iy, w}) * n_moments]);
    MomentPyramid pyramid(slab_layout,
                          moment_set(),
                          halvings,
                          [&](const int ix, const int iy, double *moments) {
                            return moments_of({ix, iy}, moments);
                          });
    known.emplace(coefficient, Known{std::move(of_window_cells), std::move(pyramid)});
  }

  bool
  GapField::add_cell(const Coefficient coefficient,
                     const GridPoint  &cell,
                     const Square     &square,
                     const double     *of_window_cells,
                     double           *moments) const
  {
    const std::optional<GridPoint> first = first_finer_cell(cell);
    if (!first)
      return quadrature.integrate(law(coefficient), stencil(cell), square, moments);
    bool adds = false;
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a)
        {
          const GridPoint finer{first->ix + a, first->iy + b, first->window};
          const Square    part{3. * square.x0 - a, 3. * square.y0 - b, 3. * square.edge};
          const double    right = part.x0 + part.edge, upper = part.y0 + part.edge;
          if (part.x0 <= 0. && part.y0 <= 0. && right >= 1. && upper >= 1.)
            {
              moment_set().add_part(moments,
                                    of_window_cells +
                                      position(finer) * moment_set().size(),
                                    -part.x0 / part.edge,
                                    -part.y0 / part.edge,
                                    1. / part.edge);
              adds = true;
            }
          else if (part.x0 < 1. && part.y0 < 1. && right > 0. && upper > 0.)
            adds |= add_cell(coefficient, finer, part, of_window_cells, moments);
        }
    return adds;
  }

  void
  GapField::answer(const Coefficient coefficient,
                   const GridCell   &cell,
                   double           *moments) const
  {
    const Known &found = known.at(coefficient);
    if (cell.exponent > 0 && cell.exponent < MomentPyramid::finest)
      {
        std::vector<double> child(moment_set().size());
        for (int upper = 0; upper < 2; ++upper)
          for (int right = 0; right < 2; ++right)
            {
              std::fill(child.begin(), child.end(), 0.);
              answer(coefficient,
                     {cell.exponent - 1, 2 * cell.i + right, 2 * cell.j + upper},
                     child.data());
              moment_set().add_child(moments, child.data(), right, upper);
            }
        return;
      }
    if (cell.exponent > 0)
      {
        std::copy_n(found.pyramid.moments(cell), moment_set().size(), moments);
        return;
      }
    const int    shift = -cell.exponent;
    const int    ix = cell.i >> shift, iy = cell.j >> shift;
    const double edge = std::ldexp(1., -shift);
    add_cell(coefficient,
             {ix, iy},
             {(cell.i - (ix << shift)) * edge, (cell.j - (iy << shift)) * edge, edge},
             found.of_window_cells.data(),
             moments);
  }

  CellAnswers
  GapField::ask(const Coefficient coefficient, const std::vector<GridCell> &cells) const
  {
    interruption_point(); // once a mesh
    if (known.count(coefficient) == 0)
      {
        // All but conductivity and resistivity.
        known.erase(known.upper_bound(Coefficient::resistivity), known.end());
        build(coefficient);
      }
    using dealii::Utilities::MPI::some_to_some;
    const std::size_t n_moments = moment_set().size();
    CellAnswers       answers(cells.size(), n_moments);
    // Of the ranks that own cells: these, three numbers each, and their positions.
    std::map<unsigned int, std::vector<int>>         questions;
    std::map<unsigned int, std::vector<std::size_t>> positions;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto [exponent, i, j] = cells[c];
        const int owner             = layout().owner_of_row(first_grid_row(cells[c]));
        if (owner == layout().rank())
          {
            answer(coefficient, cells[c], &answers(c, 0));
            continue;
          }
        std::vector<int> &question = questions[owner];
        question.insert(question.end(), {exponent, i, j});
        positions[owner].push_back(c);
      }
    std::map<unsigned int, std::vector<double>> replies;
    for (const auto &[asker, question] : some_to_some(layout().communicator(), questions))
      {
        std::vector<double> &reply = replies[asker];
        reply.resize(question.size() / 3 * n_moments);
        for (std::size_t q = 0; q < question.size() / 3; ++q)
          answer(coefficient,
                 {question[3 * q], question[3 * q + 1], question[3 * q + 2]},
                 &reply[q * n_moments]);
      }
    for (const auto &[owner, reply] : some_to_some(layout().communicator(), replies))
      for (std::size_t q = 0; q < positions[owner].size(); ++q)
        std::copy_n(&reply[q * n_moments], n_moments, &answers(positions[owner][q], 0));
    return answers;
  }
} // namespace strait
