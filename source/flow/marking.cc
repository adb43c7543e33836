// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/marking.h>

#include <deal.II/distributed/grid_refinement.h>

namespace strait
{
  bool
  mark(FlowMesh::Triangulation     &tria,
       const Bracket               &bracket,
       const dealii::Vector<float> &hidden,
       const double                 largest_hidden,
       const double                 excess,
       const double                 affordable)
  {
    // A cell is refined if it contributes more to the width of the bracket than this
    // fraction of the mean. Half of it refines more cells on each mesh and ends with
    // more unknowns than it takes; double of it takes more meshes.
    constexpr double marking_level = .7;
    // … but no more than hold this many times the excess, and a little. Refined cells
    // keep a quarter of what they contribute: half of it takes a mesh more nearly each
    // time, with double of it the last mesh is finer than was asked.
    constexpr double excess_factor = 1.6, least_share = .1;
    // By how much the level rises at a time: its root and its square find alike.
    constexpr double rise = 1.25;
    using dealii::Utilities::MPI::sum;
    MPI_Comm     comm              = tria.get_communicator();
    const auto   n_cells           = static_cast<double>(tria.n_global_active_cells());
    const double width             = sum(bracket.contributions.l1_norm(), comm);
    const auto   held_by_more_than = [&](const double contribution) {
      double local = 0.;
      for (const float each : bracket.contributions)
        local += each > contribution ? each : 0.;
      return sum(local, comm);
    };
    double contribution = marking_level * width / n_cells;
    while (held_by_more_than(rise * contribution) >
           (excess_factor * excess + least_share) * width)
      contribution *= rise;
    const double hidden_flow    = largest_hidden * (1. - bracket.lower / bracket.upper);
    unsigned long long n_marked = 0;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned() &&
          (bracket.contributions(cell->active_cell_index()) > contribution ||
           hidden(cell->active_cell_index()) > hidden_flow))
        {
          cell->set_refine_flag();
          ++n_marked;
        }
    n_marked = sum(n_marked, comm);
    if (n_marked == 0 || 3. * affordable < 1. - progress)
      return false;
    // Where most cells matter alike, adaptivity saves nothing and costs hanging nodes
    // and meshes.
    if (2. * n_marked > n_cells && affordable > 1.)
      tria.set_all_refine_flags();
    else if (n_marked > affordable * n_cells)
      {
        for (const auto &cell : tria.active_cell_iterators())
          cell->clear_refine_flag();
        dealii::parallel::distributed::GridRefinement::refine_and_coarsen_fixed_number(
          tria, bracket.contributions, affordable, 0.);
        // Of cells that contribute alike it may mark none.
        n_marked = 0;
        for (const auto &cell : tria.active_cell_iterators())
          n_marked += cell->is_locally_owned() && cell->refine_flag_set() ? 1 : 0;
        return sum(n_marked, comm) > 0;
      }
    return true;
  }
} // namespace strait
