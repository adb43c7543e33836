// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/element_matrix.h>
#include <strait/flow/reynolds_solver.h>

#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    using Cell = dealii::CellAccessor<2>;

    using Points = dealii::RTree<dealii::Point<2>>;

    /** Return the points of the first path of @p channel, if it has one, on @p mesh. */
    Points
    points_of_path(const Channel &channel, const FlowMesh &mesh)
    {
      if (channel.paths.empty())
        return Points();
      const SlabLayout    &layout = channel.gap.layout();
      const PeriodicGrid  &grid   = layout.grid();
      dealii::Tensor<1, 2> period;
      period[1 - mesh.axis_along()] = mesh.axis_along() == 0 ? grid.ly : grid.lx;
      // Points of a window may lie one period outside the box, and then two from a cell.
      const int                     reach = mesh.seal() == nullptr ? 2 : 0;
      std::vector<dealii::Point<2>> on_mesh;
      for (const GridPoint &on_path : channel.paths.front().points)
        {
          const auto [x, y] = layout.position(on_path.window, on_path.ix, on_path.iy);
          for (int n = -reach; n <= reach; ++n)
            on_mesh.push_back(dealii::Point<2>(x, y) + static_cast<double>(n) * period);
        }
      return dealii::pack_rtree(on_mesh);
    }

    /** Whether one of @p points is on @p cell, or no further away than its size. */
    bool
    touches(const Points &points, const Cell &cell)
    {
      // The box is enlarged by its size on each side: steps of the path that are longer
      // than the cell must leave out no cells, nor may cells touch at a corner alone.
      const auto                   box    = cell.bounding_box();
      const auto                  &ends   = box.get_boundary_points();
      const dealii::Tensor<1, 2>   margin = ends.second - ends.first;
      const dealii::BoundingBox<2> around({ends.first - margin, ends.second + margin});
      return points.qbegin(boost::geometry::index::intersects(around)) != points.qend();
    }

    /** Return the flow through @p cell on which both solutions disagree. */
    double
    disagreement(const Cell                &cell,
                 const std::vector<double> &p,
                 const double               conductivity,
                 const std::vector<double> &psi,
                 const double               leak)
    {
      const auto change_along_x = [](const std::vector<double> &corners) {
        return .5 * (corners[1] - corners[0] + corners[3] - corners[2]);
      };
      const auto change_along_y = [](const std::vector<double> &corners) {
        return .5 * (corners[2] - corners[0] + corners[3] - corners[1]);
      };
      const double shape = cell.extent_in_direction(1) / cell.extent_in_direction(0);
      return std::hypot(conductivity * shape * change_along_x(p) +
                          leak * change_along_y(psi),
                        conductivity / shape * change_along_y(p) -
                          leak * change_along_x(psi));
    }
  } // namespace

  Bracket
  plain_bracket(const PotentialProblem &pressure, const PotentialProblem &stream_function)
  {
    const auto         &dofs = pressure.dof_handler();
    const ElementMatrix element(MomentSet(dofs.get_fe().degree));
    Bracket             bracket;
    bracket.upper = pressure.energy();
    bracket.lower = 1. / stream_function.energy();
    bracket.contributions.reinit(dofs.get_triangulation().n_active_cells());
    std::vector<double> p, psi;
    for (std::size_t c = 0; c < pressure.cells().size(); ++c)
      {
        pressure.cell_values(c, p);
        stream_function.cell_values(c, psi);
        const bool   open            = pressure.is_active(c);
        const double pressure_energy = open ? pressure.cell_energy(c, p) : 0.;
        const double stream_energy   = stream_function.cell_energy(c, psi);
        const double mixed           = open ? element.gradient_times_curl(p, psi) : 0.;
        const double contribution =
          pressure_energy + bracket.lower * (bracket.lower * stream_energy + 2. * mixed);
        bracket.contributions(pressure.cells()[c]->active_cell_index()) =
          static_cast<float>(std::max(contribution / bracket.upper, 0.));
      }
    return bracket;
  }

  /**
   * Return for each active cell the flow through it on which pressure and stream function
   * disagree, relative to the upper bound of the flow, times the part of the pressure
   * drop, at most one, that the stream function would need to let this flow pass.
   *
   * A coarse cell may let the pressure leak through a barrier, or bar the way of the
   * stream function, at no cost of its own: what that changes is at other throats, where
   * Bracket::contributions show it and refinement does not help. These flows show the
   * cell itself. In the wide parts of a channel, the pressure on coarse cells spreads the
   * flow over many of them. Therefore those on the first path of @p channel, if it has
   * one, and beside it count as if all of the disputed flow passed there, but at most
   * what passes a throat as wide as long.
   *
   * The flows are those of uniform coefficients, the means of the cell.
   */
  dealii::Vector<float>
  ReynoldsSolver::disputed_flows(const Channel &channel) const
  {
    const Points path  = points_of_path(channel, flow_mesh);
    const double width = 1. - plain.lower / plain.upper;
    const double through_path =
      channel.paths.empty()
        ? 0.
        : std::min(plain.upper - plain.lower,
                   gap_field.conductivity_of(channel.paths.front().bottleneck_gap));
    dealii::Vector<float> result(flow_mesh.triangulation().n_active_cells());
    std::vector<double>   p, psi;
    for (std::size_t c = 0; c < pressure_problem.cells().size(); ++c)
      {
        const auto &cell = pressure_problem.cells()[c];
        pressure_problem.cell_values(c, p);
        stream_problem.cell_values(c, psi);
        const double conductivity = pressure_problem.mean_coefficient(c);
        const double resistivity  = stream_problem.mean_coefficient(c);
        // Where the gap is wide, rounding alone makes flows larger than the leak rate.
        const double flow =
          std::min(disagreement(*cell, p, conductivity, psi, plain.lower),
                   plain.upper - plain.lower);
        double disputed = flow / plain.upper * std::min(flow * resistivity, 1.);
        // A cell without contact takes the same part of the drop however small it is.
        const double excess  = resistivity - 1. / conductivity;
        const double on_path = width * std::min(through_path * excess, 1.);
        if (on_path > disputed && touches(path, *cell))
          disputed = on_path;
        result(cell->active_cell_index()) = static_cast<float>(disputed);
      }
    return result;
  }

  bool
  ReynoldsSolver::mark(const Channel &channel,
                       const double   excess,
                       const double   affordable)
  {
    // A cell is refined if it contributes more to the width of the bracket than this
    // fraction of the mean. Half of it refines more cells on each mesh and ends with
    // more unknowns than needed; double of it takes more meshes.
    constexpr double marking_level = .7;
    // … but no more cells than hold this many times the excess together. A refined cell
    // keeps a quarter of its contribution. Half of the factor takes one mesh more nearly
    // each time; with double of it the last mesh is finer than asked.
    constexpr double excess_factor = 1.6;
    // By how much the level rises at a time. Its root and its square do equally well.
    constexpr double rise = 1.25;
    if (3. * affordable < 1. - useful_narrowing)
      return false;
    using dealii::Utilities::MPI::sum;
    auto        &tria              = flow_mesh.triangulation();
    MPI_Comm     comm              = tria.get_communicator();
    const auto   n_cells           = static_cast<double>(tria.n_global_active_cells());
    const double width             = sum(plain.contributions.l1_norm(), comm);
    const auto   held_by_more_than = [&](const double contribution) {
      double local = 0.;
      for (const float each : plain.contributions)
        local += each > contribution ? each : 0.;
      return sum(local, comm);
    };
    double contribution = marking_level * width / n_cells;
    while (held_by_more_than(rise * contribution) > excess_factor * excess * width)
      contribution *= rise;
    // Another channel is about as long as the first one. Coarse cells may bar it, or let
    // the pressure leak through a barrier, in as many places as the first one has
    // constrictions, so that no place takes much of the drop.
    double n_places = 1.;
    if (!channel.paths.empty())
      n_places =
        static_cast<double>(divide_into_constrictions(channel.paths.front().gaps).size());
    // Where that place is wide, several cells side by side bar it, each of a part of the
    // flow. With half of their number, all others may be refined in vain, tenfold, until
    // the last of them is found; with double of it more cells are refined than matter.
    constexpr double n_beside  = 3.;
    const double most_disputed = (1. - plain.lower / plain.upper) / (n_beside * n_places);
    const dealii::Vector<float> disputed = disputed_flows(channel);
    unsigned long long          n_marked = 0;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned() &&
          (plain.contributions(cell->active_cell_index()) > contribution ||
           disputed(cell->active_cell_index()) > most_disputed))
        {
          cell->set_refine_flag();
          ++n_marked;
        }
    n_marked = sum(n_marked, comm);
    if (n_marked == 0)
      return false;
    // Where most cells matter alike, adaptivity saves nothing and costs hanging nodes
    // and more meshes.
    if (2. * n_marked > n_cells && affordable > 1.)
      tria.set_all_refine_flags();
    else if (n_marked > affordable * n_cells)
      {
        for (const auto &cell : tria.active_cell_iterators())
          cell->clear_refine_flag();
        dealii::parallel::distributed::GridRefinement::refine_and_coarsen_fixed_number(
          tria, plain.contributions, affordable, 0.);
        // If all cells contribute alike, it may mark none.
        n_marked = 0;
        for (const auto &cell : tria.active_cell_iterators())
          n_marked += cell->is_locally_owned() && cell->refine_flag_set() ? 1 : 0;
        return sum(n_marked, comm) > 0;
      }
    return true;
  }
} // namespace strait
