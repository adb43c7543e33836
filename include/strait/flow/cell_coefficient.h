// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_cell_coefficient_h
#define strait_flow_cell_coefficient_h

#include <strait/flow/element_matrix.h>
#include <strait/flow/flow_mesh.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <map>
#include <memory>
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

  /** On the cells of the grid's quadtree, from the moments that the bridge knows. */
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

  /**
   * On the cells of a seal mesh, by Gauss quadrature of the gap at points that are no
   * farther from each other than those of the grid.
   */
  class MappedCoefficient : public CellCoefficient
  {
  public:
    MappedCoefficient(const FlowMesh                 &mesh,
                      const dealii::FiniteElement<2> &fe,
                      GapField::Coefficient           coefficient);

    void   update(const GapField &gap) override;
    double mean(std::size_t cell) const override;
    void   stiffness(std::size_t cell, dealii::FullMatrix<double> &matrix) const override;

  private:
    dealii::FEValues<2> &values_for(double size_in_spacings);

    const FlowMesh                                     &mesh;
    const dealii::FiniteElement<2>                     &fe;
    GapField::Coefficient                               coefficient;
    unsigned int                                        n;      // unknowns of a cell
    std::map<int, std::unique_ptr<dealii::FEValues<2>>> values; // by number of parts
    std::vector<double>                                 means;
    std::vector<double> entries; // of the lower halves of the matrices
  };

  /** The coefficient that fits the mesh. */
  std::unique_ptr<CellCoefficient> make_coefficient(const FlowMesh                 &mesh,
                                                    const MomentSet                &set,
                                                    const dealii::FiniteElement<2> &fe,
                                                    GapField::Coefficient coefficient);
} // namespace strait

#endif
