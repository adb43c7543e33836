// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/two_scale_preconditioner.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strait
{
  namespace
  {
    /** Points of a box along x and along y. */
    constexpr int box = 4;

    /** 1 for long waves, 0 beyond the shortest wave of the coarse grid. */
    double
    taper(const double theta)
    {
      const double s = 2 * theta * box / M_PI - 1; // 0 at π/8, 1 at π/4
      if (s <= 0)
        return 1;
      return s < 1 ? 1 - s * s * (3 - 2 * s) : 0.;
    }
  } // namespace

  TwoScalePreconditioner::TwoScalePreconditioner(SlabLayoutPtr fine_layout)
    : layout(std::move(fine_layout))
    , aspect(layout->grid().dy() / layout->grid().dx())
    , stencil(fit_to_symbol(aspect))
    , sweep(stencil, layout->grid().nx)
  {
    const PeriodicGrid &fine = layout->grid();
    correction_line.resize(fine.nx);
    if (fine.nx % box != 0 || fine.ny % box != 0 || std::min(fine.nx, fine.ny) < 8 * box)
      return;

    const PeriodicGrid coarse = {fine.nx / box, fine.ny / box, fine.lx, fine.ly};
    coarse_transform =
      std::make_unique<FourierTransform>(make_layout(coarse, layout->communicator()));
    const SlabLayout &slabs = coarse_transform->layout();
    box_values.resize(slabs.n_local_points());
    const bool mine_are_local = layout->first_row() == box * slabs.first_row() &&
                                layout->n_rows() == box * slabs.n_rows();
    coarse_rows_are_local =
      minimum(layout->communicator(), mine_are_local ? 1. : 0.) == 1.;
    if (!coarse_rows_are_local)
      row_sums.resize(static_cast<std::size_t>(layout->n_rows()) * coarse.nx);
  }

  /** To |q| in units of its value at the shortest wave. */
  NinePointStencil
  TwoScalePreconditioner::fit_to_symbol(const double aspect)
  {
    // The 0.15 keeps the weight of the longest waves finite: they are corrected later.
    return fit_stencil([=](const double x, const double y) {
      return std::sqrt(x * x * aspect + y * y / aspect + 0.15 * 0.15) / M_PI;
    });
  }

  void
  TwoScalePreconditioner::apply(double *values)
  {
    apply(
      values, [](int) {}, [](int) {});
  }

  void
  TwoScalePreconditioner::apply(double                         *values,
                                const std::function<void(int)> &before,
                                const std::function<void(int)> &after)
  {
    const int  nx = layout->grid().nx, n_rows = layout->n_rows();
    const auto row_of = [=](const int row) {
      return values + static_cast<std::size_t>(row) * nx;
    };
    std::fill(box_values.begin(), box_values.end(), 0.);
    std::fill(row_sums.begin(), row_sums.end(), 0.);
    for (int row = 0; row < n_rows; ++row)
      {
        before(row);
        if (coarse_transform)
          add_to_boxes(row_of(row), row);
      }
    if (coarse_transform)
      {
        collect_boxes();
        find_corrections();
      }

    const std::vector<double> beyond = rows_beyond(values);
    if (n_rows == 0)
      return;
    sweep.begin(beyond.data());
    for (int row = 0; row < n_rows; ++row)
      {
        if (coarse_transform && (row == 0 || (layout->first_row() + row) % box == 0))
          expand_corrections(row);
        sweep.apply(row_of(row),
                    row + 1 < n_rows ? row_of(row + 1) : beyond.data() + nx,
                    correction_line.data());
        after(row);
      }
  }

  /** The rows before the first and after the last one of this rank. */
  std::vector<double>
  TwoScalePreconditioner::rows_beyond(const double *values) const
  {
    const int        nx = layout->grid().nx, n_rows = layout->n_rows();
    std::vector<int> wanted;
    if (n_rows > 0)
      wanted = {layout->first_row() - 1, layout->first_row() + n_rows};
    return fetch_rows(*layout, values, nx, wanted);
  }

  /** The corrections of the boxes that the local row lies in, point by point. */
  void
  TwoScalePreconditioner::expand_corrections(const int row)
  {
    const int     n          = layout->grid().nx / box;
    const int     coarse_row = (layout->first_row() + row) / box;
    const double *corrections =
      (coarse_rows_are_local ? box_values : fetched_corrections).data() +
      static_cast<std::size_t>(coarse_row - first_correction_row) * n;
    for (int i = 0; i < n; ++i)
      std::fill_n(correction_line.begin() + box * i, box, corrections[i]);
  }

  /** Turn the box values into what is to be added to the points of each box. */
  void
  TwoScalePreconditioner::find_corrections()
  {
    const PeriodicGrid &fine = layout->grid();
    std::vector<double> cos_x(fine.nx / box + 1), cos_y(fine.ny / box + 1);
    const double        step_x = 2 * M_PI / fine.nx, step_y = 2 * M_PI / fine.ny;
    for (std::size_t k = 0; k < cos_x.size(); ++k)
      cos_x[k] = std::cos(step_x * k);
    for (std::size_t k = 0; k < cos_y.size(); ++k)
      cos_y[k] = std::cos(step_y * k);
    const NinePointStencil s = stencil;
    coarse_transform->multiply(
      box_values.data(), box_values.data(), [&](const int kx, const int ky) {
        const double x = step_x * kx, y = step_y * ky;
        const double cx = cos_x[kx], cy = cos_y[std::abs(ky)];
        const double exact = std::sqrt(x * x * aspect + y * y / aspect) / M_PI;
        const double symbol =
          s.centre + 2 * (s.x * cx + s.y * cy) + 4 * s.diagonal * cx * cy;
        return (exact - symbol) * taper(std::sqrt(x * x + y * y)) / (box * box);
      });

    first_correction_row = layout->first_row() / box;
    if (coarse_rows_are_local)
      return;
    std::vector<int> wanted;
    if (layout->n_rows() > 0)
      {
        const int last = (layout->first_row() + layout->n_rows() - 1) / box;
        wanted.resize(last - first_correction_row + 1);
        std::iota(wanted.begin(), wanted.end(), first_correction_row);
      }
    fetched_corrections =
      fetch_rows(coarse_transform->layout(), box_values.data(), fine.nx / box, wanted);
  }

  void
  TwoScalePreconditioner::add_to_boxes(const double *values, const int row)
  {
    const int         n = layout->grid().nx / box;
    const std::size_t target =
      static_cast<std::size_t>(coarse_rows_are_local ? row / box : row) * n;
    double *sums = (coarse_rows_are_local ? box_values : row_sums).data() + target;
    for (int i = 0; i < n; ++i)
      sums[i] += (values[box * i] + values[box * i + 1]) +
                 (values[box * i + 2] + values[box * i + 3]);
  }

  /** Where boxes lie on several ranks, add what each has summed along its rows. */
  void
  TwoScalePreconditioner::collect_boxes()
  {
    if (coarse_rows_are_local)
      return;
    const int         n      = layout->grid().nx / box;
    const SlabLayout &coarse = coarse_transform->layout();
    std::vector<int>  wanted(box * coarse.n_rows());
    std::iota(wanted.begin(), wanted.end(), box * coarse.first_row());
    const std::vector<double> sums = fetch_rows(*layout, row_sums.data(), n, wanted);
    for (std::size_t row = 0; row < wanted.size(); ++row)
      for (int i = 0; i < n; ++i)
        box_values[(row / box) * n + i] += sums[row * n + i];
  }

  std::size_t
  TwoScalePreconditioner::memory_consumption() const
  {
    const std::size_t n_values = box_values.size() + row_sums.size() +
                                 fetched_corrections.size() + correction_line.size();
    return n_values * sizeof(double) + sweep.memory_consumption() +
           (coarse_transform ? coarse_transform->memory_consumption() : 0);
  }
} // namespace strait
