// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/potential_problem.h>

#include <deal.II/dofs/dof_tools.h>

#include <cmath>
#include <map>

namespace strait
{
  using namespace dealii;

  namespace
  {
    /** Reduce a difference of angles, in turns, to between −½ and ½. */
    double
    wrapped_turns(const double turns)
    {
      return turns - std::round(turns);
    }
  } // namespace

  void
  PotentialProblem::find_multivalued_part()
  {
    const SealMesh                             &seal = *mesh.seal();
    std::map<types::global_dof_index, Point<2>> points;
    DoFTools::map_dofs_to_support_points(mesh.mapping(), dofs, points);
    const IndexSet &owned = dofs.locally_owned_dofs();
    MPI_Comm        comm  = dofs.get_communicator();
    Vector          own(owned, comm);
    const double    turn = (seal.flows_outwards ? .5 : -.5) / numbers::PI;
    for (const auto k : owned)
      {
        const Tensor<1, 2> arm = points.at(k) - seal.pole;
        own(k)                 = turn * std::atan2(arm[1], arm[0]);
      }
    own.compress(VectorOperation::insert);
    angles.reinit(owned, constraints.get_local_lines(), comm);
    angles = own;
    for (const auto k : constraints.get_local_lines())
      if (const auto *line = constraints.get_constraint_entries(k))
        {
          double jump = 0.;
          for (const auto &[dof, weight] : *line)
            jump += weight * wrapped_turns(angles(dof) - angles(k));
          constraints.set_inhomogeneity(k, jump);
        }
  }

  void
  PotentialProblem::add_background(const Iterator      &cell,
                                   std::vector<double> &values) const
  {
    if (angles.size() > 0)
      {
        dealii::Vector<double> turns(values.size());
        cell->get_dof_values(angles, turns);
        for (unsigned int i = 0; i < values.size(); ++i)
          values[i] += wrapped_turns(turns(i) - turns(0));
      }
    if (is_pressure() || mesh.seal() != nullptr)
      return;
    // Any origin will do. The corner of the cell keeps the values of a small cell small.
    const auto [width, height] = mesh.edges(mesh.grid_cell(*cell));
    const unsigned int across  = 1 - mesh.axis_along();
    const double step   = across == 1 ? height / mesh.grid().ly : -width / mesh.grid().lx;
    const auto  &points = fe.get_unit_support_points();
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] += step * points[i][across];
  }
} // namespace strait
