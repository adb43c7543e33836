// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/potential_problem.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools_boundary.h>

namespace strait
{
  using namespace dealii;

  PotentialProblem::PotentialProblem(
    const Kind                                 kind_,
    FlowMesh                                  &mesh_,
    const MomentSet                           &set,
    const std::optional<GapField::Coefficient> coefficient_)
    : problem_kind(kind_)
    , kind_of_coefficient(coefficient_.value_or(kind_ == Kind::pressure
                                                  ? GapField::Coefficient::conductivity
                                                  : GapField::Coefficient::resistivity))
    , mesh(mesh_)
    , element(set)
    , fe(set.degree())
    , dofs(mesh.triangulation())
    , coefficient(make_coefficient(mesh, set, fe, coefficient_kind()))
  {
  }

  void
  PotentialProblem::number_unknowns()
  {
    MPI_Comm comm = mesh.triangulation().get_communicator();
    dofs.distribute_dofs(fe);
    owned = dofs.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    if (is_free() && mesh.seal() != nullptr)
      ring.emplace().set_up(mesh, dofs, owned, relevant);
    make_constraints();
    right_hand_side.reinit(owned, comm);
    distributed.reinit(owned, comm);
    ghosted.reinit(owned, relevant, comm);
    if (transfer)
      {
        transfer->interpolate(distributed);
        transfer.reset();
        complete_solution();
      }
    is_numbered = true;
  }

  void
  PotentialProblem::complete_solution()
  {
    Vector complete(distributed);
    constraints.distribute(complete);
    ghosted = complete;
  }

  void
  PotentialProblem::set_up()
  {
    if (!is_numbered)
      number_unknowns();
    MPI_Comm               comm = mesh.triangulation().get_communicator();
    DynamicSparsityPattern pattern(relevant);
    DoFTools::make_sparsity_pattern(dofs, pattern, constraints, false);
    SparsityTools::distribute_sparsity_pattern(pattern, owned, comm, relevant);
    matrix.reinit(owned, owned, pattern, comm);
  }

