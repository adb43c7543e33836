// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/half_space.h>
#include <strait/contact/window_transfer.h>
#include <strait/contact/zoomed_operator.h>

#include <algorithm>
#include <array>

namespace strait
{
  namespace
  {
    /** The grid of a window's box at the spacing of the parent, or @p refined times
     *  finer. */
    PeriodicGrid
    box_grid(const SlabLayout &layout, const ZoomWindow &window, const int refined)
    {
      // Points of the parent around the window in its box. Half of it lets the images of
      // the box disturb the critical load by 2e-5, double of it costs a third more.
      constexpr int padding = 8;
      const auto [dx, dy]   = layout.spacing(window.parent);
      const int nx = window.nx + 2 * padding, ny = window.ny + 2 * padding;
      return {refined * nx, refined * ny, nx * dx, ny * dy};
    }

    /** Columns and rows of an array. */
    using Shape = std::array<int, 2>;

    template <class Number>
    Shape
    shape_of(const BasicFourierTransform<Number> &box)
    {
      return {{box.layout().grid().nx, box.layout().grid().ny}};
    }

    /** Call visit(position in the array, position in the box) for the points of an array
     *  in the middle of a box. */
    template <class Visit>
    void
    for_each_in_the_middle(const Shape &array, const Shape &box, const Visit &visit)
    {
      const int   x = (box[0] - array[0]) / 2, y = (box[1] - array[1]) / 2;
      std::size_t k = 0;
      for (int iy = 0; iy < array[1]; ++iy)
        for (int ix = 0; ix < array[0]; ++ix, ++k)
          visit(k, static_cast<std::size_t>(iy + y) * box[0] + x + ix);
    }

    /** The box of an array, zero around it. */
    template <class Number>
    void
    put_into_box(const Shape               &shape,
                 const std::vector<Number> &array,
                 const Shape               &shape_of_box,
                 std::vector<Number>       &box)
    {
      std::fill(box.begin(), box.end(), Number(0));
      for_each_in_the_middle(shape,
                             shape_of_box,
                             [&](const std::size_t k, const std::size_t at) {
                               box[at] = array[k];
                             });
    }
  } // namespace

  /** One window's share of the operator. */
  template <class Number>
  class ZoomedOperator<Number>::Window
  {
  public:
    Window(const SlabLayout &layout_, const int w)
      : number(w)
      , place(layout_.windows()[w])
      , layout(layout_)
      , transfer(place)
      , coarse_box(make_layout(box_grid(layout, place, 1), MPI_COMM_SELF))
      , fine_box(make_layout(box_grid(layout, place, 3), MPI_COMM_SELF))
      , patch(static_cast<std::size_t>(transfer.patch_columns()) * transfer.patch_rows())
      , own(static_cast<std::size_t>(place.n_columns()) * place.n_rows())
      , in_coarse_box(coarse_box.layout().n_local_points())
      , in_fine_box(fine_box.layout().n_local_points())
    {
    }

    /** Call visit(position in the patch, position among the values of this rank) for the
     *  points of the patch that this rank has. */
    template <class Visit>
    void
    for_each_of_patch(const Visit &visit) const
    {
      constexpr int margin = ZoomWindow::margin;
      layout.for_each_around(
        number, margin, [&](const int a, const int b, const std::size_t at) {
          visit(static_cast<std::size_t>(b + margin) * transfer.patch_columns() + a +
                  margin,
                at);
        });
    }

    const int                     number;
    const ZoomWindow              place;
    const SlabLayout             &layout;
    WindowTransfer<Number>        transfer;
    BasicFourierTransform<Number> coarse_box, fine_box;
    std::vector<Number>           patch, own; // of the parent; of the window
    std::vector<Number>           in_coarse_box, in_fine_box; // the same in their boxes
  };

  template <class Number>
  ZoomedOperator<Number>::ZoomedOperator(const SlabLayoutPtr &layout,
                                         const double         contact_modulus)
    : modulus(contact_modulus)
    , grid_transform(layout)
  {
    for (std::size_t w = 0; w < layout->windows().size(); ++w)
      windows.push_back(std::make_unique<Window>(*layout, static_cast<int>(w)));
  }

