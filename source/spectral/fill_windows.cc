// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/fill_windows.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace strait
{
  namespace
  {
    using Complex = std::complex<double>;

    /** Sums the Fourier series of a field at the points of one window, wave by wave. */
    class WindowSeries
    {
    public:
      WindowSeries(const SlabLayout &layout, const int w, double *values_)
        : n_columns(layout.windows()[w].n_columns())
        , n_rows(layout.windows()[w].n_rows())
        , row_sums(n_rows + n_lanes - 1)
        , values(values_)
      {
        const PeriodicGrid &grid = layout.grid();
        const auto [x, y]        = layout.position(w, 0, 0);
        const auto [dx, dy]      = layout.spacing(w);
        first                    = {2 * M_PI * x / grid.lx, 2 * M_PI * y / grid.ly};
        step                     = {2 * M_PI * dx / grid.lx, 2 * M_PI * dy / grid.ly};
      }

      /** Add a wave of the column kx that add_column() is called with next. */
      void
      add_wave(const int ky, const Complex &amplitude)
      {
        Complex       value = amplitude * std::polar(1., ky * first[1]);
        const Complex turn  = std::polar(1., ky * step[1]);
        // A single value that is turned from row to row waits for the one before; several
        // do not.
        std::array<double, n_lanes> re, im;
        for (int lane = 0; lane < n_lanes; ++lane, value *= turn)
          {
            re[lane] = value.real();
            im[lane] = value.imag();
          }
        const Complex turn_all = std::pow(turn, n_lanes);
        const double  c = turn_all.real(), s = turn_all.imag();
        for (int row = 0; row < n_rows; row += n_lanes)
          for (int lane = 0; lane < n_lanes; ++lane)
            {
              row_sums[row + lane] += Complex(re[lane], im[lane]);
              const double turned = re[lane] * c - im[lane] * s;
              im[lane]            = re[lane] * s + im[lane] * c;
              re[lane]            = turned;
            }
      }

      void
      add_column(const int kx)
      {
        const Complex start = std::polar(1., kx * first[0]);
        const Complex turn  = std::polar(1., kx * step[0]);
        double       *value = values;
        for (int row = 0; row < n_rows; ++row)
          {
            Complex wave = row_sums[row] * start;
            for (int ix = 0; ix < n_columns; ++ix)
              {
                *value++ += wave.real();
                wave *= turn;
              }
          }
        std::fill(row_sums.begin(), row_sums.end(), 0.);
      }

    private:
      static constexpr int n_lanes = 4;

      int                   n_columns, n_rows;
      std::vector<Complex>  row_sums; // and some after the last row
      double               *values;
      std::array<double, 2> first, step; // phases of the longest waves, in x and y
    };
  } // namespace

  void
  copy_to_covered(SlabField &field)
  {
    field.layout().for_each_covered(
      [&field](const std::size_t parent, const std::size_t own) {
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

    // Waves below the rounding error of the field are nothing but rounding errors.
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
                 field.size() - layout.n_local_points());
  }
} // namespace strait
