// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/two_scale_compliance.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strait
{
  namespace
  {
    /** Fine points per coarse one along x and along y. */
    constexpr int stride = 4;

    /** |q| √(dx dy) from the phases per point; @p aspect is dy/dx. */
    double
    phase(const double x, const double y, const double aspect)
    {
      return std::sqrt(x * x * aspect + y * y / aspect);
    }

    double
    aspect_of(const PeriodicGrid &grid)
    {
      return grid.dy() / grid.dx();
    }

    NinePointStencil
    fit_to_compliance(const double aspect, const double unit)
    {
      // The 0.15 keeps the weight of the longest waves finite: they are corrected later.
      return fit_stencil([=](const double x, const double y) {
        return unit / std::hypot(phase(x, y, aspect), .15);
      });
    }

    PeriodicGrid
    coarsened(const PeriodicGrid &fine)
    {
      return {fine.nx / stride, fine.ny / stride, fine.lx, fine.ly};
    }

    /** What is left of a wave by a mean over `stride` points. */
    double
    mean_of_wave(const double x)
    {
      return x == 0 ? 1. : std::sin(stride * x / 2) / (stride * std::sin(x / 2));
    }

    /** 1 for long waves, falls around the shortest wave of the coarse grid. The ends
     *  make the range of M K narrowest. */
    double
    taper(const double theta)
    {
      const double s = std::clamp((theta * stride / M_PI - .25) / 1.2, 0., 1.);
      return 1 - s * s * (3 - 2 * s);
    }
  } // namespace

  bool
  TwoScaleCompliance::suits(const PeriodicGrid &grid)
  {
    if (grid.nx % stride != 0 || grid.ny % stride != 0 ||
        std::min(grid.nx, grid.ny) < 8 * stride)
      return false;
    const double aspect = aspect_of(grid);
    return std::max(aspect, 1 / aspect) < 1.5;
  }

  TwoScaleCompliance::TwoScaleCompliance(SlabLayoutPtr fine_layout,
                                         const double  contact_modulus,
                                         const double  uniform)
    : layout(std::move(fine_layout))
    , unit(2 * std::sqrt(layout->grid().dx() * layout->grid().dy()) / contact_modulus)
    , stencil(fit_to_compliance(aspect_of(layout->grid()), unit))
    , sweep(stencil, layout->grid().nx)
    , coarse_transform(make_layout(coarsened(layout->grid()), layout->communicator()))
    , restricted(layout->n_local_points() / stride)
    , coarse(coarse_transform.layout().n_local_points())
    , between(layout->grid().nx / stride)
    , correction_line(layout->grid().nx)
  {
    const PeriodicGrid &fine   = layout->grid();
    const double        aspect = aspect_of(fine);
    for (int ky = 0; 2 * stride * ky <= fine.ny; ++ky)
      for (int kx = 0; 2 * stride * kx <= fine.nx; ++kx)
        {
          const double x = 2 * M_PI / fine.nx * kx, y = 2 * M_PI / fine.ny * ky;
          const bool   is_mean  = kx == 0 && ky == 0;
          const double wanted   = is_mean ? uniform : unit / phase(x, y, aspect);
          const double transfer = std::pow(mean_of_wave(x) * mean_of_wave(y), 4);
          symbol.push_back(std::max(0., wanted - stencil.symbol(x, y)) *
                           taper(std::hypot(x, y)) / transfer);
        }
  }

  void
  TwoScaleCompliance::apply(double                         *values,
                            const std::function<void(int)> &before,
                            const std::function<void(int)> &after)
  {
    const int  nx = layout->grid().nx, n_rows = layout->n_rows();
    const auto row_of = [=](const int row) {
      return values + static_cast<std::size_t>(row) * nx;
    };
    for (int row = 0; row < n_rows; ++row)
      {
        before(row);
        restrict_row(row_of(row), row);
      }
    find_corrections();

    std::vector<int> outside;
    if (n_rows > 0)
      outside = {layout->first_row() - 1, layout->first_row() + n_rows};
    const std::vector<double> beyond = fetch_rows(*layout, values, nx, outside);
    if (n_rows == 0)
      return;
    sweep.begin(beyond.data());
    for (int row = 0; row < n_rows; ++row)
      {
        expand_correction(row);
        sweep.apply(row_of(row),
                    row + 1 < n_rows ? row_of(row + 1) : beyond.data() + nx,
                    correction_line.data());
        after(row);
      }
  }

  /** The adjoint of linear interpolation along x, as a mean. */
  void
  TwoScaleCompliance::restrict_row(const double *values, const int row)
  {
    const int    n       = layout->grid().nx / stride;
    double      *result  = restricted.data() + static_cast<std::size_t>(row) * n;
    const double share[] = {4 / 16., 3 / 16., 2 / 16., 1 / 16.};
    const auto   mean    = [&](const double *left, const double *here) {
      double sum = share[0] * here[0];
      for (int k = 1; k < stride; ++k)
        sum += share[k] * (left[stride - k] + here[k]);
      return sum;
    };
    result[0] = mean(values + stride * (n - 1), values);
    for (int i = 1; i < n; ++i)
      result[i] = mean(values + stride * (i - 1), values + stride * i);
  }

  /** The same along y, and what is to be added to the stencil at the coarse points. */
  void
  TwoScaleCompliance::find_corrections()
  {
    const PeriodicGrid &fine  = layout->grid();
    const SlabLayout   &slabs = coarse_transform.layout();
    const int           n     = fine.nx / stride;
    // From the one before a coarse row to that after the next.
    std::vector<int> wanted(slabs.n_rows() > 0 ? stride * slabs.n_rows() + stride - 1
                                               : 0);
    std::iota(wanted.begin(), wanted.end(), stride * (slabs.first_row() - 1) + 1);
    const std::vector<double> rows = fetch_rows(*layout, restricted.data(), n, wanted);
    std::fill(coarse.begin(), coarse.end(), 0.);
    for (int row = 0; row < slabs.n_rows(); ++row)
      for (int k = 1; k < 2 * stride; ++k)
        {
          const double  weight = (stride - std::abs(k - stride)) / (1. * stride * stride);
          const double *line =
            rows.data() + static_cast<std::size_t>(stride * row + k - 1) * n;
          double *sum = coarse.data() + static_cast<std::size_t>(row) * n;
          for (int i = 0; i < n; ++i)
            sum[i] += weight * line[i];
        }

    coarse_transform.multiply(
      coarse.data(), coarse.data(), [this](const int kx, const int ky) {
        return symbol[std::abs(ky) * (layout->grid().nx / (2 * stride) + 1) + kx];
      });

    std::vector<int> around;
    if (layout->n_rows() > 0)
      {
        const int first = layout->first_row() / stride;
        const int last  = (layout->first_row() + layout->n_rows() - 1) / stride + 1;
        around.resize(last - first + 1);
        std::iota(around.begin(), around.end(), first);
      }
    corrections = fetch_rows(slabs, coarse.data(), n, around);
  }

  /** The correction along the local row. */
  void
  TwoScaleCompliance::expand_correction(const int row)
  {
    const int     n = layout->grid().nx / stride, y = layout->first_row() + row;
    const double *above =
      corrections.data() +
      static_cast<std::size_t>(y / stride - layout->first_row() / stride) * n;
    const double share = (y % stride) / static_cast<double>(stride);
    for (int i = 0; i < n; ++i)
      between[i] = (1 - share) * above[i] + share * above[n + i];
    for (int i = 0; i < n; ++i)
      {
        const double here = between[i],
                     step = (between[i + 1 < n ? i + 1 : 0] - here) / stride;
        for (int k = 0; k < stride; ++k)
          correction_line[stride * i + k] = here + k * step;
      }
  }

  std::size_t
  TwoScaleCompliance::memory_consumption() const
  {
    // Rows that are fetched count as those that are sent.
    const std::size_t n_values = 2 * restricted.size() + coarse.size() + symbol.size() +
                                 corrections.size() + between.size() +
                                 correction_line.size();
    return n_values * sizeof(double) + sweep.memory_consumption() +
           coarse_transform.memory_consumption();
  }
} // namespace strait
