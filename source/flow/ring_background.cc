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

  UnknownsVector
  ring_background(const FlowMesh            &mesh,
                  const DoFHandler<2>       &dofs,
                  AffineConstraints<double> &constraints)
  {
    const SealMesh                             &seal = *mesh.seal();
    std::map<types::global_dof_index, Point<2>> points;
    DoFTools::map_dofs_to_support_points(mesh.mapping(), dofs, points);
    const IndexSet &owned = dofs.locally_owned_dofs();
    MPI_Comm        comm  = dofs.get_communicator();
    UnknownsVector  own(owned, comm);
    const double    turn = (seal.flows_outwards ? .5 : -.5) / numbers::PI;
    for (const auto k : owned)
      {
        const Tensor<1, 2> arm = points.at(k) - seal.pole;
        own(k)                 = turn * std::atan2(arm[1], arm[0]);
      }
    own.compress(VectorOperation::insert);
    UnknownsVector angles(owned, constraints.get_local_lines(), comm);
    angles = own;
    for (const auto k : constraints.get_local_lines())
      if (const auto *line = constraints.get_constraint_entries(k))
        {
          double jump = 0.;
          for (const auto &[dof, weight] : *line)
            jump += weight * shorter_way(angles(dof) - angles(k));
          constraints.set_inhomogeneity(k, jump);
        }
    return angles;
  }

  void
  add_background_values(const UnknownsVector                      &background,
                        const DoFHandler<2>::active_cell_iterator &cell,
                        std::vector<double>                       &values)
  {
    dealii::Vector<double> turns(values.size());
    cell->get_dof_values(background, turns);
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] += shorter_way(turns(i) - turns(0));
  }
} // namespace strait