  template <class Number>
  ZoomedOperator<Number>::~ZoomedOperator() = default;

  template <class Number>
  void
  ZoomedOperator<Number>::apply(Number *values)
  {
    act(values, Symbol::compliance, [&]() {
      transform(grid_transform, values, Symbol::compliance);
    });
  }

  template <class Number>
  void
  ZoomedOperator<Number>::precondition(Number *values, TwoScaleOperator &grid_stiffness)
  {
    act(values, Symbol::stiffness, [&]() {
      grid_stiffness.apply(
        values, [](int) {}, [](int) {});
    });
  }

  template <class Number>
  template <class OnGrid>
  void
  ZoomedOperator<Number>::act(Number *values, const Symbol symbol, const OnGrid &on_grid)
  {
    clear_covered(values);
    gather_from_windows(values);
    on_grid();
    spread_to_windows(values, symbol);
    clear_covered(values);
  }

  template <class Number>
  void
  ZoomedOperator<Number>::clear_covered(Number *values) const
  {
    for (const auto &window : windows)
      layout().for_each_covered(window->number,
                                [values](const std::size_t parent, std::size_t) {
                                  values[parent] = 0;
                                });
  }

  /** Give each parent the mean of what its windows have; what it has itself at points
   *  that they cover is 0. */
  template <class Number>
  void
  ZoomedOperator<Number>::gather_from_windows(Number *values)
  {
    for (std::size_t w = windows.size(); w-- > 0;)
      {
        Window       &window = *windows[w];
        const Number *begin  = values + layout().start_of_window(window.number);
        std::copy_n(begin, window.own.size(), window.own.begin());
        window.transfer.deposit(window.own, window.patch);
        window.for_each_of_patch([&](const std::size_t k, const std::size_t at) {
          values[at] += window.patch[k];
        });
      }
  }

  /** Refine what the parents have found in their windows. */
  template <class Number>
  void
  ZoomedOperator<Number>::spread_to_windows(Number *values, const Symbol symbol)
  {
    for (const auto &each : windows)
      {
        Window     &window = *each;
        const Shape patch  = {
           {window.transfer.patch_columns(), window.transfer.patch_rows()}};
        const Shape own    = {{window.place.n_columns(), window.place.n_rows()}};
        const Shape coarse = shape_of(window.coarse_box);
        const Shape fine   = shape_of(window.fine_box);
        put_into_box(patch, window.patch, coarse, window.in_coarse_box);
        transform(window.coarse_box, window.in_coarse_box.data(), symbol);
        std::fill(window.patch.begin(), window.patch.end(), Number(0));
        window.for_each_of_patch([&](const std::size_t k, const std::size_t at) {
          window.patch[k] = values[at];
        });
        if (window.place.parent < 0)
          sum_in_place(layout().communicator(),
                       window.patch.data(),
                       static_cast<int>(window.patch.size()));
        for_each_in_the_middle(patch,
                               coarse,
                               [&](const std::size_t k, const std::size_t at) {
                                 window.patch[k] -= window.in_coarse_box[at];
                               });
        put_into_box(own, window.own, fine, window.in_fine_box);
        transform(window.fine_box, window.in_fine_box.data(), symbol);
        Number *result = values + layout().start_of_window(window.number);
        window.transfer.interpolate(window.patch, window.own);
        for_each_in_the_middle(own, fine, [&](const std::size_t k, const std::size_t at) {
          result[k] = window.own[k] + window.in_fine_box[at];
        });
      }
  }

  template <class Number>
  void
  ZoomedOperator<Number>::transform(BasicFourierTransform<Number> &box,
                                    Number                        *values,
                                    const Symbol                   symbol) const
  {
    const PeriodicGrid &grid = box.layout().grid();
    if (symbol == Symbol::stiffness)
      box.multiply(values, values, WaveStiffness(grid, modulus));
    else
      box.multiply(values, values, WaveCompliance<Number>(grid, modulus));
  }

  template class ZoomedOperator<double>;
  template class ZoomedOperator<float>;
} // namespace strait
