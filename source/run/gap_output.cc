// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/gap_output.h>

#include <deal.II/base/hdf5.h>

#include <vector>

namespace strait
{
  namespace
  {
    /** A list that every rank knows. */
    void
    write_list(dealii::HDF5::Group       &group,
               const std::string         &name,
               const std::vector<double> &values,
               MPI_Comm                   comm)
    {
      int rank = 0;
      MPI_Comm_rank(comm, &rank);
      auto dataset = group.create_dataset<double>(name, {values.size()});
      if (rank == 0)
        dataset.write_hyperslab(values, {0}, {values.size()});
      else
        dataset.write_none<double>();
    }
  } // namespace

  void
  write_gap_distributions(const std::string &directory, const Step &step, MPI_Comm comm)
  {
    if (!step.theory)
      return;
    using Mode                    = dealii::HDF5::File::FileAccessMode;
    const TheoryResult &theory    = *step.theory;
    const auto         &persson   = theory.persson_gaps;
    const auto         &simulated = theory.simulated_gaps;
    const bool          is_begun  = !step.state.gap().empty();
    dealii::HDF5::File  file(directory + "/fields-" + std::to_string(step.number) + ".h5",
                            is_begun ? Mode::open : Mode::create,
                            comm);
    if (!is_begun)
      file.set_attribute("nominal_pressure", theory.pressure);
    auto group = file.create_group("gap_distribution");
    write_list(group, "edges", (persson ? persson : simulated)->edges, comm);
    if (persson)
      {
        write_list(group, "persson", persson->shares, comm);
        group.set_attribute("persson_contact_area", persson->contact_area);
      }
    if (simulated)
      {
        write_list(group, "simulated", simulated->shares, comm);
        group.set_attribute("simulated_contact_area", simulated->contact_area);
      }
  }
} // namespace strait
