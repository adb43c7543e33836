// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_spectral_fourier_transform_h
#define strait_spectral_fourier_transform_h

#include <strait/spectral/slab_field.h>

#include <complex>
#include <cstddef>
#include <string>

namespace strait
{
  /**
   * The in-place real-to-complex Fourier transform of slab fields (FFTW-MPI)
   * and multiplication by a real symbol between the transform and its inverse.
   *
   * Convention: f(r) = Σ_q f~(q) exp(i q·r) with q = (2π kx/lx, 2π ky/ly) and
   * integer kx, ky in (-n/2, n/2]. Only kx >= 0 is stored; a mode with
   * 0 < kx < nx/2 stands for itself and its mirror image and has weight 2.
   *
   * The padded buffer, 8 B a grid point, is lent out as scratch memory between
   * transforms.
   */
  class FourierTransform
  {
  public:
    explicit FourierTransform(SlabLayoutPtr layout);
    ~FourierTransform();
    FourierTransform(const FourierTransform &)            = delete;
    FourierTransform &operator=(const FourierTransform &) = delete;

    /** At least layout().n_local_points() doubles; overwritten by transforms. */
    double *
    scratch()
    {
      return buffer;
    }

    const SlabLayout &
    layout() const
    {
      return *slab_layout;
    }

    const SlabLayoutPtr &
    layout_pointer() const
    {
      return slab_layout;
    }

    /**
     * out = F⁻¹[ symbol(kx, ky) F[in] ]; @p in and @p out may be the same.
     * @return the local part of Σ_q symbol |f~|², that is of the grid mean of
     * in·out, by Parseval. Collective; one FFT pair.
     */
    template <class Symbol>
    double
    multiply(const double *in, double *out, const Symbol &symbol)
    {
      double product = 0;
      multiply_in_passes(
        in,
        out,
        symbol,
        [](int) {},
        [&](const double local_product) { product = local_product; },
        [](int) {});
      return product;
    }

    /**
     * multiply() for callers that would run over the field just before and just
     * after it, which costs less while a row is in the cache: before(row) is
     * called before the local row is read and may still write it, between(product)
     * before the inverse transform with what multiply() returns, and after(row)
     * when the row of @p out is complete. before() runs from the last row to the
     * first: values of its row that lie in scratch() are not overwritten yet.
     */
    template <class Symbol, class Before, class Between, class After>
    void
    multiply_in_passes(const double  *in,
                       double        *out,
                       const Symbol  &symbol,
                       const Before  &before,
                       const Between &between,
                       const After   &after)
    {
      for (int row = slab_layout->n_rows() - 1; row >= 0; --row)
        {
          before(row);
          load_row(in, row);
        }
      forward();
      double     product = 0;
      const auto scale   = 1. / static_cast<double>(slab_layout->grid().n_points());
      for (int line = 0; line < n_lines; ++line)
        product += multiply_line(line, scale, symbol);
      between(product * scale);
      backward();
      for (int row = 0; row < slab_layout->n_rows(); ++row)
        {
          store_row(out, row);
          after(row);
        }
      ++pairs;
    }

    /**
     * The field whose Fourier coefficients are mode(kx, ky), a callable that
     * returns std::complex<double> and is asked for 0 <= kx <= nx/2 and
     * -ny/2 < ky <= ny/2 only; mirror images are implied. Where a mode is its
     * own mirror image the imaginary part is dropped. Collective.
     */
    template <class Mode>
    void
    synthesize(double *out, const Mode &mode)
    {
      for_each_stored_mode([&](const int kx, const int ky, fftw_number *value) {
        const std::complex<double> z = mode(kx, ky);
        value[0]                     = z.real();
        value[1]                     = z.imag();
      });
      backward();
      store(out);
    }

    /**
     * Transform @p in and call visit(kx, ky, f~, weight) for every stored local
     * mode; weight counts the mirror image. Collective.
     */
    template <class Visit>
    void
    analyze(const double *in, const Visit &visit)
    {
      load(in);
      forward();
      const auto scale = 1. / static_cast<double>(slab_layout->grid().n_points());
      for_each_stored_mode([&](const int kx, const int ky, fftw_number *value) {
        visit(kx,
              ky,
              std::complex<double>(value[0] * scale, value[1] * scale),
              weight_of(kx));
      });
    }