  void
  PotentialProblem::make_constraints()
  {
    constraints.clear();
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dofs, constraints);
    mesh.constrain_periodic(dofs, constraints);
    const auto set_boundary = [this](const types::boundary_id id, const double value) {
      VectorTools::interpolate_boundary_values(
        mesh.mapping(), dofs, id, Functions::ConstantFunction<2>(value), constraints);
    };
    if (problem_kind == Kind::pressure)
      {
        set_boundary(FlowMesh::inlet, 1.);
        set_boundary(FlowMesh::outlet, 0.);
      }
    else if (mesh.seal() != nullptr && !mesh.seal()->is_ring)
      {
        set_boundary(FlowMesh::right_wall, 0.);
        set_boundary(FlowMesh::left_wall, 1.);
      }
    else if (ring)
      ring->complete(constraints, relevant);
    constraints.close();
  }

  void
  PotentialProblem::pin_one_value()
  {
    // The potential is known but for a constant, and as the equations add up to zero,
    // a spring at one unknown sets that to zero. It is where the coefficient is largest:
    // elsewhere its share would be lost in the rounding of larger entries.
    MPI_Comm                comm     = mesh.triangulation().get_communicator();
    double                  largest  = 0.;
    types::global_dof_index stiffest = numbers::invalid_dof_index;
    for (const auto k : owned)
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
  PotentialProblem::background(const Iterator &cell, std::vector<double> &values) const
  {
    values.assign(fe.n_dofs_per_cell(), 0.);
    if (ring)
      ring->values(cell, values);
    if (problem_kind == Kind::pressure || mesh.seal() != nullptr)
      return;
    // The corner of the cell is as good an origin as any other, and keeps the
    // values of a small cell small.
    const GridCell     here   = mesh.grid_cell(*cell);
    const unsigned int across = 1 - mesh.axis_along();
    const double       step   = across == 1 ? mesh.height(here) / mesh.grid().ly
                                            : -mesh.width(here) / mesh.grid().lx;
    const auto        &points = fe.get_unit_support_points();
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = step * points[i][across];
  }

  void
  PotentialProblem::add_source(const Iterator         &cell,
                               const Source           &source,
                               dealii::Vector<double> &rhs) const
  {
    FEValues<2> fe_values(fe,
                          QGauss<2>(fe.degree + 2),
                          update_values | update_quadrature_points | update_JxW_values);
    fe_values.reinit(cell);
    for (const unsigned int q : fe_values.quadrature_point_indices())
      for (const unsigned int i : fe_values.dof_indices())
        rhs(i) += source(fe_values.quadrature_point(q)) * fe_values.shape_value(i, q) *
                  fe_values.JxW(q);
  }

  void
  PotentialProblem::take_coefficient(const GapField &gap)
  {
    coefficient->update(gap);
    conductivity_weights.clear();
  }

  void
  PotentialProblem::assemble(const Source &source)
  {
    const unsigned int                   n = fe.n_dofs_per_cell();
    FullMatrix<double>                   local_matrix(n, n);
    dealii::Vector<double>               local_rhs(n);
    std::vector<double>                  affine(n);
    std::vector<types::global_dof_index> indices(n);
    matrix          = 0;
    right_hand_side = 0;
    std::size_t c   = 0;
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const std::size_t here = c++;
          if (!is_active(here))
            continue;
          coefficient->stiffness(here, local_matrix);
          local_matrix *= coefficient_weight(here);
          background(cell, affine);
          for (unsigned int i = 0; i < n; ++i)
            {
              local_rhs(i) = 0;
              for (unsigned int j = 0; j < n; ++j)
                local_rhs(i) -= local_matrix(i, j) * affine[j];
            }
          if (source)
            add_source(cell, source, local_rhs);
          cell->get_dof_indices(indices);
          constraints.distribute_local_to_global(
            local_matrix, local_rhs, indices, matrix, right_hand_side);
        }
    matrix.compress(VectorOperation::add);
    right_hand_side.compress(VectorOperation::add);
    if (is_free())
      pin_one_value();
    pin_unreached_rows();
  }

  void
  PotentialProblem::pin_unreached_rows()
  {
    // Unknowns that no open cell reaches have empty rows; they are set to zero.
    unreached.clear();
    types::global_dof_index n_active = 0;
    for (const auto k : owned)
      {
        if (!(matrix.diag_element(k) > 0))
          unreached.push_back(k);
        else if (!constraints.is_constrained(k))
          ++n_active;
      }
    for (const auto k : unreached)
      matrix.set(k, k, 1.);
    matrix.compress(VectorOperation::insert);
    n_active_unknowns =
      Utilities::MPI::sum(n_active, mesh.triangulation().get_communicator()) -
      (is_free() ? 1 : 0);
  }

  LinearSolve
  PotentialProblem::solve(const FlowPreconditioner preconditioner, const double accuracy)
  {
    // With half as many, systems pass for unsolvable on which the multigrid is merely
    // slow; twice as many take longer to say that one cannot be solved.
    constexpr unsigned int max_iterations = 500;
    constraints.set_zero(distributed);
    for (const auto k : unreached)
      distributed(k) = 0.;
    distributed.compress(VectorOperation::insert);
    const auto multigrid = make_multigrid(preconditioner, matrix);

    // How small the error must be follows from the energy, which is not known before
    // the system is solved: start from the energy of the right-hand side, which is
    // too large, and tighten the goal until both fit.
    Vector smoothed(right_hand_side);
    multigrid->vmult(smoothed, right_hand_side);
    double      goal = accuracy * (right_hand_side * smoothed);
    LinearSolve total;
    bool        goes_on = true;
    while (goes_on)
      {
        Vector residual(right_hand_side), image(right_hand_side);
        matrix.vmult(image, distributed);
        residual -= image;
        const LinearSolve solve = solve_by_conjugate_gradients(
          matrix, distributed, residual, *multigrid, goal, max_iterations);
        total.iterations += solve.iterations;
        total.error_energy = solve.error_energy;
        complete_solution();
        goal            = accuracy * energy();
        total.converged = solve.converged && solve.error_energy <= goal;
        // The energy hardly changes any more, and with it the goal, so that this ends.
        goes_on = solve.converged && !total.converged;
      }
    matrix.clear(); // the next matrix, of this problem or the other, needs the room
    return total;
  }

  void
  PotentialProblem::prepare_for_refinement()
  {
    transfer = std::make_unique<Transfer>(dofs);
    transfer->prepare_for_coarsening_and_refinement(ghosted);
    is_numbered = false;
  }

  void
  PotentialProblem::cell_values(const Iterator &cell, std::vector<double> &values) const
  {
    background(cell, values);
    dealii::Vector<double> periodic(fe.n_dofs_per_cell());
    cell->get_dof_values(ghosted, periodic);
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] += periodic(i);
  }

  double
  PotentialProblem::cell_energy(const std::size_t          owned_cell,
                                const std::vector<double> &values) const
  {
    FullMatrix<double> local_matrix(fe.n_dofs_per_cell(), fe.n_dofs_per_cell());
    coefficient->stiffness(owned_cell, local_matrix);
    return coefficient_weight(owned_cell) * ElementMatrix::energy(local_matrix, values);
  }

  double
  PotentialProblem::energy() const
  {
    double              sum = 0.;
    std::size_t         c   = 0;
    std::vector<double> values;
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          if (is_active(c))
            {
              cell_values(cell, values);
              sum += cell_energy(c, values);
            }
          ++c;
        }
    return Utilities::MPI::sum(sum, mesh.triangulation().get_communicator());
  }
} // namespace strait
