// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_rim_systems_h
#define strait_flow_rim_systems_h

#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <cstddef>
#include <vector>

namespace strait
{
  /** The nodes that a correction frees, as the owned cells see them. */
  struct CorrectionNodes
  {
    /** A node on the rim of a cell depends on this freed one. */
    struct Dependence
    {
      unsigned int node;
      unsigned int column; // position in the list of the cell's freed nodes
      double       weight;
    };

    /** The freed nodes of one coarse cell. */
    struct Cell
    {
      std::size_t  first_index      = 0;
      unsigned int n_indices        = 0;
      std::size_t  first_dependence = 0;
      unsigned int n_dependences    = 0;
      unsigned int at_reservoir     = 0; // bit f: face f is at inlet or outlet
      unsigned int at_wall          = 0; // likewise
    };

    std::vector<Cell>         cells;
    std::vector<unsigned int> indices; // positions in this rank's part of a vector
    std::vector<Dependence>   dependences;
  };

  /**
   * The equations of the freed nodes, kept cell by cell: of its nine
   * nodes the centre is eliminated and the rest, the rim, depends on at most a few freed
   * ones.
   */
  class RimSystems
  {
  public:
    using Matrix = std::array<std::array<double, 9>, 9>;
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    /** The nodes of a cell, in the order of FE_Q(2). */
    static constexpr unsigned int n_vertices = 4, n_rim = 8, centre = 8;

    explicit RimSystems(const CorrectionNodes &nodes);

    /**
     * Append the next cell, and add what it contributes to residual and diagonal. @p base
     * are the values before correction; a closed cell contributes nothing. The nodes of
     * @p fixed_faces, bit f for face f, are kept.
     */
    void append(const Matrix                &matrix,
                const std::array<double, 9> &base,
                bool                         closed,
                unsigned int                 fixed_faces,
                Vector                      &residual,
                Vector                      &diagonal);

    /** Steps of conjugate gradients with the diagonal as preconditioner. @p x has
     *  ghost entries and is zero, @p r the residual. Collective. */
    void conjugate_gradients(unsigned int  n_steps,
                             Vector       &x,
                             Vector       &r,
                             const Vector &diagonal) const;

  private:
    /** image += A x, for the cells of this rank. */
    void apply(const Vector &x, Vector &image) const;

    const CorrectionNodes   &nodes;
    std::vector<std::size_t> first_entry;
    std::vector<double>      entries;
  };
} // namespace strait

#endif
