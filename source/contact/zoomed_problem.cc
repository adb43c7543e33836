// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/signals.h>
#include <strait/contact/window_transfer.h>
#include <strait/contact/zoomed_problem.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    /** Padding of a window in its box, in points of the parent. With half of it the
     *  periodic images disturb the critical load by 2e-5; double of it costs a third
     *  more. */
    constexpr int padding = 8;

    /** The grid of a window's box, @p refined times finer than the parent. */
    PeriodicGrid
    box_grid(const SlabLayout &layout, const ZoomWindow &window, const int refined)
    {
      const auto [dx, dy] = layout.spacing(window.parent);
      const int nx = window.nx + 2 * padding, ny = window.ny + 2 * padding;
      return {refined * nx, refined * ny, nx * dx, ny * dy};
    }
  } // namespace

  /** A periodic box around a rectangular array. */
  template <class Number>
  class WindowBox
  {
  public:
    /** A box with a rim of @p rim_ points around the array. */
    WindowBox(const PeriodicGrid &grid, const int rim_)
      : transform(make_layout(grid, MPI_COMM_SELF))
      , rim(rim_)
      , values(grid.n_points())
    {
    }

    /** Take @p array with zeros around it, multiplied by the symbol symbol_of(grid). */
    template <class SymbolOf>
    void
    take(const Number *array, const SymbolOf &symbol_of)
    {
      std::fill(values.begin(), values.end(), Number(0));
      for_each([&](const std::size_t k, Number &value) { value = array[k]; });
      transform.multiply(values.data(),
                         values.data(),
                         symbol_of(transform.layout().grid()));
    }

    /** Call visit(k, value) for the points k of the array; it may change the value. */
    template <class Visit>
    void
    for_each(const Visit &visit)
    {
      const PeriodicGrid &grid = transform.layout().grid();
      std::size_t         k    = 0;
      for (int iy = rim; iy < grid.ny - rim; ++iy)
        for (int ix = rim; ix < grid.nx - rim; ++ix)
          visit(k++, values[static_cast<std::size_t>(iy) * grid.nx + ix]);
    }

  private:
    BasicFourierTransform<Number> transform;
    const int                     rim;
    std::vector<Number>           values;
  };

  /** One window's part of the operator. */
  template <class Number>
  class ZoomedOperator<Number>::Window
  {
  public:
    Window(const SlabLayout &layout, const int w)
      : number(w)
      , transfer(layout.windows()[w])
      , coarse_box(box_grid(layout, layout.windows()[w], 1), padding - ZoomWindow::margin)
      , fine_box(box_grid(layout, layout.windows()[w], 3), 3 * padding)
    {
    }

    const int              number;
    WindowTransfer<Number> transfer;
    WindowBox<Number>      coarse_box, fine_box;
    std::vector<Number>    patch; // of the parent
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
    clear_covered(values);
    respond(values);
    clear_covered(values);
  }

  template <class Number>
  void
  ZoomedOperator<Number>::apply_to_continuous(Number *values)
  {
    std::vector<Number> coarse;
    for (std::size_t w = windows.size(); w-- > 0;)
      {
        Window &window = *windows[w];
        Number *own    = values + layout().start_of_window(window.number);
        coarse.resize(layout().start_of_window(window.number + 1) -
                      layout().start_of_window(window.number));
        window.transfer.interpolate(
          window.transfer.patch_of(layout(), window.number, values), coarse.data());
        for (std::size_t k = 0; k < coarse.size(); ++k)
          own[k] -= coarse[k];
      }
    respond(values);
  }

  /** Replace the pressures of grid and windows, which add up, by the displacements. */
  template <class Number>
  void
  ZoomedOperator<Number>::respond(Number *values)
  {
    gather_from_windows(values);
    grid_transform.multiply(values,
                            values,
                            wave_compliance<Number>(layout().grid(), modulus));
    spread_to_windows(values);
  }

  template <class Number>
  void
  ZoomedOperator<Number>::stiffen(const int window, Number *own)
  {
    WindowBox<Number> &box = windows[window]->fine_box;
    box.take(own,
             [this](const PeriodicGrid &grid) { return wave_stiffness(grid, modulus); });
    box.for_each([own](const std::size_t k, const Number value) { own[k] = value; });
  }

  template <class Number>
  void
  ZoomedOperator<Number>::clear_covered(Number *values) const
  {
    layout().for_each_covered(
      [values](const std::size_t parent, std::size_t) { values[parent] = 0; });
  }

  /** Add to each parent's pressures what deposit() makes of those of its windows. */
  template <class Number>
  void
  ZoomedOperator<Number>::gather_from_windows(Number *values)
  {
    for (std::size_t w = windows.size(); w-- > 0;)
      {
        Window &window = *windows[w];
        window.transfer.deposit(values + layout().start_of_window(window.number),
                                window.patch);
        window.transfer.add_patch(layout(), window.number, window.patch, values);
      }
  }

  /** Find the displacements in the windows from those on their parents. */
  template <class Number>
  void
  ZoomedOperator<Number>::spread_to_windows(Number *values)
  {
    const auto compliance = [this](const PeriodicGrid &grid) {
      return wave_compliance<Number>(grid, modulus);
    };
    for (const auto &each : windows)
      {
        Window &window = *each;
        window.coarse_box.take(window.patch.data(), compliance);
        window.patch = window.transfer.patch_of(layout(), window.number, values);
        window.coarse_box.for_each(
          [&](const std::size_t k, const Number value) { window.patch[k] -= value; });
        Number *own = values + layout().start_of_window(window.number);
        window.fine_box.take(own, compliance);
        window.transfer.interpolate(window.patch, own);
        window.fine_box.for_each(
          [&](const std::size_t k, const Number value) { own[k] += value; });
      }
  }

  template class ZoomedOperator<double>;
  template class ZoomedOperator<float>;

  ZoomedProblem::ZoomedProblem(const SlabField &heights, const double contact_modulus)
    : DualProblem(points_of(heights))
    , exact(heights.layout_pointer(), contact_modulus)
    , single_precision(heights.layout_pointer(), contact_modulus)
    , preconditioner(heights.layout_pointer(), contact_modulus)
    , room(size)
    , pressed(size)
  {
  }

  double
  ZoomedProblem::apply(const double *pressure, double *displacement)
  {
    // Either transform needs its buffer only while it is in use.
    single_precision.release();
    const double work = act(exact, pressure, displacement);
    exact.release();
    return work;
  }

  double
  ZoomedProblem::respond(const float *step, float *response)
  {
    // The response may be the same array as the step.
    std::copy(step, step + size, pressed.begin());
    return act(single_precision, pressed.data(), response);
  }

  template <class Number>
  double
  ZoomedProblem::act(ZoomedOperator<Number> &compliance,
                     const Number           *pressure,
                     Number                 *displacement)
  {
    interruption_point();
    std::copy(pressure, pressure + size, displacement);
    compliance.apply(displacement);
    return weighted_sums<1>(*this, [=](const std::size_t i, auto &sums) {
      sums[0] += static_cast<double>(pressure[i]) * displacement[i];
    })[0];
  }

  void
  ZoomedProblem::precondition(float *values, const std::uint8_t *marks)
  {
    preconditioner.apply(values, marks, [this](const int window, float *own) {
      single_precision.stiffen(window, own);
    });
  }
} // namespace strait
