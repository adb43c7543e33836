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

  void
  GapField::build(const std::vector<Coefficient> &coefficients) const
  {
    const std::size_t     n_moments = moment_set().size();
    std::vector<Integral> integrals;
    for (const Coefficient coefficient : coefficients)
      {
        known[coefficient].of_window_cells.resize(window_values.size() * n_moments);
        integrals.push_back({law(coefficient), nullptr});
      }
    // A window's cells are made of those of the windows inside it, which come later in
    // the list and are therefore integrated first.
    const auto &windows = layout().windows();
    for (int w = static_cast<int>(windows.size()) - 1; w >= 0; --w)
      for (int iy = 1; iy < windows[w].n_rows() - 2; ++iy)
        for (int ix = 1; ix < windows[w].n_columns() - 2; ++ix)
          {
            for (std::size_t k = 0; k < coefficients.size(); ++k)
              integrals[k].moments =
                &known[coefficients[k]]
                   .of_window_cells[position({ix, iy, w}) * n_moments];
            add_cell(coefficients, {ix, iy, w}, Square(), integrals);
          }
    for (int exponent = finest; exponent <= halvings; ++exponent)
      {
        std::vector<GridCell> cells;
        const int             end = layout().first_row() + layout().n_rows();
        for (int j = first_own_row(exponent); j << exponent < end; ++j)
          for (int i = 0; i < layout().grid().nx >> exponent; ++i)
            cells.push_back({exponent, i, j});
        std::vector<CellMoments> moments(coefficients.size(),
                                         CellMoments(cells.size(), n_moments));
        if (exponent == finest)
          for (std::size_t c = 0; c < cells.size(); ++c)
            {
              for (std::size_t k = 0; k < coefficients.size(); ++k)
                integrals[k].moments = &moments[k](c, 0);
              integrate(coefficients, cells[c], integrals);
            }
        else
          {
            std::vector<GridCell> children;
            for (const GridCell &cell : cells)
              for (const int number : {0, 1, 2, 3})
                children.push_back(cell.child(number));
            for (std::size_t k = 0; k < coefficients.size(); ++k)
              {
                const CellMoments of_children = moments_on(coefficients[k], children);
                for (std::size_t c = 0; c < children.size(); ++c)
                  moment_set().add_child(&moments[k](c / 4, 0),
                                         &of_children(c, 0),
                                         c % 4);
              }
          }
        for (std::size_t k = 0; k < coefficients.size(); ++k)
          known[coefficients[k]].pyramid.push_back(std::move(moments[k]));
      }
  }

  int
  GapField::first_own_row(const int exponent) const
  {
    return (layout().first_row() + (1 << exponent) - 1) >> exponent;
  }

  void
  GapField::add_cell(const std::vector<Coefficient> &coefficients,
                     const GridPoint                &cell,
                     const Square                   &square,
                     const std::vector<Integral>    &integrals) const
  {
    // The lower left one of the 3 × 3 cells of a window that may replace this cell.
    const std::optional<GridPoint> first = layout().finer(cell);
    if (!first || first->ix + 2 == layout().windows()[first->window].n_columns() ||
        first->iy + 2 == layout().windows()[first->window].n_rows())
      return quadrature.integrate(stencil(cell), square, integrals);
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a)
        {
          const GridPoint finer{first->ix + a, first->iy + b, first->window};
          const Square    part{3. * square.x0 - a, 3. * square.y0 - b, 3. * square.edge};
          const double    right = part.x0 + part.edge, upper = part.y0 + part.edge;
          if (part.x0 <= 0. && part.y0 <= 0. && right >= 1. && upper >= 1.)
            for (std::size_t k = 0; k < coefficients.size(); ++k)
              moment_set().add_part(integrals[k].moments,
                                    known.at(coefficients[k]).of_window_cells.data() +
                                      position(finer) * moment_set().size(),
                                    -part.x0 / part.edge,
                                    -part.y0 / part.edge,
                                    1. / part.edge);
          else if (part.x0 < 1. && part.y0 < 1. && right > 0. && upper > 0.)
            add_cell(coefficients, finer, part, integrals);
        }
  }

  void
  GapField::sum_up(const Coefficient coefficient,
                   const GridCell   &cell,
                   double           *moments) const
  {
    const std::vector<CellMoments> &pyramid = known.at(coefficient).pyramid;
    if (const int level = cell.exponent - finest;
        level >= 0 && level < static_cast<int>(pyramid.size()))
      {
        const std::size_t row       = cell.j - first_own_row(cell.exponent);
        const std::size_t n_columns = layout().grid().nx >> cell.exponent;
        std::copy_n(&pyramid[level](row * n_columns + cell.i, 0),
                    moment_set().size(),
                    moments);
        return;
      }
    integrate({coefficient}, cell, {{law(coefficient), moments}});
  }

  void
  GapField::integrate(const std::vector<Coefficient> &coefficients,
                      const GridCell                 &cell,
                      const std::vector<Integral>    &integrals) const
  {
    if (cell.exponent > 0)
      {
        const int n = 1 << cell.exponent;
        for (int b = 0; b < n; ++b)
          for (int a = 0; a < n; ++a)
            add_cell(coefficients,
                     {cell.i * n + a, cell.j * n + b},
                     {-1. * a, -1. * b, 1. * n},
                     integrals);
        return;
      }
    const int    shift = -cell.exponent;
    const int    ix = cell.i >> shift, iy = cell.j >> shift;
    const double edge = std::ldexp(1., -shift);
    add_cell(coefficients,
             {ix, iy},
             {(cell.i - (ix << shift)) * edge, (cell.j - (iy << shift)) * edge, edge},
             integrals);
  }

  void
  GapField::moments_of_own(const Coefficient coefficient,
                           const GridCell   &cell,
                           double           *moments) const
  {
    if (cell.exponent >= finest || !is_rigorous)
      {
        sum_up(coefficient, cell, moments);
        return;
      }
    std::vector<double> &found =
      known.at(coefficient).small_cells[{{cell.exponent, cell.i, cell.j}}];
    if (found.empty())
      {
        found.resize(moment_set().size());
        sum_up(coefficient, cell, found.data());
      }
    std::copy(found.begin(), found.end(), moments);
  }

  CellMoments
  GapField::moments_on(const Coefficient            coefficient,
                       const std::vector<GridCell> &cells) const
  {
    interruption_point(); // at least once per mesh
    if (known.count(coefficient) == 0)
      {
        // Forget all but conductivity and resistivity, which come first.
        known.erase(known.upper_bound(Coefficient::resistivity), known.end());
        build({coefficient});
      }
    using dealii::Utilities::MPI::some_to_some;
    const std::size_t n_moments = moment_set().size();
    CellMoments       answers(cells.size(), n_moments);
    // For each rank that owns cells: these cells, three numbers each, and their positions
    // in the list.
    std::map<unsigned int, std::vector<int>>         questions;
    std::map<unsigned int, std::vector<std::size_t>> positions;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto [exponent, i, j] = cells[c];
        const int owner             = layout().owner_of_row(first_grid_row(cells[c]));
        if (owner == layout().rank())
          {
            moments_of_own(coefficient, cells[c], &answers(c, 0));
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
          moments_of_own(coefficient,
                         {question[3 * q], question[3 * q + 1], question[3 * q + 2]},
                         &reply[q * n_moments]);
      }
    for (const auto &[owner, reply] : some_to_some(layout().communicator(), replies))
      for (std::size_t q = 0; q < positions[owner].size(); ++q)
        std::copy_n(&reply[q * n_moments], n_moments, &answers(positions[owner][q], 0));
    return answers;
  }
} // namespace strait
