// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/signals.h>
#include <strait/interface/gap_field.h>

#include <deal.II/base/mpi.h>

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
    , quadrature(fluid)
    , conductivity_of_one(1. / (12. * fluid.viscosity))
    , halvings(fluid.mesh_file.empty() ? layout->grid().n_halvings() : 0)
  {
    room_for(Coefficient::conductivity);
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
    levels.update(gap);
    forget_others();
    build(Coefficient::conductivity);
    if (floor_value > 0)
      build(Coefficient::resistivity);
    else
      known.erase(Coefficient::resistivity);
  }

  /** Those after conductivity and resistivity. */
  void
  GapField::forget_others() const
  {
    known.erase(known.upper_bound(Coefficient::resistivity), known.end());
  }

  GapField::Known &
  GapField::room_for(const Coefficient coefficient) const
  {
    if (known.count(coefficient) == 0)
      known.emplace(coefficient,
                    Known{MomentPyramid(levels.layout_pointer(), moment_set(), halvings),
                          {}});
    return known.at(coefficient);
  }

  void
  GapField::build(const Coefficient coefficient) const
  {
    Known     &result     = room_for(coefficient);
    const auto moments_of = [&](const LevelCell &cell, double *moments) {
      return add_cell(coefficient, cell, Square(), result, moments);
    };
    // A window's cells are made of those of the windows in it, which come after it.
    const auto &windows = levels.layout().windows();
    result.of_window_cells.assign(levels.n_window_points() * moment_set().size(), 0.);
    for (int w = static_cast<int>(windows.size()) - 1; w >= 0; --w)
      for (int iy = 1; iy < windows[w].n_rows() - 2; ++iy)
        for (int ix = 1; ix < windows[w].n_columns() - 2; ++ix)
          moments_of({w, ix, iy},
                     result.of_window_cells.data() +
                       levels.position({w, ix, iy}) * moment_set().size());
    const int first_row = levels.layout().first_row();
    result.pyramid.build([&](const int ix, const int row, double *moments) {
      return moments_of({-1, ix, first_row + row}, moments);
    });
  }

  bool
  GapField::add_cell(const Coefficient coefficient,
                     const LevelCell  &cell,
                     const Square     &square,
                     const Known      &of_grid,
                     double           *moments) const
  {
    const std::optional<LevelCell> first = levels.first_finer_cell(cell);
    if (!first)
      return quadrature.integrate(law(coefficient),
                                  levels.stencil(cell),
                                  square,
                                  moments);
    bool adds = false;
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a)
        {
          const LevelCell finer{first->window, first->ix + a, first->iy + b};
          const Square    part{3. * square.x0 - a, 3. * square.y0 - b, 3. * square.edge};
          const double    right = part.x0 + part.edge, upper = part.y0 + part.edge;
          if (part.x0 <= 0. && part.y0 <= 0. && right >= 1. && upper >= 1.)
            {
              moment_set().add_part(moments,
                                    of_grid.of_window_cells.data() +
                                      levels.position(finer) * moment_set().size(),
                                    -part.x0 / part.edge,
                                    -part.y0 / part.edge,
                                    1. / part.edge);
              adds = true;
            }
          else if (part.x0 < 1. && part.y0 < 1. && right > 0. && upper > 0.)
            adds |= add_cell(coefficient, finer, part, of_grid, moments);
        }
    return adds;
  }

  void
  GapField::answer(const Coefficient coefficient,
                   const GridCell   &cell,
                   double           *moments) const
  {
    const Known &of_grid = known.at(coefficient);
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
        std::copy_n(of_grid.pyramid.moments(cell), moment_set().size(), moments);
        return;
      }
    const int    shift = -cell.exponent;
    const int    ix = cell.i >> shift, iy = cell.j >> shift;
    const double edge = std::ldexp(1., -shift);
    add_cell(coefficient,
             {-1, ix, iy},
             {(cell.i - (ix << shift)) * edge, (cell.j - (iy << shift)) * edge, edge},
             of_grid,
             moments);
  }

  CellAnswers
  GapField::ask(const Coefficient coefficient, const std::vector<GridCell> &cells) const
  {
    interruption_point(); // once a mesh
    if (known.count(coefficient) == 0)
      {
        forget_others();
        build(coefficient);
      }
    namespace mpi = dealii::Utilities::MPI;
    using Words   = std::map<unsigned int, std::vector<int>>;
    using Numbers = std::map<unsigned int, std::vector<double>>;
    CellAnswers answers(moment_set().size(), cells.size());
    const auto  me = static_cast<unsigned int>(levels.layout().rank());

    Words                                            questions;
    std::map<unsigned int, std::vector<std::size_t>> asked_of;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto owner = static_cast<unsigned int>(
          levels.layout().owner_of_row(first_grid_row(cells[c])));
        if (owner == me)
          answer(coefficient, cells[c], answers[c]);
        else
          {
            questions[owner].insert(questions[owner].end(),
                                    {cells[c].exponent, cells[c].i, cells[c].j});
            asked_of[owner].push_back(c);
          }
      }
    if (levels.layout().n_ranks() == 1)
      return answers;

    const std::size_t n_moments = moment_set().size();
    Numbers           replies;
    for (const auto &[rank, words] :
         mpi::some_to_some(levels.layout().communicator(), questions))
      {
        std::vector<double> &reply = replies[rank];
        reply.resize(words.size() / 3 * n_moments);
        for (std::size_t q = 0; q < words.size() / 3; ++q)
          answer(coefficient,
                 GridCell{words[3 * q], words[3 * q + 1], words[3 * q + 2]},
                 reply.data() + q * n_moments);
      }
    for (const auto &[rank, reply] :
         mpi::some_to_some(levels.layout().communicator(), replies))
      for (std::size_t q = 0; q < asked_of[rank].size(); ++q)
        std::copy_n(reply.data() + q * n_moments, n_moments, answers[asked_of[rank][q]]);
    return answers;
  }
} // namespace strait
