// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/iteration.h>
#include <strait/flow/element_matrix.h>
#include <strait/flow/potential_problem.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools_boundary.h>

namespace strait
{
  using namespace dealii;

  PotentialProblem::PotentialProblem(FlowMesh                   &mesh_,
                                     const MomentSet            &set,
                                     const GapField::Coefficient coefficient_)
    : kind_of_coefficient(coefficient_)
    , mesh(mesh_)
    , fe(set.degree())
    , dofs(mesh.triangulation())
    , cell_matrix(fe.n_dofs_per_cell(), fe.n_dofs_per_cell())
  {
  }

  void
  PotentialProblem::number_unknowns()
  {
    dofs.distribute_dofs(fe);
    owned_cells.clear();
    owned_cells.reserve(mesh.triangulation().n_locally_owned_active_cells());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        owned_cells.push_back(cell);
    constraints = mesh.continuity(dofs);
    constrain_boundary();
    constraints.close();
    const IndexSet &owned = dofs.locally_owned_dofs();
    distributed.reinit(owned, dofs.get_communicator());
    ghosted.reinit(owned, constraints.get_local_lines(), dofs.get_communicator());
    if (transfer)
      {
        transfer->interpolate(distributed);
        transfer.reset();
        complete_solution();
      }
  }

  void
  PotentialProblem::complete_solution()
  {
    Vector complete(distributed);
    constraints.distribute(complete);
    ghosted = complete;
  }

  void
  PotentialProblem::constrain_boundary()
  {
    const auto set_boundary = [this](const types::boundary_id id, const double value) {
      VectorTools::interpolate_boundary_values(
        mesh.mapping(), dofs, id, Functions::ConstantFunction<2>(value), constraints);
    };
    if (is_pressure())
      {
        set_boundary(FlowMesh::inlet, 1.);
        set_boundary(FlowMesh::outlet, 0.);
      }
    else if (mesh.seal() != nullptr && !mesh.seal()->is_ring)
      {
        set_boundary(FlowMesh::right_wall, 0.);
        set_boundary(FlowMesh::left_wall, 1.);
      }
    else if (mesh.seal() != nullptr)
      find_multivalued_part();
  }

  UnknownsMatrix
  PotentialProblem::empty_matrix() const
  {
    MPI_Comm               comm     = dofs.get_communicator();
    const IndexSet        &owned    = dofs.locally_owned_dofs();
    const IndexSet        &relevant = constraints.get_local_lines();
    DynamicSparsityPattern pattern(relevant);
    DoFTools::make_sparsity_pattern(dofs, pattern, constraints, false);
    SparsityTools::distribute_sparsity_pattern(pattern, owned, comm, relevant);
    UnknownsMatrix matrix;
    matrix.reinit(owned, owned, pattern, comm);
    return matrix;
  }

  void
  PotentialProblem::pin_one_value(UnknownsMatrix &matrix) const
  {
    // The potential is determined only up to a constant. As the equations add up to zero,
    // a spring at one unknown sets that unknown to zero. It is put where the diagonal is
    // largest: elsewhere it would be lost in the rounding of larger entries.
    MPI_Comm                comm     = dofs.get_communicator();
    double                  largest  = 0.;
    types::global_dof_index stiffest = numbers::invalid_dof_index;
    for (const auto k : dofs.locally_owned_dofs())
      if (!constraints.is_constrained(k) && matrix.diag_element(k) > largest)
        {
          largest  = matrix.diag_element(k);
          stiffest = k;
        }
    const auto over_ranks = Utilities::MPI::min_max_avg(largest, comm);
    if (over_ranks.max > 0 &&
        over_ranks.max_index == Utilities::MPI::this_mpi_process(comm))
      matrix.add(stiffest, stiffest, largest);
    matrix.compress(VectorOperation::add);
  }

  void
  PotentialProblem::take_coefficient(const GapField &gap)
  {
    if (transfer || ghosted.size() == 0)
      number_unknowns();
    coefficient = coefficient_on_cells(mesh, fe.degree, fe, kind_of_coefficient, gap);
    conductivity_weights.clear();
  }

