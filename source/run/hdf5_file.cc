// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/files.h>
#include <strait/run/hdf5_file.h>

#include <deal.II/base/hdf5.h>

#include <hdf5.h>

namespace strait
{
  namespace
  {
    /** Notes the first failure of an HDF5 call while it exists, in place of the printed
     *  report. */
    class Hdf5Failure
    {
    public:
      Hdf5Failure()
      {
        H5Eget_auto2(H5E_DEFAULT, &earlier_action, &earlier_data);
        H5Eset_auto2(H5E_DEFAULT, note, this);
      }
      Hdf5Failure(const Hdf5Failure &)            = delete;
      Hdf5Failure &operator=(const Hdf5Failure &) = delete;
      ~Hdf5Failure()
      {
        H5Eset_auto2(H5E_DEFAULT, earlier_action, earlier_data);
      }

      /** What HDF5 says of the failure; empty if there was none. */
      std::string message;

    private:
      static herr_t
      note(const hid_t stack, void *const failure)
      {
        std::string &message = static_cast<Hdf5Failure *>(failure)->message;
        if (message.empty())
          H5Ewalk2(stack, H5E_WALK_UPWARD, take_innermost, &message);
        return 0;
      }

      static herr_t
      take_innermost(const unsigned            n,
                     const H5E_error2_t *const error,
                     void *const               message)
      {
        if (n == 0)
          *static_cast<std::string *>(message) = error->desc;
        return 0;
      }

      H5E_auto2_t earlier_action = nullptr;
      void       *earlier_data   = nullptr;
    };
  } // namespace

  void
  write_hdf5_file(const std::string                               &path,
                  MPI_Comm                                         comm,
                  const std::function<void(dealii::HDF5::File &)> &write)
  {
    Hdf5Failure failure;
    {
      constexpr auto     create = dealii::HDF5::File::FileAccessMode::create;
      dealii::HDF5::File file   = n_ranks_in(comm) == 1
                                    ? dealii::HDF5::File(path, create)
                                    : dealii::HDF5::File(path, create, comm);
      write(file);
    } // closes the file
    if (maximum(comm, failure.message.empty() ? 0. : 1.) > 0.)
      throw_unfinished("The file '" + path + "'",
                       "HDF5: " + (failure.message.empty() ? "failure on another rank"
                                                           : failure.message));
  }
} // namespace strait
