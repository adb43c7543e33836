// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/interface/cell_quadrature.h>
#include <strait/interface/gap_interpolant.h>
#include <strait/percolation/flow_region.h>
#include <strait/spectral/slab_field.h>

#include <deal.II/base/table.h>

#include <boost/functional/hash.hpp>

#include <array>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace strait
{
  /** The moments of a list of cells in its order, each in that of the MomentSet. */
  using CellAnswers = dealii::Table<2, double>;

  /**
   * The one bridge from slabs to cells: it keeps the gap with the grid's own ranks
   * and answers the mesh's ranks what a cell needs to know of it, whatever cell of
   * the quadtree over the grid that is. Refinement thus costs messages in
   * proportion to the cells, never to the grid.
   *
   * The coefficient is the conductivity K = g³/(12 η), or its reciprocal
   * 1/max(K, K_floor) for the lower bound. Of a rarefied gas K is that at the pressure
   * half way, and what its bounds need is made when it is asked for: its largest and
   * least values at any pressure, the least as the largest resistivity, and the two
   * parts into which it may be split (RarefiedFlow). Cells of at least four grid
   * spacings are looked up in a pyramid of moments, summed up from the cells of the grid,
   * on each of which K was integrated (CellQuadrature); smaller ones are integrated
   * directly. A cell belongs to the rank of its first grid row.
   *
   * Where the gap has windows of finer points a cell between points of which a window
   * covers all four is replaced by the 3 × 3 cells of the window that lie in it: the
   * outermost rows and columns of a window lie outside of all its cells, and the
   * interpolant needs them. Each cell of a window is integrated once.
   *
   * Where the fluid flows on a mesh of its own there are no such cells and no pyramid;
   * the mesh's ranks take the rows of the grid that they touch, as GapRows.
   */
  class GapField
  {
  public:
    /** What the moments are of. */
    enum class Coefficient
    {
      conductivity,
      resistivity,
      largest_conductivity,
      largest_resistivity,
      viscous_resistivity,
      molecular_resistivity
    };

    GapField(const SlabLayoutPtr &layout, const FluidParameters &fluid);

    /** What flows in the gaps from the next update() on; null: it is viscous. */
    void
    take_gas(std::shared_ptr<const RarefiedFlow> gas)
    {
      rarefied = std::move(gas);
    }

    /** The rarefied gas that flows; null: it is viscous. */
    const RarefiedFlow *
    gas() const
    {
      return rarefied.get();
    }

    /**
     * Take a new gap (percolating_gap()), on the same grid, whatever its windows;
     * @p conductivity_floor > 0 prepares the resistivity as well. Collective.
     */
    void update(const SlabField &gap, double conductivity_floor = 0.);

    /** Moments of a coefficient on @p cells; each rank may ask for others.
     *  Collective. */
    CellAnswers ask(Coefficient coefficient, const std::vector<GridCell> &cells) const;

    /** The gap for points with @p y_low <= y <= @p y_high; each rank may ask for others.
     *  Collective. */
    GapRows rows(double y_low, double y_high) const;

    /** Of one @p gap. */
    double
    coefficient_of(const Coefficient coefficient, const double gap) const
    {
      return law(coefficient)(gap);
    }

    const MomentSet &
    moment_set() const
    {
      return quadrature.moment_set();
    }

    const SlabLayout &
    layout() const
    {
      return *slab_layout;
    }

    /** Conductivity of a gap, g³/(12 η). */
    double
    conductivity_of(const double gap) const
    {
      return coefficient_of(Coefficient::conductivity, gap);
    }

    /** The gap of a @p conductivity that is not zero. */
    double gap_of(double conductivity) const;

    /** Give back the memory until the next update(). */
    void
    release()
    {
      grid_rows.rows = std::vector<double>();
      window_values  = std::vector<double>();
      known.clear();
    }

  private:
    /** The exponent of the smallest cells of the pyramid. Its moments are 5/12 · 8 B a
     *  grid point at degree 1; with cells of two spacings they would be four times as
     *  much, for few that are asked for. */
    static constexpr int finest = 2;

    /** What is known of one coefficient. */
    struct Known
    {
      std::vector<double>      of_window_cells; // at the position of each cell
      std::vector<CellAnswers> pyramid;         // of own cells, from the smallest up

      // For rigorous bounds, which are expensive: of own cells that are smaller, by
      // exponent, i and j, those that were asked for. Most cells of a mesh, or children
      // of them, are those of the next one.
      std::unordered_map<std::array<int, 3>,
                         std::vector<double>,
                         boost::hash<std::array<int, 3>>>
        small_cells;
    };

    /** Find the moments of @p coefficients on the grid and on the windows, looking at the
     *  gap once. Collective. */
    void build(const std::vector<Coefficient> &coefficients) const;

    /** The first row of cells with that @p exponent that this rank owns. */
    int first_own_row(int exponent) const;

    CoefficientLaw law(Coefficient coefficient) const;

    /** The gap around a cell of a window, or of the grid in a cell of the pyramid of this
     *  rank. Cells are named by their lower left points. */
    GapStencil stencil(const GridPoint &cell) const;

    /** Position of a point or cell of a window among those of all windows. */
    std::size_t position(const GridPoint &cell) const;

    /** Add to the @p integrals, of @p coefficients, over @p square what a cell that
     *  windows may replace has of it. */
    void add_cell(const std::vector<Coefficient> &coefficients,
                  const GridPoint                &cell,
                  const Square                   &square,
                  const std::vector<Integral>    &integrals) const;

    /** The same of a cell that this rank owns as the square. */
    void integrate(const std::vector<Coefficient> &coefficients,
                   const GridCell                 &cell,
                   const std::vector<Integral>    &integrals) const;

    /** Find the moments, zero so far, of a cell that this rank owns, from the pyramid as
     *  far as it is known, else from the gap. */
    void sum_up(Coefficient coefficient, const GridCell &cell, double *moments) const;

    /** The same, with small cells kept for the next time if that is worth it. */
    void answer(Coefficient coefficient, const GridCell &cell, double *moments) const;

    SlabLayoutPtr                       slab_layout;
    GapRows                             grid_rows; // the own ones and some around them
    std::vector<double>                 window_values;
    CellQuadrature                      quadrature;
    bool                                is_rigorous;
    double                              conductivity_of_one;
    double                              floor_value = 0.;
    int                                 halvings    = 0;
    std::shared_ptr<const RarefiedFlow> rarefied;
    // Of conductivity and resistivity, and of the last other one that was asked for since
    // the update().
    mutable std::map<Coefficient, Known> known;
  };
} // namespace strait
