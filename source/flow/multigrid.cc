// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/flow/multigrid.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <HYPRE_utilities.h>

#include <numeric>
#include <string>
#include <vector>

namespace strait
{
  namespace
  {
    void
    check(const int error, const char *what)
    {
      if (error != 0)
        {
          HYPRE_ClearAllErrors();
          throw ComputationError(std::string("hypre failed in ") + what +
                                 ", error code " + std::to_string(error) + ".");
        }
    }

    /** Owner of a distributed hypre vector. */
    class HypreVector
    {
    public:
      HypreVector(MPI_Comm comm, const int first, const int last)
        : rows(last + 1 - first)
      {
        std::iota(rows.begin(), rows.end(), first);
        check(HYPRE_IJVectorCreate(comm, first, last, &vector), "creating a vector");
        HYPRE_IJVectorSetObjectType(vector, HYPRE_PARCSR);
        check(HYPRE_IJVectorInitialize(vector), "initialising a vector");
      }

      ~HypreVector()
      {
        HYPRE_IJVectorDestroy(vector);
      }

      HypreVector(const HypreVector &)            = delete;
      HypreVector &operator=(const HypreVector &) = delete;

      HYPRE_ParVector
      set(const double *values)
      {
        HYPRE_IJVectorSetValues(vector,
                                static_cast<int>(rows.size()),
                                rows.data(),
                                values);
        HYPRE_IJVectorAssemble(vector);
        return handle();
      }

      HYPRE_ParVector
      handle()
      {
        void *object = nullptr;
        HYPRE_IJVectorGetObject(vector, &object);
        return static_cast<HYPRE_ParVector>(object);
      }

      void
      get(double *values)
      {
        HYPRE_IJVectorGetValues(vector,
                                static_cast<int>(rows.size()),
                                rows.data(),
                                values);
      }

    private:
      std::vector<int> rows;
      HYPRE_IJVector   vector = nullptr;
    };

    class BoomerAmg : public Multigrid
    {
    public:
      explicit BoomerAmg(const Matrix &matrix)
        : comm(matrix.get_mpi_communicator())
        , first(matrix.trilinos_matrix().RowMap().MinMyGID())
        , last(first + matrix.trilinos_matrix().NumMyRows() - 1)
      {
        HYPRE_Init();
        // A rank without rows still has to name an empty range that ascends.
        const int n_mine = last + 1 - first;
        int       end    = n_mine;
        MPI_Scan(MPI_IN_PLACE, &end, 1, MPI_INT, MPI_SUM, comm);
        first = end - n_mine;
        last  = end - 1;
        right = std::make_unique<HypreVector>(comm, first, last);
        left  = std::make_unique<HypreVector>(comm, first, last);
        copy_matrix(matrix);
        set_up_solver();
      }

      ~BoomerAmg() override
      {
        HYPRE_BoomerAMGDestroy(solver);
        HYPRE_IJMatrixDestroy(ij_matrix);
      }

      BoomerAmg(const BoomerAmg &)            = delete;
      BoomerAmg &operator=(const BoomerAmg &) = delete;

      void
      apply(const Vector &r, Vector &z) override
      {
        zeros.assign(last + 1 - first, 0.);
        HYPRE_ParVector b = right->set(r.begin());
        HYPRE_ParVector x = left->set(zeros.data());
        HYPRE_BoomerAMGSolve(solver, parcsr, b, x);
        // With a fixed number of cycles hypre reports that it did not converge.
        HYPRE_ClearAllErrors();
        left->get(z.begin());
      }

    private:
      void
      copy_matrix(const Matrix &matrix)
      {
        const Epetra_CrsMatrix &source = matrix.trilinos_matrix();
        const int               n_rows = source.NumMyRows();
        std::vector<int>        sizes(n_rows), rows(n_rows), columns;
        std::vector<double>     values;
        for (int row = 0; row < n_rows; ++row)
          {
            int     n_entries     = 0;
            double *row_values    = nullptr;
            int    *local_columns = nullptr;
            source.ExtractMyRowView(row, n_entries, row_values, local_columns);
            rows[row] = first + row;
            for (int k = 0; k < n_entries; ++k)
              if (row_values[k] != 0)
                {
                  columns.push_back(source.GCID(local_columns[k]));
                  values.push_back(row_values[k]);
                  ++sizes[row];
                }
          }
        check(HYPRE_IJMatrixCreate(comm, first, last, first, last, &ij_matrix),
              "creating a matrix");
        HYPRE_IJMatrixSetObjectType(ij_matrix, HYPRE_PARCSR);
        HYPRE_IJMatrixSetRowSizes(ij_matrix, sizes.data());
        check(HYPRE_IJMatrixInitialize(ij_matrix), "initialising a matrix");
        check(
          HYPRE_IJMatrixSetValues(
            ij_matrix, n_rows, sizes.data(), rows.data(), columns.data(), values.data()),
          "filling a matrix");
        check(HYPRE_IJMatrixAssemble(ij_matrix), "assembling a matrix");
        void *object = nullptr;
        HYPRE_IJMatrixGetObject(ij_matrix, &object);
        parcsr = static_cast<HYPRE_ParCSRMatrix>(object);
      }

