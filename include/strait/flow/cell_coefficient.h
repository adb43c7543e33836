// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_cell_coefficient_h
#define strait_flow_cell_coefficient_h

#include <strait/flow/element_matrix.h>
#include <strait/flow/flow_mesh.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace strait
{
  /** The coefficient of a potential problem on the owned cells of a mesh, in the order of
   *  iteration: what the element matrices need to know of the gap. */
  class CellCoefficient
  {
  public:
    virtual ~CellCoefficient() = default;

    /** Take it from @p gap on all cells of the current mesh. Collective. */
    virtual void update(const GapField &gap) = 0;

    /** Its mean over a cell; zero where nothing flows. */
    virtual double mean(std::size_t cell) const = 0;

    /** A_ij = ∫ c ∇φ_i·∇φ_j of a cell. */
    virtual void stiffness(std::size_t                 cell,
                           dealii::FullMatrix<double> &matrix) const = 0;
  };

  /** On cells of the grid's quadtree, from the moments that the bridge knows. */
  class GridCoefficient : public CellCoefficient
  {
  public:
    GridCoefficient(const FlowMesh       &mesh,
                    const MomentSet      &set,
                    GapField::Coefficient coefficient);

    void   update(const GapField &gap) override;
    double mean(std::size_t cell) const override;
    void   stiffness(std::size_t cell, dealii::FullMatrix<double> &matrix) const override;

  private:
    const FlowMesh       &mesh;
    ElementMatrix         element;
    GapField::Coefficient coefficient;
    std::vector<GridCell> cells;
    CellAnswers           answers;
  };

  /** The same for potentials that are bilinear on the four children of a cell, in the
   *  order of FE_Q(2), which makes matrices of 9 × 9. */
  class ChildCoefficient : public CellCoefficient
  {
  public:
    ChildCoefficient(const FlowMesh &mesh, GapField::Coefficient coefficient);

    void   update(const GapField &gap) override;
    double mean(std::size_t cell) const override;
    void   stiffness(std::size_t cell, dealii::FullMatrix<double> &matrix) const override;

    /** The nodes at the corners of the children, deal.II's order throughout. */
    static constexpr std::array<std::array<unsigned int, 4>, 4> corners = {
      {{{0, 6, 4, 8}}, {{6, 1, 8, 5}}, {{4, 8, 2, 7}}, {{8, 5, 7, 3}}}};

  private:
    const FlowMesh       &mesh;
    ElementMatrix         element;
    GapField::Coefficient coefficient;
    std::vector<GridCell> cells;
    CellAnswers           answers; // of the children, four after four
  };

  /**
   * On the cells of a seal mesh, by Gauss quadrature of the gap in parts of at most one
   * grid spacing, and in cells that are smaller than four in quarters of one, enlarged by
   * what twice as large parts find otherwise. Along an edge there are at least
   * @p fewest_parts, a power of two.
   */
  class MappedCoefficient : public CellCoefficient
  {
  public:
    MappedCoefficient(const FlowMesh                 &mesh,
                      const dealii::FiniteElement<2> &fe,
                      GapField::Coefficient           coefficient,
                      int                             fewest_parts = 1);

    void   update(const GapField &gap) override;
    double mean(std::size_t cell) const override;
    void   stiffness(std::size_t cell, dealii::FullMatrix<double> &matrix) const override;

  private:
    using Cell = FlowMesh::Triangulation::active_cell_iterator;

    /** Shape functions at the points of a cell, those of n_parts × n_parts parts. */
    dealii::FEValues<2> &values_on(const Cell &cell, int n_parts);

    /** Find the lower half of the matrix of a cell. Returns the mean of the coefficient.
     */
    double integrate(const GapField            &gap,
                     const GapRows             &rows,
                     const dealii::FEValues<2> &at,
                     std::vector<double>       &sums) const;

    const FlowMesh                 &mesh;
    const dealii::MappingQ<2>       bilinear{1};
    const dealii::FiniteElement<2> &fe;
    GapField::Coefficient           coefficient;
    int                             fewest_parts;
    unsigned int                    n; // unknowns of a cell
    std::map<std::pair<int, bool>, std::unique_ptr<dealii::FEValues<2>>>
                        values; // by number of parts, and for curved cells
    std::vector<double> means;
    std::vector<double> entries; // of the lower halves of the matrices
  };

  /** The coefficient that fits the mesh. */
  std::unique_ptr<CellCoefficient> make_coefficient(const FlowMesh                 &mesh,
                                                    const MomentSet                &set,
                                                    const dealii::FiniteElement<2> &fe,
                                                    GapField::Coefficient coefficient);

  /** That for ChildCoefficient's potentials, which @p fe, FE_Q_iso_Q1(2), has as well. */
  std::unique_ptr<CellCoefficient>
  make_child_coefficient(const FlowMesh                 &mesh,
                         const dealii::FiniteElement<2> &fe,
                         GapField::Coefficient           coefficient);
} // namespace strait

#endif
