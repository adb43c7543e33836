// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/fill_windows.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace strait
{
  namespace
  {
    using Complex = std::complex<double>;

    // So many points are summed at a time, a power of 2. With half as many the processor
    // waits for the last results; twice as many take no less time.
    constexpr int n_at_once = 8;

    /** Call @p add with the first of up to n_at_once points out of @p n, their number,
     * and the real and imaginary parts there of a wave that has the value @p start at the
     *  first of all, and is multiplied with @p turn from point to point. */
    template <class Add>
    void
    follow_wave(const Complex &start, const Complex &turn, const int n, const Add &add)
    {
      std::array<double, n_at_once> re, im;
      Complex                       value = start;
      for (int k = 0; k < n_at_once; ++k, value *= turn)
        {
          re[k] = value.real();
          im[k] = value.imag();
        }
      Complex jump = turn;
      for (int power = 1; power < n_at_once; power *= 2)
        jump *= jump;
      const double c = jump.real(), s = jump.imag();
      for (int first = 0; first < n; first += n_at_once)
        {
          add(first, std::min(n_at_once, n - first), re, im);
          for (int k = 0; k < n_at_once; ++k)
            {
              const double turned = re[k] * c - im[k] * s;
              im[k]               = re[k] * s + im[k] * c;
              re[k]               = turned;
            }
        }
    }

    /** The Fourier series of a field on the rows of one window, wave after wave. */
    class WindowSeries
    {
    public:
      WindowSeries(const SlabLayout &layout, const int w, double *values_)
        : n_columns(layout.windows()[w].n_columns())
        , real_sums(layout.windows()[w].n_rows())
        , imaginary_sums(real_sums.size())
        , values(values_)
      {
        const PeriodicGrid &grid = layout.grid();
        const auto [x, y]        = layout.position(w, 0, 0);
        const auto [dx, dy]      = layout.spacing(w);
        first                    = {2 * M_PI * x / grid.lx, 2 * M_PI * y / grid.ly};
        step                     = {2 * M_PI * dx / grid.lx, 2 * M_PI * dy / grid.ly};
      }

      /** Add a wave of the column kx that add_column() will end. */
      void
      add_wave(const int ky, const Complex &amplitude)
      {
        follow_wave(amplitude * std::polar(1., ky * first[1]),
                    std::polar(1., ky * step[1]),
                    static_cast<int>(real_sums.size()),
                    [this](const int iy, const int n, const auto &re, const auto &im) {
                      for (int k = 0; k < n; ++k)
                        {
                          real_sums[iy + k] += re[k];
                          imaginary_sums[iy + k] += im[k];
                        }
                    });
      }

      void
      add_column(const int kx)
      {
        const Complex start = std::polar(1., kx * first[0]);
        const Complex turn  = std::polar(1., kx * step[0]);
        for (std::size_t iy = 0; iy < real_sums.size(); ++iy)
          {
            double *row = values + iy * n_columns;
            follow_wave(Complex(real_sums[iy], imaginary_sums[iy]) * start,
                        turn,
                        n_columns,
                        [row](const int ix, const int n, const auto &re, const auto &) {
                          for (int k = 0; k < n; ++k)
                            row[ix + k] += re[k];
                        });
            real_sums[iy] = imaginary_sums[iy] = 0.;
          }
      }

    private:
      int                   n_columns;
      std::vector<double>   real_sums, imaginary_sums; // of the waves, on each row
      double               *values;
      std::array<double, 2> first, step; // phases of the longest waves
    };
  } // namespace

  void
  copy_to_covered(SlabField &field)
  {
    for (int w = static_cast<int>(field.layout().windows().size()) - 1; w >= 0; --w)
      field.layout().for_each_covered(w,
                                      [&field](const std::size_t parent,
                                               const std::size_t own) {
                                        field[parent] = field[own];
                                      });
  }

  void
  fill_windows(SlabField &field)
  {
    const SlabLayout &layout    = field.layout();
    const int         n_windows = static_cast<int>(layout.windows().size());
    if (n_windows == 0)
      return;
    std::fill(field.begin() + static_cast<std::ptrdiff_t>(layout.n_local_points()),
              field.end(),
              0.);
    std::vector<WindowSeries> series;
    series.reserve(n_windows);
    for (int w = 0; w < n_windows; ++w)
      series.emplace_back(layout, w, field.data() + layout.start_of_window(w));

    // Waves below the rounding of the field are rounding themselves.
    const double negligible = std::numeric_limits<double>::epsilon() * rms(field);
    int          column     = -1;
    const auto   end_column = [&]() {
      if (column >= 0)
        for (WindowSeries &window : series)
          window.add_column(column);
      column = -1;
    };
    FourierTransform(field.layout_pointer())
      .analyze(
        field.data(),
        [&](const int kx, const int ky, const Complex &amplitude, const double weight) {
          if (kx != column)
            end_column();
          if (std::abs(amplitude) <= negligible && (kx != 0 || ky != 0))
            return;
          column = kx;
          for (WindowSeries &window : series)
            window.add_wave(ky, weight * amplitude);
        });
    end_column();
    sum_in_place(layout.communicator(),
                 field.data() + layout.n_local_points(),
                 static_cast<int>(field.size() - layout.n_local_points()));
  }
} // namespace strait
