// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/two_scale_operator.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strait
{
  namespace
  {
    /** Fine points per coarse one along x and along y. Half of it makes the transforms of
     *  the coarse grid four times as expensive, double of it leaves waves of up to 16
     *  points to a stencil that does not fit them. */
    constexpr int stride = 4;

    /** |q| √(dx dy) from the phases per point. */
    double
    phase(const PeriodicGrid &grid, const double x, const double y)
    {
      const double aspect = grid.dy() / grid.dx();
      return std::sqrt(x * x * aspect + y * y / aspect);
    }

    bool
    has_coarse_grid(const PeriodicGrid &grid)
    {
      return grid.nx % stride == 0 && grid.ny % stride == 0 &&
             std::min(grid.nx, grid.ny) >= 8 * stride;
    }

    /** What is left of a wave by a mean over `stride` points. */
    double
    mean_of_wave(const double x)
    {
      return x == 0 ? 1. : std::sin(stride * x / 2) / (stride * std::sin(x / 2));
    }

    /** 1 up to the phase @p begin and 0 from @p end, in units of the shortest wave of the
     *  coarse grid. */
    double
    taper(const double theta, const double begin, const double end)
    {
      const double s =
        std::clamp((theta * stride / M_PI - begin) / (end - begin), 0., 1.);
      return 1 - s * s * (3 - 2 * s);
    }

    /**
     * Replace the row @p values of a periodic line of points by the stencil's values plus
     * @p added. @p above is the row above as it was, and then this one; @p below is the
     * row after it; @p mixed, two longer, is overwritten.
     */
    template <class Number>
    void
    apply_stencil(const NinePointStencil    &stencil,
                  Number                    *values,
                  std::vector<Number>       &above,
                  const Number              *below,
                  const std::vector<Number> &added,
                  std::vector<Number>       &mixed)
    {
      const auto nx = static_cast<int>(above.size());
      Number    *up = above.data(), *side = mixed.data() + 1;
      const auto centre = static_cast<Number>(stencil.centre),
                 x = static_cast<Number>(stencil.x), y = static_cast<Number>(stencil.y),
                 diagonal = static_cast<Number>(stencil.diagonal);
      for (int i = 0; i < nx; ++i)
        {
          const Number vertical = up[i] + below[i];
          up[i]                 = values[i];
          side[i]               = x * up[i] + diagonal * vertical;
          values[i]             = centre * up[i] + y * vertical;
        }
      side[-1] = side[nx - 1];
      side[nx] = side[0];
      for (int i = 0; i < nx; ++i)
        values[i] += (side[i - 1] + side[i + 1]) + added[i];
    }
  } // namespace

  bool
  TwoScaleOperator::suits_compliance(const PeriodicGrid &grid)
  {
    const double aspect = grid.dy() / grid.dx();
    return has_coarse_grid(grid) && std::max(aspect, 1 / aspect) < 1.5;
  }

  TwoScaleOperator::TwoScaleOperator(const SlabLayoutPtr &fine_layout,
                                     const Transfer       transfer_,
                                     const double         contact_modulus,
                                     const double         uniform)
    : layout(fine_layout)
    , transfer(transfer_)
    , modulus(contact_modulus)
    // 0.15 is the phase of a wave 42 points long: longer ones, which are corrected on the
    // coarse grid, count no more in the fit. A smaller value fits the long waves at the
    // expense of the short ones.
    , stencil(fit_stencil([this](const double x, const double y) {
      return symbol(std::hypot(phase(layout->grid(), x, y), .15));
    }))
  {
    const PeriodicGrid &fine = layout->grid();
    if (!has_coarse_grid(fine))
      return;
    coarse_transform = std::make_unique<FourierTransform>(
      make_layout({fine.nx / stride, fine.ny / stride, fine.lx, fine.ly},
                  layout->communicator()));
    coarse_line.resize(fine.nx / stride);
    if (const int n_rows = layout->n_rows(); n_rows > 0)
      {
        const int first = layout->first_row() / stride;
        const int last  = (layout->first_row() + n_rows - 1) / stride;
        around.resize(last - first + (transfer == Transfer::linear ? 2 : 1));
        std::iota(around.begin(), around.end(), first);
      }
    near_rows.resize(around.size() * coarse_line.size());
    for (int ky = 0; 2 * stride * ky <= fine.ny; ++ky)
      for (int kx = 0; 2 * stride * kx <= fine.nx; ++kx)
        {
          const double x = 2 * M_PI / fine.nx * kx, y = 2 * M_PI / fine.ny * ky;
          const double wanted = kx == 0 && ky == 0 ? uniform : symbol(phase(fine, x, y));
          coarse_symbol.push_back(correction(x, y, wanted - stencil.symbol(x, y)));
        }
  }

  double
  TwoScaleOperator::symbol(const double of_phase) const
  {
    const double spacing = std::sqrt(layout->grid().dx() * layout->grid().dy());
    return transfer == Transfer::constant ? modulus / (2 * spacing) * of_phase
                                          : 2 * spacing / modulus / of_phase;
  }

  /** What a wave on the coarse grid is multiplied by, where @p missing is what the
   *  stencil lacks. The ends of the tapers make the range of M over S narrowest. */
  double
  TwoScaleOperator::correction(const double x, const double y, const double missing) const
  {
    const double theta = std::hypot(x, y);
    if (transfer == Transfer::constant)
      return missing * taper(theta, .5, 1.) / (stride * stride);
    // Linear interpolation and its adjoint weaken the wave, and M must stay positive.
    const double weakened = std::pow(mean_of_wave(x) * mean_of_wave(y), 4);
    return std::max(0., missing) * taper(theta, .25, 1.45) / weakened;
  }

  template <class Number>
  void
  TwoScaleOperator::apply(Number                         *values,
                          const std::function<void(int)> &before,
                          const std::function<void(int)> &after)
  {
    const int  nx = layout->grid().nx, n_rows = layout->n_rows();
    const auto row_of = [=](const int row) {
      return values + static_cast<std::size_t>(row) * nx;
    };
    std::fill(near_rows.begin(), near_rows.end(), 0.);
    for (int row = 0; row < n_rows; ++row)
      {
        before(row);
        if (coarse_transform)
          restrict_row(row_of(row), row);
      }
    if (coarse_transform)
      find_corrections();

    std::vector<int> outside;
    if (n_rows > 0)
      outside = {layout->first_row() - 1, layout->first_row() + n_rows};
    const std::vector<Number> beyond = fetch_rows(*layout, values, nx, outside);
    if (n_rows == 0)
      return;
    std::vector<Number> above(beyond.begin(), beyond.begin() + nx), mixed(nx + 2),
      correction_line(nx);
    for (int row = 0; row < n_rows; ++row)
      {
        if (coarse_transform)
          expand_row(row, correction_line);
        apply_stencil(stencil,
                      row_of(row),
                      above,
                      row + 1 < n_rows ? row_of(row + 1) : beyond.data() + nx,
                      correction_line,
                      mixed);
        after(row);
      }
  }

  /** The near row above the local row, or on it. */
  double *
  TwoScaleOperator::row_above(const int row)
  {
    const int index = (layout->first_row() + row) / stride - around[0];
    return near_rows.data() + index * coarse_line.size();
  }

  /** The adjoint of expand_row(). */
  template <class Number>
  void
  TwoScaleOperator::restrict_row(const Number *values, const int row)
  {
    const auto n     = static_cast<int>(coarse_line.size());
    double    *above = row_above(row);
    if (transfer == Transfer::constant)
      {
        for (int i = 0; i < n; ++i)
          above[i] += (values[stride * i] + values[stride * i + 1]) +
                      (values[stride * i + 2] + values[stride * i + 3]);
        return;
      }
    const double share[] = {4 / 16., 3 / 16., 2 / 16., 1 / 16.};
    for (int i = 0; i < n; ++i)
      {
        const Number *left = values + stride * (i > 0 ? i - 1 : n - 1);
        const Number *here = values + stride * i;
        double        sum  = share[0] * here[0];
        for (int k = 1; k < stride; ++k)
          sum += share[k] * (left[stride - k] + here[k]);
        coarse_line[i] = sum;
      }
    const int    k        = (layout->first_row() + row) % stride;
    const double of_above = share[k], of_below = k > 0 ? share[stride - k] : 0.;
    for (int i = 0; i < n; ++i)
      {
        above[i] += of_above * coarse_line[i];
        above[n + i] += of_below * coarse_line[i];
      }
  }

  /** What is to be added to the stencil's values, on the near rows. */
  void
  TwoScaleOperator::find_corrections()
  {
    const SlabLayout   &slabs = coarse_transform->layout();
    std::vector<double> coarse(slabs.n_local_points());
    add_rows(slabs, around, near_rows, coarse.data());
    const int n_waves = slabs.grid().nx / 2 + 1;
    coarse_transform->multiply(coarse.data(),
                               coarse.data(),
                               [this, n_waves](const int kx, const int ky) {
                                 return coarse_symbol[std::abs(ky) * n_waves + kx];
                               });
    near_rows = fetch_rows(slabs, coarse.data(), slabs.grid().nx, around);
  }

  /** The correction along the local row. */
  template <class Number>
  void
  TwoScaleOperator::expand_row(const int row, std::vector<Number> &correction_line)
  {
    const auto    n     = static_cast<int>(coarse_line.size());
    const double *above = row_above(row);
    const int     k     = (layout->first_row() + row) % stride;
    if (transfer == Transfer::constant)
      {
        if (row == 0 || k == 0)
          for (int i = 0; i < n; ++i)
            std::fill_n(correction_line.begin() + stride * i,
                        stride,
                        static_cast<Number>(above[i]));
        return;
      }
    const double share = k / static_cast<double>(stride);
    for (int i = 0; i < n; ++i)
      coarse_line[i] = (1 - share) * above[i] + share * above[n + i];
    for (int i = 0; i < n; ++i)
      {
        const double here = coarse_line[i],
                     step = (coarse_line[i + 1 < n ? i + 1 : 0] - here) / stride;
        for (int j = 0; j < stride; ++j)
          correction_line[stride * i + j] = static_cast<Number>(here + j * step);
      }
  }

  template void TwoScaleOperator::apply(float *,
                                        const std::function<void(int)> &,
                                        const std::function<void(int)> &);
  template void TwoScaleOperator::apply(double *,
                                        const std::function<void(int)> &,
                                        const std::function<void(int)> &);
} // namespace strait
