// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/spectral/fourier_transform.h>

#include <fftw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
  using namespace strait;

  /** Even, odd, prime and rectangular grids; some leave a rank without rows. */
  class FourierTransformOn : public testing::TestWithParam<PeriodicGrid>
  {
  protected:
    SlabLayoutPtr layout = make_layout(GetParam(), MPI_COMM_WORLD);

    /** Values that depend on the global point alone and have no symmetry. */
    SlabField
    any_field() const
    {
      SlabField field(layout);
      for (std::size_t i = 0; i < field.size(); ++i)
        {
          const double n = static_cast<double>(i) +
                           static_cast<double>(layout->first_row()) * GetParam().nx;
          field[i] = std::sin(12.9898 * n + 0.3 * n * n) + 0.1;
        }
      return field;
    }

    /** cos(2π(kx x/lx + ky y/ly) + phase). */
    SlabField
    plane_wave(const int kx, const int ky, const double phase) const
    {
      const PeriodicGrid &grid = GetParam();
      SlabField           field(layout);
      for (int row = 0; row < layout->n_rows(); ++row)
        for (int ix = 0; ix < grid.nx; ++ix)
          field(ix, row) =
            std::cos(2 * M_PI *
                       (static_cast<double>(kx) * ix / grid.nx +
                        static_cast<double>(ky) * (layout->first_row() + row) / grid.ny) +
                     phase);
      return field;
    }
  };

  double
  largest_difference(const SlabField &a, const SlabField &b)
  {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]));
    return maximum(a.layout().communicator(), largest);
  }

  TEST_P(FourierTransformOn, RoundTripAndParseval)
  {
    FourierTransform transform(layout);
    const SlabField  in = any_field();
    SlabField        out(layout);
    const double     product =
      sum(MPI_COMM_WORLD,
          transform.multiply(in.data(), out.data(), [](int, int) { return 1.; }));
    EXPECT_LT(largest_difference(in, out), 1e-13);
    double mean_square = 0;
    for (const double value : in)
      mean_square += value * value;
    mean_square =
      sum(MPI_COMM_WORLD, mean_square) / static_cast<double>(GetParam().n_points());
    EXPECT_NEAR(product, mean_square, 1e-13);
    EXPECT_EQ(transform.n_pairs(), 1);
  }

  TEST_P(FourierTransformOn, ProductOfFieldAndItsImage)
  {
    FourierTransform transform(layout);
    const SlabField  in = any_field();
    SlabField        out(layout);
    const auto       symbol = [](const int kx, const int ky) {
      return kx == 0 && ky == 0 ? 0. : 1 / std::hypot(kx, 1.3 * ky);
    };
    const double product =
      sum(MPI_COMM_WORLD, transform.multiply(in.data(), out.data(), symbol));
    double expected = 0;
    for (std::size_t i = 0; i < in.size(); ++i)
      expected += in[i] * out[i];
    expected = sum(MPI_COMM_WORLD, expected) / static_cast<double>(GetParam().n_points());
    EXPECT_NEAR(product, expected, 1e-13);
    EXPECT_NEAR(mean(out), 0., 1e-14);
  }

  // In place, as the contact solver transforms its steps, and into another array.
  TEST_P(FourierTransformOn, IsTheSameToSevenDigitsInSinglePrecision)
  {
    FourierTransform             transform(layout);
    BasicFourierTransform<float> single(layout);
    const SlabField              in = any_field();
    SlabField                    out(layout);
    const auto                   symbol = [](const int kx, const int ky) {
      return 1 / (1 + std::hypot(kx, 1.3 * ky));
    };
    const double expected =
      sum(MPI_COMM_WORLD, transform.multiply(in.data(), out.data(), symbol));
    std::vector<float> apart(in.size());
    std::copy(in.begin(), in.end(), single.scratch());
    for (float *result : {apart.data(), single.scratch()})
      {
        const double product =
          sum(MPI_COMM_WORLD, single.multiply(single.scratch(), result, symbol));
        EXPECT_NEAR(product, expected, 1e-6);
        for (std::size_t i = 0; i < out.size(); ++i)
          EXPECT_NEAR(result[i], out[i], 2e-6);
        std::copy(in.begin(), in.end(), single.scratch());
      }
  }

  TEST_P(FourierTransformOn, LaplacianOfPlaneWaves)
  {
    const PeriodicGrid &grid = GetParam();
    FourierTransform    transform(layout);
    const auto          laplacian = [&grid](const int kx, const int ky) {
      return -std::pow(2 * M_PI * kx / grid.lx, 2) - std::pow(2 * M_PI * ky / grid.ly, 2);
    };
    for (const auto &[kx, ky] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}})
      {
        const SlabField wave = plane_wave(kx, ky, 0.4);
        SlabField       image(layout);
        transform.multiply(wave.data(), image.data(), laplacian);
        SlabField expected = wave;
        for (double &value : expected)
          value *= laplacian(kx, ky);
        EXPECT_LT(largest_difference(image, expected),
                  1e-12 * std::abs(laplacian(kx, ky)));
      }
  }

  TEST_P(FourierTransformOn, SynthesisMakesPlaneWaves)
  {
    FourierTransform transform(layout);
    for (const auto &[kx, ky] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}})
      {
        const int  wave_x = kx, wave_y = ky;
        const auto mode = [=](const int mx, const int my) -> std::complex<double> {
          if (mx == wave_x && my == wave_y)
            return std::polar(0.5, 0.4);
          if (mx == -wave_x && my == -wave_y)
            return std::polar(0.5, -0.4);
          return 0.;
        };
        SlabField field(layout);
        transform.synthesize(field.data(), mode);
        EXPECT_LT(largest_difference(field, plane_wave(kx, ky, 0.4)), 1e-13);
      }
  }

  TEST_P(FourierTransformOn, AnalysisFindsPlaneWaves)
  {
    FourierTransform transform(layout);
    const SlabField  wave  = plane_wave(1, -1, 0.4);
    double           power = 0, error = 0;
    transform.analyze(wave.data(),
                      [&](const int                   kx,
                          const int                   ky,
                          const std::complex<double> &value,
                          const double                weight) {
                        power += weight * std::norm(value);
                        const auto expected = kx == 1 && ky == -1
                                                ? std::polar(0.5, 0.4)
                                                : std::complex<double>();
                        error               = std::max(error, std::abs(value - expected));
                      });
    EXPECT_NEAR(sum(MPI_COMM_WORLD, power), 0.5, 1e-14);
    EXPECT_LT(maximum(MPI_COMM_WORLD, error), 1e-14);
  }

  /** On larger grids as well, for which FFTW can choose from many plans. */
  class BitsOfFourierTransformOn : public FourierTransformOn
  {
  };

  /** Damp the short waves on the ranks of the layout; rank 0 gets the whole field. */
  std::vector<double>
  smoothed(const SlabField &in)
  {
    FourierTransform transform(in.layout_pointer());
    SlabField        out(in.layout_pointer());
    transform.multiply(in.data(), out.data(), [](const int kx, const int ky) {
      return 1 / (1 + std::hypot(kx, 1.3 * ky));
    });
    return gather_on_root(out);
  }

  TEST_P(BitsOfFourierTransformOn, OnAnyNumberOfRanks)
  {
    const std::vector<double> together = smoothed(any_field());
    const std::vector<double> whole    = gather_on_root(any_field());
    if (layout->rank() == 0)
      {
        EXPECT_EQ(together,
                  smoothed(
                    scatter_from_root(make_layout(GetParam(), MPI_COMM_SELF), whole)));
      }
  }

  TEST_P(BitsOfFourierTransformOn, WhateverWasMeasuredBefore)
  {
    const std::vector<double> before = smoothed(any_field());
    for (const int n : {GetParam().nx, GetParam().ny})
      {
        std::vector<std::complex<double>> in(n), out(n);
        auto                        *from  = reinterpret_cast<fftw_complex *>(in.data());
        auto                        *to    = reinterpret_cast<fftw_complex *>(out.data());
        auto                        *row   = reinterpret_cast<double *>(in.data());
        const std::vector<fftw_plan> plans = {
          fftw_plan_dft_1d(n, from, to, FFTW_FORWARD, FFTW_PATIENT),
          fftw_plan_dft_1d(n, to, from, FFTW_BACKWARD, FFTW_PATIENT),
          fftw_plan_dft_r2c_1d(n, row, to, FFTW_PATIENT),
          fftw_plan_dft_c2r_1d(n, to, row, FFTW_PATIENT)};
        for (const fftw_plan plan : plans)
          fftw_destroy_plan(plan);
      }
    EXPECT_EQ(before, smoothed(any_field()));
  }

  INSTANTIATE_TEST_SUITE_P(Grids,
                           FourierTransformOn,
                           testing::Values(PeriodicGrid{16, 16, 1., 1.},
                                           PeriodicGrid{15, 9, 1., 2.},
                                           PeriodicGrid{13, 13, 0.3, 0.3},
                                           PeriodicGrid{32, 7, 4., 1.},
                                           PeriodicGrid{7, 24, 1., 3.},
                                           PeriodicGrid{12, 3, 2., 1.},
                                           PeriodicGrid{3, 12, 2., 1.},
                                           PeriodicGrid{5, 4, 1., 1.}));

  INSTANTIATE_TEST_SUITE_P(Grids,
                           BitsOfFourierTransformOn,
                           testing::Values(PeriodicGrid{256, 128, 2., 1.},
                                           PeriodicGrid{90, 100, 1., 1.},
                                           PeriodicGrid{37, 60, 1., 1.},
                                           PeriodicGrid{12, 3, 2., 1.}));
} // namespace
