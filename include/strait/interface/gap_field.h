// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_interface_gap_field_h
#define strait_interface_gap_field_h

#include <strait/base/fluid_parameters.h>
#include <strait/interface/gap_interpolant.h>
#include <strait/interface/moment_pyramid.h>
#include <strait/interface/moment_set.h>
#include <strait/spectral/slab_field.h>

#include <optional>
#include <vector>

namespace strait
{
  /** What the flow solver asks about one cell. */
  struct CellAnswer
  {
    const double *moments = nullptr; // MomentSet order, of the coefficient asked for
    bool          open    = false;   // the fluid enters some of it …
    bool          closed  = false;   // … and not all of it
  };

  /** The answers to a list of cells, in its order. */
  class CellAnswers
  {
  public:
    CellAnswers(const int n_moments_, const std::size_t n_cells)
      : n_moments(n_moments_)
      , values(n_cells * (n_moments_ + 1))
    {
    }

    CellAnswer
    operator[](const std::size_t cell) const
    {
      const double *entry = values.data() + cell * (n_moments + 1);
      const int     flags = static_cast<int>(entry[n_moments]);
      return {entry, (flags & 1) != 0, (flags & 2) != 0};
    }

    /** The raw entry of a cell, moments first, then its flags. */
    double *
    entry(const std::size_t cell)
    {
      return values.data() + cell * (n_moments + 1);
    }

  private:
    int                 n_moments;
    std::vector<double> values;
  };

  /**
   * The one bridge from slabs to cells: it keeps the gap with the grid's own ranks
   * and answers the mesh's ranks what a cell needs to know of it, whatever cell of
   * the quadtree over the grid that is. Refinement thus costs messages in
   * proportion to the cells, never to the grid.
   *
   * The coefficient is the conductivity K = g³/(12 η), or its reciprocal
   * 1/max(K, K_floor) for the lower bound. Cells of at least two grid spacings are
   * looked up in a pyramid of moments, where K was integrated by Gauss quadrature
   * at the resolution of the grid; smaller ones are integrated directly. The finer
   * quadrature, on the quarters of such a square, tells by how much that errs. For
   * rigorous bounds each such square is divided into 4 × 4, on which K is taken to be as
   * large, or for the reciprocal as small, as it is anywhere in it.
   *
   * Where the fluid flows on a mesh of its own there are no such cells and no pyramid;
   * the mesh's ranks take the rows of the grid that they touch, as a GapWindow.
   */
  class GapField
  {
  public:
    /** What the moments are of. */
    enum class Coefficient
    {
      conductivity,
      resistivity
    };

    /** How finely moments are integrated. */
    enum class Quadrature
    {
      standard,
      finer // on cells of at most one grid spacing; others as standard
    };

    GapField(SlabLayoutPtr layout, const FluidParameters &fluid);

    /**
     * Take a new gap (percolating_gap()); @p conductivity_floor > 0 prepares the
     * resistivity as well. Collective.
     */
    void update(const SlabField &gap, double conductivity_floor = 0.);

    /** Moments of a coefficient on @p cells; each rank may ask for others.
     *  Collective. */
    CellAnswers ask(Coefficient                  coefficient,
                    const std::vector<GridCell> &cells,
                    Quadrature                   quadrature = Quadrature::standard) const;

    /** Whether the bounds hold whatever the quadrature. */
    bool
    is_rigorous() const
    {
      return rigorous;
    }

    /** The gap for points with @p y_low <= y <= @p y_high; each rank may ask for others.
     *  Collective. */
    GapWindow window(double y_low, double y_high) const;

    /** Of one @p gap. */
    double coefficient_of(Coefficient coefficient, double gap) const;

    const MomentSet &
    moment_set() const
    {
      return set;
    }

    /** Number of times that both grid dimensions can be halved. */
    int
    n_halvings() const
    {
      return halvings;
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
      return gap * gap * gap / (12. * viscosity);
    }

    /** Bytes of this rank. */
    std::size_t memory_consumption() const;

  private:
    /** Coefficient at the n × n Gauss points of the square at (x0, y0), as it is to be
     *  weighted: point values, or the value that makes the bound rigorous. */
    void sample(Coefficient       coefficient,
                const GapStencil &gap,
                double            x0,
                double            y0,
                double            edge,
                double           *values) const;

    /** The stencil of the grid cell at column @p ix of local row @p row. */
    GapStencil stencil(int ix, int row) const;

    /** Moments and flags of the square at (x0, y0) of edge @p edge, in the unit
     *  coordinates of a grid cell. */
    unsigned char integrate(Coefficient       coefficient,
                            Quadrature        quadrature,
                            const GapStencil &gap,
                            double            x0,
                            double            y0,
                            double            edge,
                            double           *moments) const;

    /** Entry of a cell that this rank owns. */
    void answer(Coefficient     coefficient,
                Quadrature      quadrature,
                const GridCell &cell,
                double         *entry) const;

    SlabLayoutPtr                slab_layout;
    MomentSet                    set;
    GapInterpolant               interpolant;
    double                       viscosity;
    bool                         rigorous;
    double                       floor_value = 0.;
    int                          halvings    = 0;
    std::vector<double>          gap_rows; // one row before, two after the own ones
    std::vector<double>          gauss_points, gauss_weights;
    MomentPyramid                conductivity;
    std::optional<MomentPyramid> resistivity;
  };
} // namespace strait

#endif
