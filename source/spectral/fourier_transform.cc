// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/spectral/fourier_transform.h>

#include <fftw3.h>

#include <algorithm>
#include <vector>

namespace strait
{
  namespace
  {
    using Complex = std::complex<double>;

    /**
     * Columns that each rank transforms at a time: two lines of the cache of every row.
     * With half as many a pair of transforms takes up to a tenth longer, with twice as
     * many as long or some per cent longer (512² to 2048², on 1 and 2 ranks).
     */
    constexpr int block_width = 8;

    // A std::vector begins at a multiple of 16 B, as FFTW's vector instructions want.
    fftw_complex *
    fftw(Complex *values)
    {
      return reinterpret_cast<fftw_complex *>(values);
    }

    struct DestroyPlan
    {
      void
      operator()(fftw_plan plan) const
      {
        fftw_destroy_plan(plan);
      }
    };

    using Plan = std::unique_ptr<fftw_plan_s, DestroyPlan>;
  } // namespace

  struct FourierTransform::Parts
  {
    explicit Parts(const SlabLayout &layout)
      : n_ranks(layout.n_ranks())
      , n_rows_most(layout.first_row_of(1))
      , n_half(layout.grid().nx / 2 + 1)
      , n_columns_most((n_half + n_ranks - 1) / n_ranks)
      , modes(static_cast<std::size_t>(n_half) * layout.n_rows())
      , row(layout.grid().nx)
      , column(layout.grid().ny)
      , spectrum(std::max(layout.grid().ny, n_half))
      , of_rows(static_cast<std::size_t>(n_ranks) * block_width * n_rows_most)
      , of_columns(n_ranks > 1 ? of_rows.size() : 0)
    {
      // What was planned before, by measurement perhaps, must not decide.
      fftw_forget_wisdom();
      const int     nx = layout.grid().nx, ny = layout.grid().ny;
      fftw_complex *in = fftw(column.data()), *out = fftw(spectrum.data());
      row_forward.reset(fftw_plan_dft_r2c_1d(nx, row.data(), out, FFTW_ESTIMATE));
      row_backward.reset(fftw_plan_dft_c2r_1d(nx, out, row.data(), FFTW_ESTIMATE));
      column_forward.reset(fftw_plan_dft_1d(ny, in, out, FFTW_FORWARD, FFTW_ESTIMATE));
      column_backward.reset(fftw_plan_dft_1d(ny, out, in, FFTW_BACKWARD, FFTW_ESTIMATE));
    }

    /** First column of a block of @p rank. Some blocks are narrow or empty. */
    int
    first_column(const int rank, const int block) const
    {
      return std::min({rank * n_columns_most + block * block_width,
                       (rank + 1) * n_columns_most,
                       n_half});
    }

    /** move(place in modes, place in of_rows) for all modes of a block. */
    template <class Move>
    void
    for_each_mode_of_rows(const int block, const Move &move) const
    {
      const std::size_t n_rows = modes.size() / n_half;
      for (int rank = 0; rank < n_ranks; ++rank)
        {
          const std::size_t first = first_column(rank, block),
                            width = first_column(rank, block + 1) - first;
          for (std::size_t y = 0; y < n_rows; ++y)
            for (std::size_t k = 0; k < width; ++k)
              move(y * n_half + first + k, (rank * block_width + k) * n_rows_most + y);
        }
    }

    /** move(place in column, place in messages, number) for the modes of each rank. */
    template <class Move>
    void
    for_each_part_of_column(const int k, const Move &move) const
    {
      const int ny = static_cast<int>(column.size());
      for (int rank = 0, y = 0; y < ny; ++rank, y += n_rows_most)
        move(y,
             (static_cast<std::size_t>(rank) * block_width + k) * n_rows_most,
             std::min(n_rows_most, ny - y));
    }

    /** What arrived for the columns of this rank. */
    Complex *
    messages()
    {
      return n_ranks > 1 ? of_columns.data() : of_rows.data();
    }

