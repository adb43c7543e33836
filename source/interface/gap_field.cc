// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_field.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>

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

  GapField::GapField(SlabLayoutPtr layout, const FluidParameters &fluid)
    : levels(layout)
    , set(fluid.element_degree)
    , interpolant(fluid.interpolation, fluid.direction)
    , viscosity(fluid.viscosity)
    , rigorous(fluid.bounds == FlowBounds::rigorous)
    , halvings(fluid.mesh_file.empty() ? layout->grid().n_halvings() : 0)
    , conductivity{MomentPyramid(layout, set, halvings), {}}
  {
    const dealii::QGauss<1> gauss(fluid.element_degree + 1);
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        gauss_points.push_back(gauss.point(q)[0]);
        gauss_weights.push_back(gauss.weight(q));
      }
  }

  void
  GapField::update(const SlabField &gap, const double conductivity_floor)
  {
    floor_value = conductivity_floor;
    levels.update(gap);
    build(Coefficient::conductivity, conductivity);
    if (floor_value > 0)
      {
        if (!resistivity)
          resistivity.emplace(
            Known{MomentPyramid(gap.layout_pointer(), set, halvings), {}});
        build(Coefficient::resistivity, *resistivity);
      }
    else
      resistivity.reset();
  }

  void
  GapField::build(const Coefficient coefficient, Known &known) const
  {
    const auto moments_of = [&](const LevelCell &cell, double *moments) {
      return add_cell(coefficient, Quadrature::standard, cell, Square(), known, moments);
    };
    // A window's cells are made of those of the windows in it, which come after it.
    const auto &windows = levels.layout().windows();
    known.of_window_cells.assign(levels.n_window_points() * set.size(), 0.);
    for (int w = static_cast<int>(windows.size()) - 1; w >= 0; --w)
      for (int iy = 1; iy < windows[w].n_rows() - 2; ++iy)
        for (int ix = 1; ix < windows[w].n_columns() - 2; ++ix)
          moments_of({w, ix, iy},
                     known.of_window_cells.data() +
                       levels.position({w, ix, iy}) * set.size());
    const int first_row = levels.layout().first_row();
    known.pyramid.build([&](const int ix, const int row, double *moments) {
      return moments_of({-1, ix, first_row + row}, moments);
    });
  }

  double
  GapField::coefficient_of(const Coefficient coefficient, const double gap) const
  {
    const double k = conductivity_of(gap);
    return coefficient == Coefficient::conductivity ? k : 1. / std::max(k, floor_value);
  }

  void
  GapField::sample(const Coefficient coefficient,
                   const GapStencil &gap,
                   const double      x0,
                   const double      y0,
                   const double      width,
                   const double      height,
                   double           *values) const
  {
    const int n = static_cast<int>(gauss_points.size());
    if (rigorous)
      {
        const GapInterpolant::Range range = interpolant.range(gap, x0, y0, width, height);
        std::fill_n(values,
                    n * n,
                    coefficient_of(coefficient,
                                   coefficient == Coefficient::conductivity
                                     ? range.highest
                                     : range.lowest));
        return;
      }
    double x[GapInterpolant::max_points] = {}, y[GapInterpolant::max_points] = {};
    for (int q = 0; q < n; ++q)
      {
        x[q] = x0 + width * gauss_points[q];
        y[q] = y0 + height * gauss_points[q];
      }
    interpolant.evaluate(gap, n, x, y, values);
    for (int k = 0; k < n * n; ++k)
      values[k] = coefficient_of(coefficient, values[k]);
  }

  bool
  GapField::integrate(const Coefficient coefficient,
                      const Quadrature  quadrature,
                      const GapStencil &gap,
                      const Square     &square,
                      double           *moments) const
  {
    const bool open = GapInterpolant::may_be_open(gap);
    if (!open && coefficient == Coefficient::conductivity)
      return false;
    const bool   finer   = quadrature == Quadrature::finer && square.edge <= 1.;
    const int    n_parts = open ? (rigorous ? 4 : finer ? 2 : 1) : 1;
    const double part    = 1. / n_parts;
    // What the cell has of the square, and where that lies in the square.
    const double x0 = std::max(square.x0, 0.), y0 = std::max(square.y0, 0.);
    const double width       = std::min(square.x0 + square.edge, 1.) - x0;
    const double height      = std::min(square.y0 + square.edge, 1.) - y0;
    const double left        = (x0 - square.x0) / square.edge;
    const double lower       = (y0 - square.y0) / square.edge;
    const double part_width  = part * (width / square.edge);
    const double part_height = part * (height / square.edge);

    const int n = static_cast<int>(gauss_points.size());
    double    values[GapInterpolant::max_points * GapInterpolant::max_points];
    std::fill_n(values, n * n, coefficient_of(coefficient, 0.));
    for (int b = 0; b < n_parts; ++b)
      for (int a = 0; a < n_parts; ++a)
        {
          if (open)
            sample(coefficient,
                   gap,
                   x0 + width * part * a,
                   y0 + height * part * b,
                   width * part,
                   height * part,
                   values);
          for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
              set.add_point(moments,
                            left + part_width * (a + gauss_points[i]),
                            lower + part_height * (b + gauss_points[j]),
                            part_width * part_height * gauss_weights[i] *
                              gauss_weights[j] * values[j * n + i]);
        }
    return true;
  }

  bool
  GapField::add_cell(const Coefficient coefficient,
                     const Quadrature  quadrature,
                     const LevelCell  &cell,
                     const Square     &square,
                     const Known      &known,
                     double           *moments) const
  {
    const std::optional<LevelCell> first = levels.first_finer_cell(cell);
    if (!first)
      return integrate(coefficient, quadrature, levels.stencil(cell), square, moments);
    bool adds = false;
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a)
        {
          const LevelCell finer{first->window, first->ix + a, first->iy + b};
          const Square    part{3. * square.x0 - a, 3. * square.y0 - b, 3. * square.edge};
          const double    right = part.x0 + part.edge, upper = part.y0 + part.edge;
          if (part.x0 <= 0. && part.y0 <= 0. && right >= 1. && upper >= 1.)
            {
              set.add_part(moments,
                           known.of_window_cells.data() +
                             levels.position(finer) * set.size(),
                           -part.x0 / part.edge,
                           -part.y0 / part.edge,
                           1. / part.edge);
              adds = true;
            }
          else if (part.x0 < 1. && part.y0 < 1. && right > 0. && upper > 0.)
            adds |= add_cell(coefficient, quadrature, finer, part, known, moments);
        }
    return adds;
  }

  void
  GapField::answer(const Coefficient coefficient,
                   const Quadrature  quadrature,
                   const GridCell   &cell,
                   double           *moments) const
  {
    const Known &known =
      coefficient == Coefficient::conductivity ? conductivity : *resistivity;
    if (cell.exponent > 0)
      {
        std::copy_n(known.pyramid.moments(cell), set.size(), moments);
        return;
      }
    const int    shift = -cell.exponent;
    const int    ix = cell.i >> shift, iy = cell.j >> shift;
    const double edge = std::ldexp(1., -shift);
    add_cell(coefficient,
             quadrature,
             {-1, ix, iy},
             {(cell.i - (ix << shift)) * edge, (cell.j - (iy << shift)) * edge, edge},
             known,
             moments);
  }

  CellAnswers
  GapField::ask(const Coefficient            coefficient,
                const std::vector<GridCell> &cells,
                const Quadrature             quadrature) const
  {
    namespace mpi = dealii::Utilities::MPI;
    using Words   = std::map<unsigned int, std::vector<int>>;
    using Numbers = std::map<unsigned int, std::vector<double>>;
    CellAnswers answers(set.size(), cells.size());
    const auto  me = static_cast<unsigned int>(levels.layout().rank());

    Words                                            questions;
    std::map<unsigned int, std::vector<std::size_t>> asked_of;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto owner = static_cast<unsigned int>(
          levels.layout().owner_of_row(first_grid_row(cells[c])));
        if (owner == me)
          answer(coefficient, quadrature, cells[c], answers[c]);
        else
          {
            questions[owner].insert(questions[owner].end(),
                                    {cells[c].exponent, cells[c].i, cells[c].j});
            asked_of[owner].push_back(c);
          }
      }
    if (levels.layout().n_ranks() == 1)
      return answers;

    const std::size_t n_moments = set.size();
    Numbers           replies;
    for (const auto &[rank, words] :
         mpi::some_to_some(levels.layout().communicator(), questions))
      {
        std::vector<double> &reply = replies[rank];
        reply.resize(words.size() / 3 * n_moments);
        for (std::size_t q = 0; q < words.size() / 3; ++q)
          answer(coefficient,
                 quadrature,
                 GridCell{words[3 * q], words[3 * q + 1], words[3 * q + 2]},
                 reply.data() + q * n_moments);
      }
    for (const auto &[rank, reply] :
         mpi::some_to_some(levels.layout().communicator(), replies))
      for (std::size_t q = 0; q < asked_of[rank].size(); ++q)
        std::copy_n(reply.data() + q * n_moments, n_moments, answers[asked_of[rank][q]]);
    return answers;
  }

  std::size_t
  GapField::memory_consumption() const
  {
    std::size_t bytes = levels.memory_consumption();
    for (const Known *known : {&conductivity, resistivity ? &*resistivity : nullptr})
      if (known != nullptr)
        bytes += known->pyramid.memory_consumption() +
                 known->of_window_cells.capacity() * sizeof(double);
    return bytes;
  }
} // namespace strait