  void
  PotentialProblem::assemble(UnknownsMatrix &matrix, Vector &right) const
  {
    const unsigned int                   n = fe.n_dofs_per_cell();
    FullMatrix<double>                   local_matrix(n, n);
    dealii::Vector<double>               local_rhs(n);
    std::vector<double>                  affine;
    std::vector<types::global_dof_index> indices(n);
    for (std::size_t c = 0; c < owned_cells.size(); ++c)
      if (is_active(c))
        {
          const Iterator &cell = owned_cells[c];
          coefficient.stiffness(c, local_matrix);
          local_matrix *= coefficient_weight(c);
          affine.assign(n, 0.);
          add_background(cell, affine);
          local_matrix.vmult(local_rhs,
                             dealii::Vector<double>(affine.begin(), affine.end()));
          local_rhs *= -1.;
          cell->get_dof_indices(indices);
          constraints.distribute_local_to_global(
            local_matrix, local_rhs, indices, matrix, right);
        }
    matrix.compress(VectorOperation::add);
    right.compress(VectorOperation::add);
  }

  void
  PotentialProblem::pin_unreached_rows(UnknownsMatrix &matrix)
  {
    // Unknowns on closed cells only have empty rows; they are set to zero.
    std::vector<types::global_dof_index> unreached;
    types::global_dof_index              n_active = 0;
    for (const auto k : dofs.locally_owned_dofs())
      if (!(matrix.diag_element(k) > 0))
        unreached.push_back(k);
      else if (!constraints.is_constrained(k))
        ++n_active;
    for (const auto k : unreached)
      {
        matrix.set(k, k, 1.);
        distributed(k) = 0.;
      }
    matrix.compress(VectorOperation::insert);
    distributed.compress(VectorOperation::insert);
    n_active_unknowns =
      Utilities::MPI::sum(n_active, dofs.get_communicator()) - (is_free() ? 1 : 0);
  }

  LinearSolve
  PotentialProblem::solve(const LinearAccuracy &accuracy)
  {
    UnknownsMatrix matrix = empty_matrix();
    Vector         right_hand_side(dofs.locally_owned_dofs(), dofs.get_communicator());
    assemble(matrix, right_hand_side);
    if (is_free())
      pin_one_value(matrix);
    constraints.set_zero(distributed);
    pin_unreached_rows(matrix);
    const auto multigrid = make_multigrid(accuracy.preconditioner, matrix);

    // The goal follows from the energy, which is not known before the system is solved:
    // start from the energy of the right-hand side, which is too large, and tighten the
    // goal until both fit.
    Vector smoothed(right_hand_side);
    multigrid->vmult(smoothed, right_hand_side);
    double      goal = accuracy.energy * (right_hand_side * smoothed);
    LinearSolve total;
    while (true)
      {
        Vector residual(right_hand_side), image(right_hand_side);
        matrix.vmult(image, distributed);
        residual -= image;
        const LinearSolve solve = solve_by_conjugate_gradients(
          matrix, distributed, residual, *multigrid, goal, iteration_limit);
        total.iterations += solve.iterations;
        complete_solution();
        goal            = accuracy.energy * energy();
        total.converged = solve.converged && solve.error_energy <= goal;
        // This ends, since the energy, and with it the goal, soon hardly changes.
        if (total.converged || !solve.converged)
          return total;
      }
  }

  void
  PotentialProblem::prepare_for_refinement()
  {
    transfer = std::make_unique<Transfer>(dofs);
    transfer->prepare_for_coarsening_and_refinement(ghosted);
  }

  void
  PotentialProblem::cell_values(const std::size_t cell, std::vector<double> &values) const
  {
    values.resize(fe.n_dofs_per_cell());
    owned_cells[cell]->get_dof_values(ghosted, values.begin(), values.end());
    add_background(owned_cells[cell], values);
  }

  double
  PotentialProblem::cell_energy(const std::size_t          cell,
                                const std::vector<double> &values) const
  {
    coefficient.stiffness(cell, cell_matrix);
    return coefficient_weight(cell) * ElementMatrix::energy(cell_matrix, values);
  }

  double
  PotentialProblem::energy() const
  {
    double              sum = 0.;
    std::vector<double> values;
    for (std::size_t c = 0; c < owned_cells.size(); ++c)
      if (is_active(c))
        {
          cell_values(c, values);
          sum += cell_energy(c, values);
        }
    return Utilities::MPI::sum(sum, dofs.get_communicator());
  }
} // namespace strait
