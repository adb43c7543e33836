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
    // The nodes of FE_Q(2) at the corners of the children, deal.II's order throughout.
    constexpr unsigned int child_corners[4][4] = {{0, 6, 4, 8},
                                                  {6, 1, 8, 5},
                                                  {4, 8, 2, 7},
                                                  {8, 5, 7, 3}};

    /**
     * On cells of the grid's quadtree, from the moments that the bridge knows; potentials
     * are polynomials on each of the @p n_parts of a cell, itself or its four children.
     */
    class GridCoefficient : public CellCoefficient
    {
    public:
      GridCoefficient(const FlowMesh             &mesh_,
                      const MomentSet            &set,
                      const GapField::Coefficient coefficient_,
                      const unsigned int          n_parts_)
        : mesh(mesh_)
        , element(set)
        , coefficient(coefficient_)
        , n_parts(n_parts_)
      {
      }

      void
      update(const GapField &gap) override
      {
        // In spacings of its grid, which is that of the mesh or a coarser one.
        const int coarser = mesh.grid().n_halvings() - gap.layout().grid().n_halvings();
        cells.clear();
        for (const auto &cell : mesh.triangulation().active_cell_iterators())
          if (cell->is_locally_owned())
            {
              GridCell here = mesh.grid_cell(*cell);
              here.exponent -= coarser;
              if (n_parts == 1)
                cells.push_back(here);
              for (int child = 0; n_parts == 4 && child < 4; ++child)
                cells.push_back(here.child(child));
            }
        answers = gap.ask(coefficient, cells);
      }

      double
      mean(const std::size_t cell) const override
      {
        double sum = 0;
        for (unsigned int part = 0; part < n_parts; ++part)
          sum += answers[n_parts * cell + part][0];
        return sum / n_parts;
      }

      void
      stiffness(const std::size_t cell, FullMatrix<double> &matrix) const override
      {
        // Of cells and of children alike: it depends on the ratio of both only.
        const auto [width, height] = mesh.edges(cells.front());
        if (n_parts == 1)
          return element.stiffness(&answers(cell, 0), width, height, matrix);
        FullMatrix<double> small(4, 4);
        matrix = 0.;
        for (std::size_t child = 0; child < 4; ++child)
          {
            element.stiffness(&answers(4 * cell + child, 0), width, height, small);
            for (unsigned int i = 0; i < 4; ++i)
              for (unsigned int j = 0; j < 4; ++j)
                matrix(child_corners[child][i], child_corners[child][j]) += small(i, j);
          }
      }

    private:
      const FlowMesh       &mesh;
      ElementMatrix         element;
      GapField::Coefficient coefficient;
      unsigned int          n_parts; // of a cell: 1 or 4
      std::vector<GridCell> cells;   // or their children, four after four
      CellAnswers           answers;
    };

    /**
     * On the cells of a seal mesh, by Gauss quadrature of the gap in parts of at most one
     * grid spacing, and in cells that are smaller than four in quarters of one, enlarged
     * by what twice as large parts find otherwise.
     */
    class MappedCoefficient : public CellCoefficient
    {
    public:
      MappedCoefficient(const FlowMesh             &mesh_,
                        const FiniteElement<2>     &fe_,
                        const GapField::Coefficient coefficient_,
                        const unsigned int          degree_)
        : mesh(mesh_)
        , fe(fe_)
        , coefficient(coefficient_)
        , degree(degree_)
        , fewest_parts(static_cast<int>(fe.degree / degree))
        , n(fe.n_dofs_per_cell())
      {
      }

      void
      update(const GapField &gap) override
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
        const GapRows rows = gap.rows(low, high);
        means.clear();
        entries.clear();
        std::vector<double> sums;
        for (const auto &cell : tria.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              // Cells of fewer spacings are integrated more finely, as the bracket rests
              // on them. Half of it leaves more to the refinement, double of it costs
              // four times as much in cells that do not need it.
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
              means.push_back(mean);
              entries.insert(entries.end(), sums.begin(), sums.end());
            }
      }

      double
      mean(const std::size_t cell) const override
      {
        return means[cell];
      }

      void
      stiffness(const std::size_t cell, FullMatrix<double> &matrix) const override
      {
        const double *entry = entries.data() + cell * (n * (n + 1) / 2);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            matrix(i, j) = matrix(j, i) = *entry++;
      }

    private:
      using Cell = FlowMesh::Triangulation::active_cell_iterator;

      /** Shape functions at the points of a cell, those of n_parts × n_parts parts. */
      FEValues<2> &
      values_on(const Cell &cell, const int n_parts)
      {
        // Without a curved edge the map is bilinear, which costs less to say so.
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

      /** The mean of the coefficient in a cell; @p sums: lower half of its matrix. */
      double
      integrate(const GapField      &gap,
                const GapRows       &rows,
                const FEValues<2>   &at,
                std::vector<double> &sums) const
      {
        double area = 0., total = 0.;
        sums.assign(n * (n + 1) / 2, 0.);
        for (const unsigned int q : at.quadrature_point_indices())
          {
            const Point<2> &x = at.quadrature_point(q);
            const double    c =
              gap.coefficient_of(coefficient, rows(x[0], x[1])) * at.JxW(q);
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
      GapField::Coefficient   coefficient;
      unsigned int            degree;       // of a potential on each of these parts
      int                     fewest_parts; // of a cell along an edge, a power of two
      unsigned int            n;            // unknowns of a cell
      std::map<std::pair<int, bool>, std::unique_ptr<FEValues<2>>>
                          values; // by number of parts, and for curved cells
      std::vector<double> means;
      std::vector<double> entries; // of the lower halves of the matrices
    };
  } // namespace

  std::unique_ptr<CellCoefficient>
  make_coefficient(const FlowMesh             &mesh,
                   const MomentSet            &set,
                   const FiniteElement<2>     &fe,
                   const GapField::Coefficient coefficient)
  {
    if (mesh.seal() != nullptr)
      return std::make_unique<MappedCoefficient>(mesh, fe, coefficient, set.degree());
    const unsigned int n_parts = fe.degree > set.degree() ? 4 : 1;
    return std::make_unique<GridCoefficient>(mesh, set, coefficient, n_parts);
  }
} // namespace strait
