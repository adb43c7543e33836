// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_cell_coefficient_h
#define strait_flow_cell_coefficient_h

#include <strait/flow/flow_mesh.h>

#include <deal.II/fe/fe.h>
#include <deal.II/lac/full_matrix.h>

#include <cstddef>
#include <memory>

namespace strait
{
  /** The coefficient of a potential problem on the owned cells of a mesh, in the order of
   *  iteration: what the element matrices need to know of the gap. */
  class CellCoefficient
  {
  public:
    virtual ~CellCoefficient() = default;

    /** Take it from @p gap, on the grid of the mesh or one with half, a quarter … of its
     * points each way, on all cells of the current mesh. Collective. */
    virtual void update(const GapField &gap) = 0;

    /** Its mean over a cell; zero where nothing flows. */
    virtual double mean(std::size_t cell) const = 0;

    /** A_ij = ∫ c ∇φ_i·∇φ_j of a cell. */
    virtual void stiffness(std::size_t                 cell,
                           dealii::FullMatrix<double> &matrix) const = 0;
  };

  /**
   * The coefficient on the cells of @p mesh: of the box, exactly; of a seal mesh, by
   * quadrature. The potentials are those of @p fe: FE_Q of the degree of @p set, or
   * FE_Q_iso_Q1(2) with the set of degree 1, bilinear on the four children of a cell.
   */
  std::unique_ptr<CellCoefficient> make_coefficient(const FlowMesh                 &mesh,
                                                    const MomentSet                &set,
                                                    const dealii::FiniteElement<2> &fe,
                                                    GapField::Coefficient coefficient);
} // namespace strait

#endif
