// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/gap_field.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <map>

namespace strait
{
  namespace
  {
    constexpr unsigned char open_flag = 1, closed_flag = 2;

    /** The grid row that decides which rank owns a cell. */
    int
    first_grid_row(const GridCell &cell)
    {
      return cell.exponent >= 0 ? cell.j << cell.exponent : cell.j >> -cell.exponent;
    }
  } // namespace

  GapField::GapField(SlabLayoutPtr layout, const FluidParameters &fluid)
    : slab_layout(std::move(layout))
    , set(fluid.element_degree)
    , interpolant(fluid.interpolation, fluid.direction)
    , viscosity(fluid.viscosity)
    , rigorous(fluid.bounds == FlowBounds::rigorous)
    , halvings(fluid.mesh_file.empty() ? slab_layout->grid().n_halvings() : 0)
    , conductivity(slab_layout, set, halvings)
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
    std::vector<int> rows;
    const int        begin = slab_layout->first_row(), n_rows = slab_layout->n_rows();
    if (n_rows > 0)
      for (int row = begin - 1; row < begin + n_rows + 2; ++row)
        rows.push_back(row);
    gap_rows = fetch_rows(gap, rows);

    conductivity.build([this](const int ix, const int row, double *moments) {
      return integrate(Coefficient::conductivity,
                       Quadrature::standard,
                       stencil(ix, row),
                       0.,
                       0.,
                       1.,
                       moments);
    });
    if (floor_value > 0)
      {
        if (!resistivity)
          resistivity.emplace(slab_layout, set, halvings);
        resistivity->build([this](const int ix, const int row, double *moments) {
          integrate(Coefficient::resistivity,
                    Quadrature::standard,
                    stencil(ix, row),
                    0.,
                    0.,
                    1.,
                    moments);
          return open_flag;
        });
      }
    else
      resistivity.reset();
  }

  double
  GapField::coefficient_of(const Coefficient coefficient, const double gap) const
  {
    const double k = conductivity_of(gap);
    return coefficient == Coefficient::conductivity ? k : 1. / std::max(k, floor_value);
  }

  GapStencil
  GapField::stencil(const int ix, const int row) const
  {
    const int  nx = slab_layout->grid().nx;
    GapStencil gap;
    for (int b = 0; b < 4; ++b)
      {
        const double *line = gap_rows.data() + static_cast<std::size_t>(row + b) * nx;
        for (int a = 0; a < 4; ++a)
          gap[b][a] = line[(ix + a - 1 + nx) % nx];
      }
    return gap;
  }

  void
  GapField::sample(const Coefficient coefficient,
                   const GapStencil &gap,
                   const double      x0,
                   const double      y0,
                   const double      edge,
                   double           *values) const
  {
    const int n = static_cast<int>(gauss_points.size());
    if (rigorous)
      {
        const GapInterpolant::Range range = interpolant.range(gap, x0, y0, edge);
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
        x[q] = x0 + edge * gauss_points[q];
        y[q] = y0 + edge * gauss_points[q];
      }
    interpolant.evaluate(gap, n, x, y, values);
    for (int k = 0; k < n * n; ++k)
      values[k] = coefficient_of(coefficient, values[k]);
  }

  unsigned char
  GapField::integrate(const Coefficient coefficient,
                      const Quadrature  quadrature,
                      const GapStencil &gap,
                      const double      x0,
                      const double      y0,
                      const double      edge,
                      double           *moments) const
  {
    const bool open = GapInterpolant::may_be_open(gap);
    if (!open && coefficient == Coefficient::conductivity)
      return closed_flag;
    const int    n       = static_cast<int>(gauss_points.size());
    const int    refined = quadrature == Quadrature::finer ? 2 : 1;
    const int    n_parts = open ? (rigorous ? 4 : refined) : 1;
    const double part    = 1. / n_parts;
    double       values[GapInterpolant::max_points * GapInterpolant::max_points];
    std::fill_n(values, n * n, coefficient_of(coefficient, 0.));
    for (int b = 0; b < n_parts; ++b)
      for (int a = 0; a < n_parts; ++a)
        {
          if (open)
            sample(coefficient,
                   gap,
                   x0 + edge * part * a,
                   y0 + edge * part * b,
                   edge * part,
                   values);
          for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
              set.add_point(moments,
                            part * (a + gauss_points[i]),
                            part * (b + gauss_points[j]),
                            part * part * gauss_weights[i] * gauss_weights[j] *
                              values[j * n + i]);
        }
    const bool all_open =
      gap[1][1] > 0 && gap[1][2] > 0 && gap[2][1] > 0 && gap[2][2] > 0;
    return (open ? open_flag : 0U) | (all_open ? 0U : closed_flag);
  }

  void
  GapField::answer(const Coefficient coefficient,
                   const Quadrature  quadrature,
                   const GridCell   &cell,
                   double           *entry) const
  {
    if (cell.exponent > 0)
      {
        const MomentPyramid &pyramid =
          coefficient == Coefficient::conductivity ? conductivity : *resistivity;
        std::copy_n(pyramid.moments(cell), set.size(), entry);
        entry[set.size()] = pyramid.flags(cell);
        return;
      }
    const int    shift = -cell.exponent;
    const int    ix = cell.i >> shift, iy = cell.j >> shift;
    const double edge = std::ldexp(1., -shift);
    std::fill_n(entry, set.size(), 0.);
    entry[set.size()] = integrate(coefficient,
                                  quadrature,
                                  stencil(ix, iy - slab_layout->first_row()),
                                  (cell.i - (ix << shift)) * edge,
                                  (cell.j - (iy << shift)) * edge,
                                  edge,
                                  entry);
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
    const auto  me = static_cast<unsigned int>(slab_layout->rank());

    Words                                            questions;
    std::map<unsigned int, std::vector<std::size_t>> asked_of;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto owner =
          static_cast<unsigned int>(slab_layout->owner_of_row(first_grid_row(cells[c])));
        if (owner == me)
          answer(coefficient, quadrature, cells[c], answers.entry(c));
        else
          {
            questions[owner].insert(questions[owner].end(),
                                    {cells[c].exponent, cells[c].i, cells[c].j});
            asked_of[owner].push_back(c);
          }
      }
    if (slab_layout->n_ranks() == 1)
      return answers;

    const std::size_t n_entry = set.size() + 1;
    Numbers           replies;
    for (const auto &[rank, words] :
         mpi::some_to_some(slab_layout->communicator(), questions))
      {
        std::vector<double> &reply = replies[rank];
        reply.resize(words.size() / 3 * n_entry);
        for (std::size_t q = 0; q < words.size() / 3; ++q)
          answer(coefficient,
                 quadrature,
                 GridCell{words[3 * q], words[3 * q + 1], words[3 * q + 2]},
                 reply.data() + q * n_entry);
      }
    for (const auto &[rank, reply] :
         mpi::some_to_some(slab_layout->communicator(), replies))
      for (std::size_t q = 0; q < asked_of[rank].size(); ++q)
        std::copy_n(reply.data() + q * n_entry,
                    n_entry,
                    answers.entry(asked_of[rank][q]));
    return answers;
  }

  GapWindow
  GapField::window(const double y_low, const double y_high) const
  {
    const double     dy = slab_layout->grid().dy();
    const int        ny = slab_layout->grid().ny, nx = slab_layout->grid().nx;
    int              first = 0;
    std::vector<int> wanted;
    if (y_low <= y_high) // else this rank has no cells
      {
        first = std::clamp(static_cast<int>(y_low / dy), 0, ny - 1) - 1;
        for (int row = first; row <= std::min(static_cast<int>(y_high / dy), ny - 1) + 2;
             ++row)
          wanted.push_back(row);
      }
    // The rows of this rank follow the one before them.
    return {slab_layout->grid(),
            interpolant,
            first,
            fetch_rows(
              *slab_layout, gap_rows.data() + (gap_rows.empty() ? 0 : nx), nx, wanted)};
  }

  std::size_t
  GapField::memory_consumption() const
  {
    return gap_rows.capacity() * sizeof(double) + conductivity.memory_consumption() +
           (resistivity ? resistivity->memory_consumption() : 0);
  }
} // namespace strait
