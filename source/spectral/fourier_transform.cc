// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/fourier_transform.h>

#include <fftw3-mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <new>

namespace strait
{
  struct FourierTransform::Plans
  {
    fftw_plan forward  = nullptr;
    fftw_plan backward = nullptr;

    ~Plans()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }
  };

  FourierTransform::FourierTransform(SlabLayoutPtr layout)
    : slab_layout(std::move(layout))
    , plans(std::make_unique<Plans>())
  {
    const PeriodicGrid &g      = slab_layout->grid();
    const int           n_half = g.nx / 2 + 1;
    transposed                 = slab_layout->n_ranks() > 1;

    MPI_Comm        comm = slab_layout->communicator();
    ptrdiff_t       n0 = 0, start0 = 0, n1 = 0, start1 = 0;
    const ptrdiff_t n_complex =
      transposed ? fftw_mpi_local_size_2d_transposed(
                     g.ny, n_half, comm, &n0, &start0, &n1, &start1)
                 : fftw_mpi_local_size_2d(g.ny, n_half, comm, &n0, &start0);
    first_line  = static_cast<int>(transposed ? start1 : start0);
    n_lines     = static_cast<int>(transposed ? n1 : n0);
    line_length = transposed ? g.ny : n_half;

    n_allocated = 2 * static_cast<std::size_t>(n_complex);
    buffer      = fftw_alloc_real(std::max<std::size_t>(n_allocated, 1));
    if (buffer == nullptr)
      throw std::bad_alloc();

    auto          *spectrum = reinterpret_cast<fftw_complex *>(buffer);
    const unsigned out      = transposed ? FFTW_MPI_TRANSPOSED_OUT : 0U;
    const unsigned in       = transposed ? FFTW_MPI_TRANSPOSED_IN : 0U;
    plans->forward =
      fftw_mpi_plan_dft_r2c_2d(g.ny, g.nx, buffer, spectrum, comm, FFTW_MEASURE | out);
    plans->backward =
      fftw_mpi_plan_dft_c2r_2d(g.ny, g.nx, spectrum, buffer, comm, FFTW_MEASURE | in);
  }

  FourierTransform::~FourierTransform()
  {
    plans.reset();
    fftw_free(buffer);
  }

  void
  FourierTransform::load_row(const double *in, const int row)
  {
    const int         nx     = slab_layout->grid().nx;
    const std::size_t stride = 2 * static_cast<std::size_t>(nx / 2 + 1);
    std::copy_n(in + static_cast<std::size_t>(row) * nx, nx, buffer + row * stride);
  }

  void
  FourierTransform::load(const double *in)
  {
    for (int row = 0; row < slab_layout->n_rows(); ++row)
      load_row(in, row);
  }

  void
  FourierTransform::forward()
  {
    fftw_execute(plans->forward);
  }

  void
  FourierTransform::backward()
  {
    fftw_execute(plans->backward);
  }

  void
  FourierTransform::store_row(double *out, const int row) const
  {
    const int         nx     = slab_layout->grid().nx;
    const std::size_t stride = 2 * static_cast<std::size_t>(nx / 2 + 1);
    std::copy_n(buffer + row * stride, nx, out + static_cast<std::size_t>(row) * nx);
  }

  void
  FourierTransform::store(double *out) const
  {
    for (int row = 0; row < slab_layout->n_rows(); ++row)
      store_row(out, row);
  }

  namespace
  {
    std::filesystem::path
    wisdom_file(MPI_Comm communicator)
    {
      int n_ranks = 1;
      MPI_Comm_size(communicator, &n_ranks);
      std::filesystem::path folder;
      if (const char *cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        folder = cache;
      else if (const char *home = std::getenv("HOME"); home && *home)
        folder = std::filesystem::path(home) / ".cache";
      else
        return {};
      return folder / "strait" / ("fftw-wisdom-" + std::to_string(n_ranks));
    }
  } // namespace

  void
  load_wisdom(MPI_Comm communicator)
  {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    fftw_mpi_init();
    const auto file = wisdom_file(communicator);
    if (rank == 0 && !file.empty())
      fftw_import_wisdom_from_filename(file.c_str());
    fftw_mpi_broadcast_wisdom(communicator);
  }

  void
  save_wisdom(MPI_Comm communicator)
  {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    fftw_mpi_gather_wisdom(communicator);
    const auto file = wisdom_file(communicator);
    if (rank != 0 || file.empty())
      return;
    // A run must not fail for want of a cache, and a run beside it must never
    // read half a file: write to a name of our own, then rename.
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    const std::filesystem::path mine =
      file.string() + "." + std::to_string(getpid()) + ".part";
    if (fftw_export_wisdom_to_filename(mine.c_str()) != 0)
      std::filesystem::rename(mine, file, ignored);
  }

  std::string
  export_wisdom(MPI_Comm communicator)
  {
    fftw_mpi_gather_wisdom(communicator);
    char             *text   = fftw_export_wisdom_to_string();
    const std::string wisdom = text == nullptr ? "" : text;
    std::free(text); // NOLINT(cppcoreguidelines-no-malloc)
    return wisdom;
  }

  void
  import_wisdom(MPI_Comm communicator, const std::string &wisdom)
  {
    fftw_import_wisdom_from_string(wisdom.c_str());
    fftw_mpi_broadcast_wisdom(communicator);
  }
} // namespace strait
