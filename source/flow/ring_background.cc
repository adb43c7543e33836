// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/ring_background.h>

#include <deal.II/dofs/dof_tools.h>

#include <cmath>
#include <map>

namespace strait
{
  using namespace dealii;

  namespace
  {
    /** A difference of angles, in turns, between −½ and ½. */
    double
    shorter_way(const double turns)
    {
      return turns - std::round(turns);
    }
  } // namespace

  void
  RingBackground::set_up(const FlowMesh      &mesh,
                         const DoFHandler<2> &dofs,
                         const IndexSet      &owned,
                         const IndexSet      &relevant)
  {
    const SealMesh                             &seal = *mesh.seal();
    std::map<types::global_dof_index, Point<2>> points;
    DoFTools::map_dofs_to_support_points(mesh.mapping(), dofs, points);
    MPI_Comm          comm = mesh.triangulation().get_communicator();
    Multigrid::Vector own(owned, comm);
    const double      turn = (seal.flows_outwards ? .5 : -.5) / numbers::PI;
    for (const auto k : owned)
      {
        const Tensor<1, 2> arm = points.at(k) - seal.pole;
        own(k)                 = turn * std::atan2(arm[1], arm[0]);
      }
    own.compress(VectorOperation::insert);
    angles.reinit(owned, relevant, comm);
    angles = own;
  }

  void
  RingBackground::values(const DoFHandler<2>::active_cell_iterator &cell,
                         std::vector<double>                       &values) const
  {
    dealii::Vector<double> turns(values.size());
    cell->get_dof_values(angles, turns);
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = shorter_way(turns(i) - turns(0));
  }

  void
  RingBackground::complete(AffineConstraints<double> &constraints,
                           const IndexSet            &relevant) const
  {
    for (const auto k : relevant)
      if (const auto *line = constraints.get_constraint_entries(k))
        {
          double jump = 0.;
          for (const auto &[dof, weight] : *line)
            jump += weight * shorter_way(angles(dof) - angles(k));
          constraints.set_inhomogeneity(k, jump);
        }
  }
} // namespace strait
