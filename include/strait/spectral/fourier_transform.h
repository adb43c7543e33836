// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <complex>
#include <functional>
#include <memory>
#include <vector>

namespace strait
{
  /**
   * The real-to-complex Fourier transform of slab fields, and multiplication by a real
   * symbol between the transform and its inverse.
   *
   * Convention: f(r) = Σ_q f~(q) exp(i q·r) with q = (2π kx/lx, 2π ky/ly) and integer kx,
   * ky in (-n/2, n/2]. Only kx >= 0 is stored; a mode with 0 < kx < nx/2 stands for
   * itself and its mirror image and has weight 2.
   *
   * Each rank transforms its own rows. Then a few columns at a time are collected from
   * all ranks, transformed, multiplied, transformed back and returned, so that the
   * spectrum is never stored as a whole and the field passes through memory three times.
   * The spectrum of a field is the same to the last bit on any number of ranks.
   *
   * One-dimensional transforms are FFTW's, with plans that its cost model prefers, as
   * these depend on the length alone. Plans chosen by measurement, and with them the last
   * digits, would depend on what else the machine is doing. For the same reason the
   * constructor makes FFTW forget the wisdom of the process.
   *
   * The buffer, about one @p Number per grid point, is lent out as scratch memory between
   * transforms, and can be freed until it is needed again. @p Number is double or, where
   * seven digits are enough, float: half the memory and six tenths of the time.
   */
  template <class Number>
  class BasicFourierTransform
  {
  public:
    using Complex = std::complex<Number>;

    explicit BasicFourierTransform(SlabLayoutPtr layout);
    ~BasicFourierTransform();
    BasicFourierTransform(const BasicFourierTransform &)            = delete;
    BasicFourierTransform &operator=(const BasicFourierTransform &) = delete;

    /** At least layout().n_local_points() numbers; overwritten by transforms. */
    Number *
    scratch()
    {
      return reinterpret_cast<Number *>(buffer());
    }

    /** Free the buffer, and what is in scratch(), until either is needed again. */
    void release();

    const SlabLayout &
    layout() const
    {
      return *slab_layout;
    }

    /**
     * Compute out = F⁻¹[ symbol(kx, |ky|) F[in] ]; @p in and @p out may be the same, and
     * either may be scratch(). Collective; one FFT pair.
     * @return the local part of Σ_q symbol |f~|², a sum that by Parseval is the grid mean
     * of in·out.
     */
    template <class Symbol>
    double
    multiply(const Number *in, Number *out, const Symbol &symbol)
    {
      load_rows(in);
      double     product = 0;
      const auto scale   = 1. / static_cast<double>(slab_layout->grid().n_points());
      for_each_column(true, true, [&](const int kx, Complex *modes) {
        product +=
          weight_of(kx) * multiply_column(modes, kx, static_cast<Number>(scale), symbol);
      });
      store_rows(out);
      ++pairs;
      return product * scale;
    }

    /**
     * The field whose Fourier coefficients are mode(kx, ky), a callable that
     * returns a Complex and is asked for 0 <= kx <= nx/2 and
     * -ny/2 < ky <= ny/2 only; mirror images are implied. Where a mode is its
     * own mirror image the imaginary part is dropped. Collective.
     */
    template <class Mode>
    void
    synthesize(Number *out, const Mode &mode)
    {
      const int ny = slab_layout->grid().ny;
      buffer();
      for_each_column(false, true, [&](const int kx, Complex *modes) {
        for (int i = 0; i < ny; ++i)
          modes[i] = mode(kx, signed_wave_number(i, ny));
      });
      store_rows(out);
    }

    /**
     * Transform @p in and call visit(kx, ky, f~, weight) for every stored local
     * mode; weight counts the mirror image. Collective.
     */
    template <class Visit>
    void
    analyze(const Number *in, const Visit &visit)
    {
      load_rows(in);
      const int  ny    = slab_layout->grid().ny;
      const auto scale = 1. / static_cast<double>(slab_layout->grid().n_points());
      for_each_column(true, false, [&](const int kx, const Complex *modes) {
        for (int i = 0; i < ny; ++i)
          visit(kx, signed_wave_number(i, ny), modes[i] * scale, weight_of(kx));
      });
    }

    /** FFT pairs (one forward, one inverse transform) of multiply() so far. */
    long
    n_pairs() const
    {
      return pairs;
    }

  private:
    struct Parts;

    /** The modes of the rows; allocates the buffer if it is not there. */
    Complex *buffer();

    /** Transform the rows of @p in along x, into the buffer. */
    void load_rows(const Number *in);

    /** Transform the rows of the buffer back along x, into @p out; the modes are lost. */
    void store_rows(Number *out);

    /** Call visit(kx, modes) for each column of this rank, with its ny modes. If
     *  @p are_read, these are transformed from the rows; if @p are_written, back into the
     *  rows. Collective. */
    void for_each_column(bool                                       are_read,
                         bool                                       are_written,
                         const std::function<void(int, Complex *)> &visit);

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

    /** Multiply column @p kx by scale·symbol; return Σ scale symbol |mode|². */
    template <class Symbol>
    double
    multiply_column(Complex      *values,
                    const int     kx,
                    const Number  scale,
                    const Symbol &symbol)
    {
      const int ny = slab_layout->grid().ny;
      for (int i = 0; 2 * i <= ny; ++i)
        factors[2 * i] = factors[2 * i + 1] = static_cast<Number>(scale * symbol(kx, i));
      for (int i = 1; 2 * i < ny; ++i)
        factors[2 * (ny - i)] = factors[2 * (ny - i) + 1] = factors[2 * i];
      const Number *factor  = factors.data();
      Number       *part    = reinterpret_cast<Number *>(values); // real, imaginary
      double        product = 0;
#pragma omp simd reduction(+ : product)
      for (int i = 0; i < 2 * ny; ++i)
        {
          product += factor[i] * (static_cast<double>(part[i]) * part[i]);
          part[i] *= factor[i];
        }
      return product;
    }

    SlabLayoutPtr          slab_layout;
    std::unique_ptr<Parts> parts;
    std::vector<Number>    factors; // of the real and imaginary parts of a column
    long                   pairs = 0;
  };

  /** In double precision. */
  using FourierTransform = BasicFourierTransform<double>;
} // namespace strait
