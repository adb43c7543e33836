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
  /** Moments of a list of cells: a row for each cell, in the order of the list; columns
   *  in the order of the MomentSet. */
  using CellMoments = dealii::Table<2, double>;

  /**
   * The bridge between the slabs of the contact grid and the cells of the flow's mesh.
   * The gap stays with the ranks that own the rows of the grid; the ranks of the mesh ask
   * for the moments of the coefficient on any cells of the quadtree over the grid.
   * Refinement thus costs messages in proportion to the number of cells, never to the
   * size of the grid.
   *
   * The coefficient is the conductivity K = g³/(12 η) or, for the lower bound, its
   * reciprocal 1/max(K, K_floor); CoefficientLaw also limits K from above. For a rarefied
   * gas K is taken at the pressure half way between the reservoirs in Ψ. Its bounds need
   * further coefficients, which are computed when they are asked for: K with the largest
   * weight at any pressure, the resistivity with the least one, and the resistivities of
   * the viscous and of the molecular part of the flow (RarefiedFlow).
   *
   * Cells of at least four grid spacings are looked up in a pyramid of moments, which are
   * summed up from the cells of the grid, on each of which K was integrated
   * (CellQuadrature); smaller cells are integrated directly. A cell belongs to the rank
   * that owns its first grid row.
   *
   * A cell whose four corners a window covers is replaced by the 3 × 3 cells of the
   * window that lie in it. The outermost rows and columns of a window lie outside of all
   * such cells; the interpolant needs them. Each cell of a window is integrated as a
   * whole only once.
   *
   * On a seal mesh there are no such cells and no pyramid: the ranks of the mesh fetch
   * the rows of the grid that they touch, as GapRows.
   */
  class GapField
  {
  public:
    /** The coefficients whose moments can be asked for. */
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

    /** Set the rarefied gas of the next update() and later; null: viscous flow. */
    void
    take_gas(std::shared_ptr<const RarefiedFlow> gas)
    {
      rarefied = std::move(gas);
    }

    /** The rarefied gas that flows; null: the flow is viscous. */
    const RarefiedFlow *
    gas() const
    {
      return rarefied.get();
    }

    /** Take a new gap (percolating_gap()) on the same grid, with any windows. If
     *  @p conductivity_floor > 0 the resistivity is prepared as well. Collective. */
    void update(const SlabField &gap, double conductivity_floor = 0.);

    /** Return the moments of a coefficient on @p cells, which may differ between ranks.
     *  Collective. */
    CellMoments moments_on(Coefficient                  coefficient,
                           const std::vector<GridCell> &cells) const;

    /** Return the gap for points with @p y_low <= y <= @p y_high, a range that may differ
     *  between ranks. Collective. */
    GapRows rows(double y_low, double y_high) const;

    /** The value of a @p coefficient at one @p gap. */
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

    /** K at one @p gap: g³/(12 η), for a rarefied gas times its middle weight. */
    double
    conductivity_of(const double gap) const
    {
      return coefficient_of(Coefficient::conductivity, gap);
    }

    /** The gap whose conductivity is @p conductivity > 0. */
    double gap_of(double conductivity) const;

    /** Free the memory until the next update(). */
    void
    release()
    {
      grid_rows.rows = std::vector<double>();
      window_values  = std::vector<double>();
      known.clear();
    }

  private:
    /** The exponent of the smallest cells of the pyramid. Their moments take 5/12 · 8 B
     *  per grid point at degree 1. If it began with cells of two spacings they would take
     *  four times as much, although few such cells are asked for. */
    static constexpr int finest = 2;

    /** The moments of one coefficient that are known. */
    struct CoefficientCache
    {
      std::vector<double>      of_window_cells; // n_moments each, by position()
      std::vector<CellMoments> pyramid;         // of own cells, smallest first

      // For rigorous bounds, which are expensive: the moments of smaller own cells that
      // were asked for, by exponent, i and j. Most of them are asked for again for the
      // next mesh.
      std::unordered_map<std::array<int, 3>,
                         std::vector<double>,
                         boost::hash<std::array<int, 3>>>
        small_cells;
    };

    /** Compute the moments of @p coefficients on the grid and in the windows, evaluating
     *  the gap once for all of them. Collective. */
    void build(const std::vector<Coefficient> &coefficients) const;

    /** The first row of cells of size 2^exponent that this rank owns. */
    int first_own_row(int exponent) const;

    CoefficientLaw law(Coefficient coefficient) const;

    /** The gap around a cell of a window, or around a grid cell that lies in a pyramid
     *  cell of this rank. Cells are named by their lower left points. */
    GapStencil stencil(const GridPoint &cell) const;

    /** Position of a point or cell of a window among those of all windows. */
    std::size_t position(const GridPoint &cell) const;

    /** Add the contribution of a cell, or of the finer ones by which a window replaces
     *  it, to the @p integrals of @p coefficients over @p square. */
    void add_cell(const std::vector<Coefficient> &coefficients,
                  const GridPoint                &cell,
                  const Square                   &square,
                  const std::vector<Integral>    &integrals) const;

    /** Add the integrals over @p cell, which this rank owns, to @p integrals. */
    void integrate(const std::vector<Coefficient> &coefficients,
                   const GridCell                 &cell,
                   const std::vector<Integral>    &integrals) const;

    /** Compute the moments, zero on entry, of a cell that this rank owns: from the
     *  pyramid where it is known, else from the gap. */
    void sum_up(Coefficient coefficient, const GridCell &cell, double *moments) const;

    /** The same, but for rigorous bounds small cells are kept for the next time. */
    void
    moments_of_own(Coefficient coefficient, const GridCell &cell, double *moments) const;

    SlabLayoutPtr                       slab_layout;
    GapRows                             grid_rows; // own rows and some around them
    std::vector<double>                 window_values;
    CellQuadrature                      quadrature;
    bool                                is_rigorous;
    double                              unit_gap_conductivity;
    double                              floor_value = 0.;
    int                                 halvings    = 0;
    std::shared_ptr<const RarefiedFlow> rarefied;
    // The moments of conductivity and resistivity, and of the other coefficients those of
    // the last one that was asked for since the update().
    mutable std::map<Coefficient, CoefficientCache> known;
  };
} // namespace strait