      void
      set_up_solver()
      {
        constexpr int hmis = 10, extended_plus_i = 6, symmetric_gauss_seidel = 6;
        check(HYPRE_BoomerAMGCreate(&solver), "creating BoomerAMG");
        HYPRE_BoomerAMGSetPrintLevel(solver, 0);
        HYPRE_BoomerAMGSetTol(solver, 0.);
        HYPRE_BoomerAMGSetMaxIter(solver, 1);
        // Coarsening, interpolation and threshold are hypre's defaults. A larger
        // threshold or fewer interpolation weights make coarse grids that are cheaper and
        // worse.
        HYPRE_BoomerAMGSetCoarsenType(solver, hmis);
        HYPRE_BoomerAMGSetInterpType(solver, extended_plus_i);
        HYPRE_BoomerAMGSetPMaxElmts(solver, 4);
        HYPRE_BoomerAMGSetStrongThreshold(solver, 0.25);
        HYPRE_BoomerAMGSetRelaxType(solver, symmetric_gauss_seidel);
        check(HYPRE_BoomerAMGSetup(solver, parcsr, right->handle(), left->handle()),
              "setting up BoomerAMG");
      }

      MPI_Comm                     comm;
      int                          first;
      int                          last;
      std::unique_ptr<HypreVector> right, left;
      std::vector<double>          zeros;
      HYPRE_IJMatrix               ij_matrix = nullptr;
      HYPRE_ParCSRMatrix           parcsr    = nullptr;
      HYPRE_Solver                 solver    = nullptr;
    };

    class Ml : public Multigrid
    {
    public:
      explicit Ml(const Matrix &matrix)
      {
        dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
        data.elliptic              = true;
        data.w_cycle               = true;
        data.aggregation_threshold = 0.02;
        data.smoother_type         = "symmetric Gauss-Seidel";
        data.smoother_sweeps       = 2;
        data.coarse_type           = "Amesos-KLU";
        amg.initialize(matrix, data);
      }

      void
      apply(const Vector &r, Vector &z) override
      {
        amg.vmult(z, r);
      }

    private:
      dealii::TrilinosWrappers::PreconditionAMG amg;
    };
  } // namespace

  std::unique_ptr<Multigrid>
  make_multigrid(const FlowPreconditioner kind, const Multigrid::Matrix &matrix)
  {
    if (kind == FlowPreconditioner::ml)
      return std::make_unique<Ml>(matrix);
    return std::make_unique<BoomerAmg>(matrix);
  }

  LinearSolve
  solve_by_conjugate_gradients(const Multigrid::Matrix &A,
                               Multigrid::Vector       &x,
                               const Multigrid::Vector &b,
                               Multigrid               &multigrid,
                               const double             goal,
                               const unsigned int       max_iterations)
  {
    Multigrid::Vector r(b), z(b), image(b);
    A.vmult(image, x);
    r -= image;
    multigrid.apply(r, z);
    Multigrid::Vector direction(z);

    LinearSolve result;
    result.error_energy = r * z;
    while (result.error_energy > goal && result.iterations < max_iterations)
      {
        A.vmult(image, direction);
        const double step = result.error_energy / (direction * image);
        x.add(step, direction);
        r.add(-step, image);
        multigrid.apply(r, z);
        const double next = r * z;
        direction.sadd(next / result.error_energy, 1., z);
        result.error_energy = next;
        ++result.iterations;
      }
    // Written such that NaN is no success, nor is a negative one, by which rounding tells
    // that the coefficients differ too much.
    result.converged = std::abs(result.error_energy) <= goal;
    return result;
  }
} // namespace strait