    /** FFT pairs (one forward, one inverse transform) of multiply() so far. */
    long
    n_pairs() const
    {
      return pairs;
    }

    /** Bytes of the buffer of this rank. */
    std::size_t
    memory_consumption() const
    {
      return n_allocated * sizeof(double);
    }

  private:
    using fftw_number = double;
    struct Plans;

    void load_row(const double *in, int row);
    void load(const double *in);
    void forward();
    void backward();
    void store_row(double *out, int row) const;
    void store(double *out) const;

    double
    weight_of(const int kx) const
    {
      return kx == 0 || 2 * kx == slab_layout->grid().nx ? 1. : 2.;
    }

    /** Wave number of the stored index @p i along an axis of @p n points. */
    static int
    signed_wave_number(const int i, const int n)
    {
      return 2 * i <= n ? i : i - n;
    }

    // With one rank a line of the spectrum is a row (fixed ky, kx running),
    // with several it is a column (fixed kx), because FFTW-MPI then leaves the
    // spectrum transposed and saves half of the communication.
    template <class Visit>
    void
    for_each_stored_mode(const Visit &visit)
    {
      const PeriodicGrid &g = slab_layout->grid();
      for (int line = 0; line < n_lines; ++line)
        {
          double *values = buffer + 2 * static_cast<std::size_t>(line) * line_length;
          if (transposed)
            for (int i = 0; i < line_length; ++i)
              visit(first_line + line, signed_wave_number(i, g.ny), values + 2 * i);
          else
            for (int i = 0; i < line_length; ++i)
              visit(i, signed_wave_number(first_line + line, g.ny), values + 2 * i);
        }
    }

    template <class Symbol>
    double
    multiply_line(const int line, const double scale, const Symbol &symbol)
    {
      const PeriodicGrid &g = slab_layout->grid();
      double *values        = buffer + 2 * static_cast<std::size_t>(line) * line_length;
      double  product       = 0;
      if (transposed)
        {
          const int kx = first_line + line;
          for (int i = 0; i < line_length; ++i)
            product +=
              scale_mode(values + 2 * i, scale * symbol(kx, signed_wave_number(i, g.ny)));
          return product * weight_of(kx);
        }
      const int ky = signed_wave_number(first_line + line, g.ny);
      for (int i = 0; i < line_length; ++i)
        product += scale_mode(values + 2 * i, scale * symbol(i, ky));
      product *= 2;
      // The modes that are not paired were counted twice: take one of each back.
      product -= unpaired(values, symbol(0, ky) * scale);
      if (g.nx % 2 == 0)
        product -=
          unpaired(values + 2 * (line_length - 1), symbol(line_length - 1, ky) * scale);
      return product;
    }

    static double
    scale_mode(double *value, const double factor)
    {
      const double product = factor * (value[0] * value[0] + value[1] * value[1]);
      value[0] *= factor;
      value[1] *= factor;
      return product;
    }

    /** factor |f~|² of a mode that was already multiplied by factor. */
    static double
    unpaired(const double *value, const double factor)
    {
      return factor == 0. ? 0. : (value[0] * value[0] + value[1] * value[1]) / factor;
    }

    SlabLayoutPtr          slab_layout;
    double                *buffer      = nullptr;
    std::size_t            n_allocated = 0;
    bool                   transposed  = false;
    int                    first_line  = 0;
    int                    n_lines     = 0;
    int                    line_length = 0;
    long                   pairs       = 0;
    std::unique_ptr<Plans> plans;
  };

  /**
   * Load FFTW's wisdom from the user's cache folder ($XDG_CACHE_HOME or
   * ~/.cache, strait/), and save it there; planning a large transform by
   * measurement takes seconds and is done once per machine and size. Failure to
   * read or write is not an error. Collective.
   */
  void load_wisdom(MPI_Comm communicator);

  /** Save what load_wisdom() finds. Collective. */
  void save_wisdom(MPI_Comm communicator);

  /**
   * The same as text, that of all ranks on rank 0: which plan was found the fastest
   * decides about the last digits. Collective.
   */
  std::string export_wisdom(MPI_Comm communicator);

  /** Take up what export_wisdom() returned, known to rank 0. Collective. */
  void import_wisdom(MPI_Comm communicator, const std::string &wisdom);
} // namespace strait

#endif
