// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/element_matrix.h>
#include <strait/flow/potential_problem.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace strait
{
  using namespace dealii;

  namespace
  {
    // The nodes of FE_Q(2) at the corners of each child, all in deal.II's order.
    constexpr unsigned int child_corners[4][4] = {{0, 6, 4, 8},
                                                  {6, 1, 8, 5},
                                                  {4, 8, 2, 7},
                                                  {8, 5, 7, 3}};

    /**
     * Take the coefficient on cells of the grid's quadtree, from the moments of @p gap.
     * Potentials are polynomials on each part of a cell: itself or its four children.
     */
    CellCoefficient
    take_on_grid(const FlowMesh             &mesh,
                 const unsigned int          degree,
                 const FiniteElement<2>     &fe,
                 const GapField::Coefficient kind,
                 const GapField             &gap)
    {
      const bool is_parted = fe.degree > degree;
      // Cells in spacings of the gap's grid, which is that of the mesh or a coarser one.
      const int coarser = mesh.grid().n_halvings() - gap.layout().grid().n_halvings();
      std::vector<GridCell> parts; // cell after cell
      for (const auto &cell : mesh.triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            GridCell here = mesh.grid_cell(*cell);
            here.exponent -= coarser;
            if (is_parted)
              for (int child = 0; child < 4; ++child)
                parts.push_back(here.child(child));
            else
              parts.push_back(here);
          }
      const CellMoments answers = gap.moments_on(kind, parts);

      CellCoefficient     result;
      const ElementMatrix element{MomentSet(degree)};
      FullMatrix<double>  matrix(fe.n_dofs_per_cell()), small(4);
      const std::size_t   n_parts = is_parted ? 4 : 1;
      result.means.reserve(parts.size() / n_parts);
      result.entries.reserve(parts.size() / n_parts *
                             (matrix.m() * (matrix.m() + 1) / 2));
      for (std::size_t part = 0; part < parts.size(); part += n_parts)
        {
          // Those of one part serve for all: only their ratio matters.
          const auto [width, height] = mesh.edges(parts.front());
          double sum                 = 0.;
          for (std::size_t k = 0; k < n_parts; ++k)
            sum += answers[part + k][0];
          if (is_parted)
            {
              matrix = 0.;
              for (std::size_t child = 0; child < 4; ++child)
                {
                  const auto &corners = child_corners[child];
                  element.stiffness(&answers(part + child, 0), width, height, small);
                  for (unsigned int i = 0; i < 4; ++i)
                    for (unsigned int j = 0; j < 4; ++j)
                      matrix(corners[i], corners[j]) += small(i, j);
                }
            }
          else
            element.stiffness(&answers(part, 0), width, height, matrix);
          result.means.push_back(sum / static_cast<double>(n_parts));
          for (unsigned int i = 0; i < matrix.m(); ++i)
            result.entries.insert(result.entries.end(),
                                  &matrix(i, 0),
                                  &matrix(i, 0) + i + 1);
        }
      return result;
    }

    /**
     * The coefficient on the cells of a seal mesh, by Gauss quadrature of the gap in
     * parts of at most one grid spacing. In cells smaller than four spacings, parts are
     * at most a quarter of one, and the change from parts twice as large is added.
     */
    class SealCells
    {
    public:
      SealCells(const FlowMesh             &mesh_,
                const FiniteElement<2>     &fe_,
                const GapField::Coefficient kind_,
                const unsigned int          degree_)
        : mesh(mesh_)
        , fe(fe_)
        , kind(kind_)
        , degree(degree_)
      {
      }

      /** Take it on all cells from @p gap. */
      CellCoefficient
      take(const GapField &gap)
      {
        const auto &tria = mesh.triangulation();
        double      low = std::numeric_limits<double>::infinity(), high = -low;
        for (const auto &cell : tria.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const auto box = mesh.mapping().get_bounding_box(cell);
              low            = std::min(low, box.lower_bound(1));
              high           = std::max(high, box.upper_bound(1));
            }
        const GapRows       rows         = gap.rows(low, high);
        const auto          fewest_parts = static_cast<int>(fe.degree / degree);
        CellCoefficient     result;
        std::vector<double> sums;
        for (const auto &cell : tria.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              // Cells of fewer spacings are integrated more finely, as the bracket rests
              // on them. Half of it leaves more to the refinement; double of it makes
              // cells that do not need it four times as expensive.
              constexpr double small   = 4.;
              const double     size    = mesh.size_in_spacings(*cell);
              int              n_parts = fewest_parts;
              while (n_parts < (size < small ? 2. * size : size))
                n_parts *= 2; // about one for each grid spacing along a side
              double mean = integrate(gap, rows, values_on(cell, n_parts), sums);
              if (size < small)
                {
                  const double coarser = mean;
                  mean = integrate(gap, rows, values_on(cell, 2 * n_parts), sums);
                  const double factor =
                    mean > 0 ? 1. + std::abs(mean - coarser) / mean : 1.;
                  for (double &entry : sums)
                    entry *= factor;
                }
              result.means.push_back(mean);
              result.entries.insert(result.entries.end(), sums.begin(), sums.end());
            }
        return result;
      }

    private:
      using Cell = FlowMesh::Triangulation::active_cell_iterator;

      /** Shape functions at the quadrature points of the n_parts × n_parts parts. */
      FEValues<2> &
      values_on(const Cell &cell, const int n_parts)
      {
        // Without a curved edge the mapping is bilinear; saying so costs less.
        bool is_curved = false;
        for (const unsigned int f : cell->face_indices())
          is_curved =
            is_curved || cell->face(f)->manifold_id() != numbers::flat_manifold_id;
        std::unique_ptr<FEValues<2>> &entry = values[{n_parts, is_curved}];
        if (!entry)
          entry = std::make_unique<FEValues<2>>(
            is_curved ? mesh.mapping() : static_cast<const Mapping<2> &>(bilinear),
            fe,
            QIterated<2>(QGauss<1>(degree + 1), n_parts),
            update_quadrature_points | update_gradients | update_JxW_values);
        entry->reinit(cell);
        return *entry;
      }

      /** Return the mean of the coefficient in a cell; @p sums: lower half of A. */
      double
      integrate(const GapField      &gap,
                const GapRows       &rows,
                const FEValues<2>   &at,
                std::vector<double> &sums) const
      {
        const unsigned int n    = fe.n_dofs_per_cell();
        double             area = 0., total = 0.;
        sums.assign(n * (n + 1) / 2, 0.);
        for (const unsigned int q : at.quadrature_point_indices())
          {
            const Point<2> &x = at.quadrature_point(q);
            const double    c = gap.coefficient_of(kind, rows(x[0], x[1])) * at.JxW(q);
            area += at.JxW(q);
            total += c;
            if (!(c > 0))
              continue;
            double *entry = sums.data();
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j <= i; ++j)
                *entry++ += c * (at.shape_grad(i, q) * at.shape_grad(j, q));
          }
        return total / area;
      }

      const FlowMesh         &mesh;
      const MappingQ<2>       bilinear{1};
      const FiniteElement<2> &fe;
      GapField::Coefficient   kind;
      unsigned int            degree; // of a potential on each part
      std::map<std::pair<int, bool>, std::unique_ptr<FEValues<2>>>
        values; // by number of parts, and whether curved
    };
  } // namespace

  CellCoefficient
  coefficient_on_cells(const FlowMesh             &mesh,
                       const unsigned int          degree,
                       const FiniteElement<2>     &fe,
                       const GapField::Coefficient kind,
                       const GapField             &gap)
  {
    return mesh.seal() == nullptr ? take_on_grid(mesh, degree, fe, kind, gap)
                                  : SealCells(mesh, fe, kind, degree).take(gap);
  }

  void
  CellCoefficient::stiffness(const std::size_t cell, FullMatrix<double> &matrix) const
  {
    const double *entry = entries.data() + cell * (matrix.m() * (matrix.m() + 1) / 2);
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (unsigned int j = 0; j <= i; ++j)
        matrix(i, j) = matrix(j, i) = *entry++;
  }
} // namespace strait
