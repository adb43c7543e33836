// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/flow/multigrid.h>

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
  using dealii::TrilinosWrappers::PreconditionBase;

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

    class BoomerAmg : public PreconditionBase
    {
    public:
      explicit BoomerAmg(const UnknownsMatrix &matrix)
        : comm(matrix.get_mpi_communicator())
      {
        HYPRE_Init();
        // A rank without rows still has to give an empty range that ascends.
        const int n_mine = matrix.trilinos_matrix().NumMyRows();
        int       end    = n_mine;
        MPI_Scan(MPI_IN_PLACE, &end, 1, MPI_INT, MPI_SUM, comm);
        first = end - n_mine;
        last  = end - 1;
        rows.resize(n_mine);
        std::iota(rows.begin(), rows.end(), first);
        create_vector(right);
        create_vector(left);
        copy_matrix(matrix);
        set_up_solver();
      }

      ~BoomerAmg() override
      {
        HYPRE_BoomerAMGDestroy(solver);
        HYPRE_IJMatrixDestroy(ij_matrix);
        HYPRE_IJVectorDestroy(left);
        HYPRE_IJVectorDestroy(right);
      }

      BoomerAmg(const BoomerAmg &)            = delete;
      BoomerAmg &operator=(const BoomerAmg &) = delete;

      void
      vmult(UnknownsVector &z, const UnknownsVector &r) const override
      {
        const auto n_rows = static_cast<int>(rows.size());
        HYPRE_IJVectorSetValues(right, n_rows, rows.data(), r.begin());
        HYPRE_IJVectorAssemble(right);
        HYPRE_ParVectorSetConstantValues(handle(left), 0.);
        HYPRE_BoomerAMGSolve(solver, parcsr, handle(right), handle(left));
        // With a fixed number of cycles hypre reports that it did not converge.
        HYPRE_ClearAllErrors();
        HYPRE_IJVectorGetValues(left, n_rows, rows.data(), z.begin());
      }

    private:
      void
      create_vector(HYPRE_IJVector &vector) const
      {
        check(HYPRE_IJVectorCreate(comm, first, last, &vector), "creating a vector");
        HYPRE_IJVectorSetObjectType(vector, HYPRE_PARCSR);
        check(HYPRE_IJVectorInitialize(vector), "initialising a vector");
        HYPRE_IJVectorAssemble(vector);
      }

      static HYPRE_ParVector
      handle(HYPRE_IJVector vector)
      {
        void *object = nullptr;
        HYPRE_IJVectorGetObject(vector, &object);
        return static_cast<HYPRE_ParVector>(object);
      }

      void
      copy_matrix(const UnknownsMatrix &matrix)
      {
        const Epetra_CrsMatrix &source = matrix.trilinos_matrix();
        const int               n_rows = source.NumMyRows();
        std::vector<int>        sizes(n_rows), columns;
        std::vector<double>     values;
        for (int row = 0; row < n_rows; ++row)
          {
            int     n_entries     = 0;
            double *row_values    = nullptr;
            int    *local_columns = nullptr;
            source.ExtractMyRowView(row, n_entries, row_values, local_columns);
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
        // Where rows of one rank are coupled strongly to those of another, the smoother
        // that ignores this coupling (6) may make the preconditioner indefinite. This one
        // adds the magnitude of such entries to the diagonal; on one rank there are none.
        constexpr int l1_symmetric_gauss_seidel = 8;
        check(HYPRE_BoomerAMGCreate(&solver), "creating BoomerAMG");
        HYPRE_BoomerAMGSetTol(solver, 0.);
        HYPRE_BoomerAMGSetMaxIter(solver, 1);
        // Coarsening, interpolation and threshold are the defaults of hypre 2.26: HMIS,
        // "extended+i" with 4 weights, 0.25. A larger threshold or fewer weights make
        // coarse grids cheaper and worse.
        HYPRE_BoomerAMGSetRelaxType(solver, l1_symmetric_gauss_seidel);
        check(HYPRE_BoomerAMGSetup(solver, parcsr, handle(right), handle(left)),
              "setting up BoomerAMG");
      }

      MPI_Comm           comm;
      int                first, last; // of this rank's rows
      std::vector<int>   rows;
      HYPRE_IJVector     right = nullptr, left = nullptr;
      HYPRE_IJMatrix     ij_matrix = nullptr;
      HYPRE_ParCSRMatrix parcsr    = nullptr;
      HYPRE_Solver       solver    = nullptr;
    };
  } // namespace

  std::unique_ptr<PreconditionBase>
  make_multigrid(const FlowPreconditioner kind, const UnknownsMatrix &matrix)
  {
    if (kind == FlowPreconditioner::boomeramg)
      return std::make_unique<BoomerAmg>(matrix);
    using Ml = dealii::TrilinosWrappers::PreconditionAMG;
    Ml::AdditionalData data;
    data.elliptic              = true;
    data.w_cycle               = true;
    data.aggregation_threshold = 0.02;
    data.smoother_type         = "symmetric Gauss-Seidel";
    data.smoother_sweeps       = 2;
    data.coarse_type           = "Amesos-KLU";
    auto ml                    = std::make_unique<Ml>();
    ml->initialize(matrix, data);
    return ml;
  }
} // namespace strait
