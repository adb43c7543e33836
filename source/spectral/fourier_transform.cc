// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/spectral/fourier_transform.h>

#include <fftw3.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace strait
{
  namespace
  {
    /** FFTW's names for one type of number. */
    template <class Number>
    struct Fftw;

    /** Those in double precision. */
    template <>
    struct Fftw<double>
    {
      using Complex                              = fftw_complex;
      using Plan                                 = fftw_plan_s;
      static constexpr auto plan_row_forward     = fftw_plan_dft_r2c_1d;
      static constexpr auto plan_row_backward    = fftw_plan_dft_c2r_1d;
      static constexpr auto plan_column          = fftw_plan_dft_1d;
      static constexpr auto execute_row_forward  = fftw_execute_dft_r2c;
      static constexpr auto execute_row_backward = fftw_execute_dft_c2r;
      static constexpr auto execute_column       = fftw_execute_dft;
      static constexpr auto destroy_plan         = fftw_destroy_plan;
      static constexpr auto forget_wisdom        = fftw_forget_wisdom;
    };

    /** Those in single precision. */
    template <>
    struct Fftw<float>
    {
      using Complex                              = fftwf_complex;
      using Plan                                 = fftwf_plan_s;
      static constexpr auto plan_row_forward     = fftwf_plan_dft_r2c_1d;
      static constexpr auto plan_row_backward    = fftwf_plan_dft_c2r_1d;
      static constexpr auto plan_column          = fftwf_plan_dft_1d;
      static constexpr auto execute_row_forward  = fftwf_execute_dft_r2c;
      static constexpr auto execute_row_backward = fftwf_execute_dft_c2r;
      static constexpr auto execute_column       = fftwf_execute_dft;
      static constexpr auto destroy_plan         = fftwf_destroy_plan;
      static constexpr auto forget_wisdom        = fftwf_forget_wisdom;
    };

    /** The values in FFTW's type. A std::vector begins at a multiple of 16 B, as FFTW's
     *  vector instructions require. */
    template <class Number>
    typename Fftw<Number>::Complex *
    as_fftw(std::complex<Number> *values)
    {
      return reinterpret_cast<typename Fftw<Number>::Complex *>(values);
    }
  } // namespace

  template <class Number>
  struct BasicFourierTransform<Number>::Parts
  {
    /**
     * Columns that each rank transforms at a time: two cache lines of every row. With
     * half as many a pair of transforms takes up to a tenth longer; with twice as many it
     * takes as long or a few per cent longer (512² to 2048², on 1 and 2 ranks).
     */
    static constexpr int line        = 64 / sizeof(Complex); // modes in a cache line
    static constexpr int block_width = 2 * line;

    explicit Parts(const SlabLayout &layout)
      : comm(layout.communicator())
      , n_ranks(layout.n_ranks())
      , most_rows_per_rank(layout.first_row_of(1))
      , n_half(layout.grid().nx / 2 + 1)
      , n_columns_most((n_half + n_ranks - 1) / n_ranks)
      , n_in_row((n_half + line - 1) / line * line)
      , n_modes(static_cast<std::size_t>(n_in_row) * layout.n_rows())
      , row(layout.grid().nx)
      , column(layout.grid().ny)
      , spectrum(std::max(layout.grid().ny, n_half))
      , of_rows(static_cast<std::size_t>(n_ranks) * block_width * most_rows_per_rank)
      , of_columns(n_ranks > 1 ? of_rows.size() : 0)
    {
      // Plans made before, perhaps by measurement, must not influence these.
      using Library = Fftw<Number>;
      Library::forget_wisdom();
      const auto own = [](auto *plan) {
        return std::shared_ptr<typename Library::Plan>(plan, Library::destroy_plan);
      };
      const int nx = layout.grid().nx, ny = layout.grid().ny;
      auto     *in = as_fftw(column.data()), *out = as_fftw(spectrum.data());
      row_forward  = own(Library::plan_row_forward(nx, row.data(), out, FFTW_ESTIMATE));
      row_backward = own(Library::plan_row_backward(nx, out, row.data(), FFTW_ESTIMATE));
      column_forward =
        own(Library::plan_column(ny, in, out, FFTW_FORWARD, FFTW_ESTIMATE));
      column_backward =
        own(Library::plan_column(ny, out, in, FFTW_BACKWARD, FFTW_ESTIMATE));
    }

    /** First column of a block of @p rank. Some blocks are narrow or empty. */
    int
    first_column(const int rank, const int block) const
    {
      return std::min({rank * n_columns_most + block * block_width,
                       (rank + 1) * n_columns_most,
                       n_half});
    }

    /** Copy the modes of a block from the rows to of_rows, or @p back into the rows. */
    template <bool back>
    void
    copy_block(const int block)
    {
      // Take as many rows at a time as fill a cache line with the modes of one column, so
      // that whole lines are written; the next rows are prefetched meanwhile. (Sizes are
      // copied from members, which the compiler must otherwise reload after each write.)
      const std::size_t from_row = n_in_row, from_column = most_rows_per_rank,
                        n_rows = n_modes / from_row;
      for (int rank = 0; rank < n_ranks; ++rank)
        {
          const std::size_t width =
            first_column(rank, block + 1) - first_column(rank, block);
          Complex *const        in_rows = modes() + first_column(rank, block),
                         *const in_columns =
                           of_rows.data() + rank * block_width * from_column;
          for (std::size_t row = 0, next = 0; row < n_rows; row = next)
            {
              next = std::min(row + line, n_rows);
              for (std::size_t y = next; y < std::min(next + line, n_rows); ++y)
                for (std::size_t k = 0; k < width; k += line)
                  __builtin_prefetch(in_rows + y * from_row + k);
              for (std::size_t k = 0; k < width; ++k)
                for (std::size_t y = row; y < next; ++y)
                  {
                    Complex *here  = in_rows + y * from_row + k,
                            *there = in_columns + k * from_column + y;
                    if (back)
                      std::swap(here, there);
                    // An assignment would move the real and the imaginary part
                    // separately.
                    std::memcpy(there, here, sizeof(Complex));
                  }
            }
        }
    }

    /** Call move(place in column, place in messages, number of modes) for the part of
     *  column @p k of the block that each rank has. */
    template <class Move>
    void
    for_each_part_of_column(const int k, const Move &move) const
    {
      const int ny = static_cast<int>(column.size());
      for (int rank = 0, y = 0; y < ny; ++rank, y += most_rows_per_rank)
        move(y,
             (static_cast<std::size_t>(rank) * block_width + k) * most_rows_per_rank,
             std::min(most_rows_per_rank, ny - y));
    }

    /** Exchange messages between all ranks, if there is more than one. Collective. */
    void
    exchange(const std::vector<Complex> &from, std::vector<Complex> &to) const
    {
      const int n = block_width * most_rows_per_rank * static_cast<int>(sizeof(Complex));
      if (n_ranks > 1)
        MPI_Alltoall(from.data(), n, MPI_BYTE, to.data(), n, MPI_BYTE, comm);
    }

    /** Collect this rank's columns of a block from the rows of all ranks. Collective. */
    void
    fetch_columns(const int block)
    {
      copy_block<false>(block);
      exchange(of_rows, of_columns);
    }

    /** Return them to the rows of all ranks. Collective. */
    void
    return_columns(const int block)
    {
      exchange(of_columns, of_rows);
      copy_block<true>(block);
    }

    /** Transform column @p k of the block into its ny modes, the spectrum. */
    void
    forward_column(const int k)
    {
      for_each_part_of_column(k, [&](const int y, const std::size_t place, const int n) {
        std::copy_n(messages() + place, n, &column[y]);
      });
      Fftw<Number>::execute_column(column_forward.get(),
                                   as_fftw(column.data()),
                                   as_fftw(spectrum.data()));
    }

    /** Transform the spectrum back into column @p k of the block. */
    void
    backward_column(const int k)
    {
      Fftw<Number>::execute_column(column_backward.get(),
                                   as_fftw(spectrum.data()),
                                   as_fftw(column.data()));
      for_each_part_of_column(k, [&](const int y, const std::size_t place, const int n) {
        std::copy_n(&column[y], n, messages() + place);
      });
    }

    Complex *
    modes_of_row(const int local_row)
    {
      return modes() + static_cast<std::size_t>(local_row) * n_in_row;
    }

    Complex *
    modes() const
    {
      const auto address = reinterpret_cast<std::uintptr_t>(room.get());
      return reinterpret_cast<Complex *>((address + 63) / 64 * 64);
    }

    /** The modes that arrived for the columns of this rank. */
    Complex *
    messages()
    {
      return n_ranks > 1 ? of_columns.data() : of_rows.data();
    }

    MPI_Comm    comm;
    int         n_ranks, most_rows_per_rank, n_half, n_columns_most;
    int         n_in_row; // modes from one row to the next: whole cache lines
    std::size_t n_modes;
    std::unique_ptr<Number[]> room;     // for the modes of the rows of this rank, or null
    std::vector<Number>       row;      // points of a row
    std::vector<Complex>      column;   // modes along x of one column
    std::vector<Complex>      spectrum; // the same, also along y
    // Messages of equal size to and from all ranks: block_width columns, and of each
    // column the rows of one rank.
    std::vector<Complex>                         of_rows, of_columns;
    std::shared_ptr<typename Fftw<Number>::Plan> row_forward, row_backward,
      column_forward, column_backward;
  };

  template <class Number>
  BasicFourierTransform<Number>::BasicFourierTransform(SlabLayoutPtr layout)
    : slab_layout(std::move(layout))
    , parts(std::make_unique<Parts>(*slab_layout))
    , factors(2 * static_cast<std::size_t>(slab_layout->grid().ny))
  {
  }

  template <class Number>
  BasicFourierTransform<Number>::~BasicFourierTransform() = default;

  template <class Number>
  std::complex<Number> *
  BasicFourierTransform<Number>::buffer()
  {
    // The memory is not set to zero, which would take a pass over it.
    if (parts->room == nullptr)
      parts->room.reset(new Number[2 * (parts->n_modes + Parts::line)]);
    return parts->modes();
  }

  template <class Number>
  void
  BasicFourierTransform<Number>::release()
  {
    parts->room.reset();
  }

  template <class Number>
  void
  BasicFourierTransform<Number>::load_rows(const Number *in)
  {
    buffer();
    const std::size_t nx = parts->row.size();
    // From the last row to the first: those of scratch() lie closer together than their
    // modes.
    for (int row = slab_layout->n_rows() - 1; row >= 0; --row)
      {
        // FFTW strides through its input, which costs less in a row that is in the cache.
        std::copy_n(in + row * nx, nx, parts->row.data());
        Fftw<Number>::execute_row_forward(parts->row_forward.get(),
                                          parts->row.data(),
                                          as_fftw(parts->modes_of_row(row)));
      }
  }

  template <class Number>
  void
  BasicFourierTransform<Number>::store_rows(Number *out)
  {
    const std::size_t nx = parts->row.size();
    for (int row = 0; row < slab_layout->n_rows(); ++row)
      {
        Fftw<Number>::execute_row_backward(parts->row_backward.get(),
                                           as_fftw(parts->modes_of_row(row)),
                                           parts->row.data());
        std::copy_n(parts->row.data(), nx, out + row * nx);
      }
  }

  template <class Number>
  void
  BasicFourierTransform<Number>::for_each_column(
    const bool                                 are_read,
    const bool                                 are_written,
    const std::function<void(int, Complex *)> &visit)
  {
    for (int block = 0; block * Parts::block_width < parts->n_columns_most; ++block)
      {
        if (are_read)
          parts->fetch_columns(block);
        const int first = parts->first_column(slab_layout->rank(), block);
        const int end   = parts->first_column(slab_layout->rank(), block + 1);
        for (int kx = first; kx < end; ++kx)
          {
            if (are_read)
              parts->forward_column(kx - first);
            visit(kx, parts->spectrum.data());
            if (are_written)
              parts->backward_column(kx - first);
          }
        if (are_written)
          parts->return_columns(block);
      }
  }

  template class BasicFourierTransform<float>;
  template class BasicFourierTransform<double>;
} // namespace strait