    int                  n_ranks, n_rows_most, n_half, n_columns_most;
    std::vector<Complex> modes;    // of the rows of this rank
    std::vector<double>  row;      // points of a row
    std::vector<Complex> column;   // modes along x of a column
    std::vector<Complex> spectrum; // the same, also along y
    // Messages of equal size to and from all ranks: block_width columns, of each the
    // rows of one rank.
    std::vector<Complex> of_rows, of_columns;
    Plan                 row_forward, row_backward, column_forward, column_backward;
  };

  FourierTransform::FourierTransform(SlabLayoutPtr layout)
    : slab_layout(std::move(layout))
    , parts(std::make_unique<Parts>(*slab_layout))
    , n_blocks((parts->n_columns_most + block_width - 1) / block_width)
    , buffer(reinterpret_cast<double *>(parts->modes.data()))
    , spectrum(parts->spectrum.data())
  {
  }

  FourierTransform::~FourierTransform() = default;

  std::size_t
  FourierTransform::memory_consumption() const
  {
    return sizeof(Complex) *
           (parts->modes.size() + parts->of_rows.size() + parts->of_columns.size());
  }

  void
  FourierTransform::load_row(const double *in, const int row)
  {
    const std::size_t nx = parts->row.size();
    std::copy_n(in + row * nx, nx, parts->row.data());
    fftw_execute_dft_r2c(parts->row_forward.get(),
                         parts->row.data(),
                         fftw(parts->modes.data() + row * (nx / 2 + 1)));
  }

  void
  FourierTransform::store_row(double *out, const int row)
  {
    const std::size_t nx = parts->row.size();
    fftw_execute_dft_c2r(parts->row_backward.get(),
                         fftw(parts->modes.data() + row * (nx / 2 + 1)),
                         parts->row.data());
    std::copy_n(parts->row.data(), nx, out + row * nx);
  }

  int
  FourierTransform::first_column(const int block) const
  {
    return parts->first_column(slab_layout->rank(), block);
  }

  void
  FourierTransform::fetch_columns(const int block)
  {
    parts->for_each_mode_of_rows(block, [&](const std::size_t i, const std::size_t sent) {
      parts->of_rows[sent] = parts->modes[i];
    });
    exchange(parts->of_rows, parts->of_columns);
  }

  void
  FourierTransform::return_columns(const int block)
  {
    exchange(parts->of_columns, parts->of_rows);
    parts->for_each_mode_of_rows(block,
                                 [&](const std::size_t i, const std::size_t received) {
                                   parts->modes[i] = parts->of_rows[received];
                                 });
  }

  void
  FourierTransform::exchange(const std::vector<Complex> &from,
                             std::vector<Complex>       &to) const
  {
    const int n = 2 * block_width * parts->n_rows_most;
    if (parts->n_ranks > 1)
      MPI_Alltoall(from.data(),
                   n,
                   MPI_DOUBLE,
                   to.data(),
                   n,
                   MPI_DOUBLE,
                   slab_layout->communicator());
  }

  std::complex<double> *
  FourierTransform::forward_column(const int k)
  {
    parts->for_each_part_of_column(
      k, [&](const int y, const std::size_t place, const int n) {
        std::copy_n(parts->messages() + place, n, &parts->column[y]);
      });
    fftw_execute_dft(parts->column_forward.get(),
                     fftw(parts->column.data()),
                     fftw(spectrum));
    return spectrum;
  }

  void
  FourierTransform::backward_column(const int k)
  {
    fftw_execute_dft(parts->column_backward.get(),
                     fftw(spectrum),
                     fftw(parts->column.data()));
    parts->for_each_part_of_column(
      k, [&](const int y, const std::size_t place, const int n) {
        std::copy_n(&parts->column[y], n, parts->messages() + place);
      });
  }
} // namespace strait
