// SPDX-License-Identifier: GPL-2.0-or-later
// GoogleTest under MPI: rank 0 prints, and the tests fail if any rank fails.
#include <strait/base/collective.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace
{
  /** For ranks other than 0: print failures only, with the number of the rank. */
  class FailurePrinter : public testing::EmptyTestEventListener
  {
  public:
    explicit FailurePrinter(const int rank)
      : rank(rank)
    {
    }

    void
    OnTestPartResult(const testing::TestPartResult &result) override
    {
      if (result.failed())
        std::fprintf(stderr,
                     "[rank %d] %s:%d: %s\n",
                     rank,
                     result.file_name() != nullptr ? result.file_name() : "?",
                     result.line_number(),
                     result.summary());
    }

  private:
    int rank;
  };
} // namespace

int
main(int argc, char **argv)
{
  // Also starts p4est, PETSc and other libraries that the flow needs; one thread.
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  const int rank = strait::rank_in(MPI_COMM_WORLD);
  if (rank != 0)
    {
      // Several ranks that write one report would destroy it.
      testing::GTEST_FLAG(output) = "";
      testing::TestEventListeners &listeners =
        testing::UnitTest::GetInstance()->listeners();
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new FailurePrinter(rank));
    }
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  // A filter that matches nothing must not count as success.
  if (failed == 0 && testing::UnitTest::GetInstance()->test_to_run_count() == 0)
    {
      if (rank == 0)
        std::fprintf(stderr, "no test matches the filter\n");
      failed = 1;
    }
  return failed;
}
