// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/zoomed_preconditioner.h>

namespace strait
{
  ZoomedPreconditioner::ZoomedPreconditioner(const SlabLayoutPtr &layout_,
                                             const double         contact_modulus)
    : layout(layout_)
    , n_windows(static_cast<int>(layout->windows().size()))
    , extension(layout)
    , stiffness(
        TwoScaleOperator::stiffness(layout, extension.finest().layout, contact_modulus))
    , sums(layout->n_values())
    , room(layout->n_values() - layout->n_local_points())
  {
    for (const ZoomWindow &window : layout->windows())
      transfers.emplace_back(window);
  }

  void
  ZoomedPreconditioner::apply(float                 *values,
                              const std::uint8_t    *marks,
                              const WindowStiffness &window_stiffness)
  {
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = marks[i] ? GridBoxes::full : 0.f;
    for (int w = n_windows; w-- > 0;)
      take_means(w, values);
    extension.gather(values, sums.data());
    extension.spread(values, sums.data());
    for (int w = 0; w < n_windows; ++w)
      refine(w, values);
    stiffen(values, window_stiffness);
    for (int w = n_windows; w-- > 0;)
      refine_adjoint(w, values);
    extension.extend_adjoint(values, sums.data());
    for (int w = 0; w < n_windows; ++w)
      take_means_adjoint(w, values);
  }

  /** Apply the stiffness, a sum over levels, to @p values, given at all points. */
  void
  ZoomedPreconditioner::stiffen(float *values, const WindowStiffness &window_stiffness)
  {
    for (int w = n_windows; w-- > 0;)
      layout->for_each_around(
        w, 0, [&](const int a, const int b, const std::size_t parent) {
          float sum = 0;
          for_each_of_nine(w, a, b, [&](const std::size_t i) { sum += values[i]; });
          values[parent] = sum / 9;
        });
    for (int w = 0; w < n_windows; ++w)
      interpolate(w, values);
    float *const in_windows = values + layout->n_local_points();
    for (std::size_t i = 0; i < room.size(); ++i)
      in_windows[i] -= room[i];

    stiffness.on_boxes(extension.finest().values.own.data());
    stiffness.on_points(values);
    for (int w = 0; w < n_windows; ++w)
      window_stiffness(w, values + layout->start_of_window(w));

    for (std::size_t i = 0; i < room.size(); ++i)
      room[i] = -in_windows[i];
    for (int w = n_windows; w-- > 0;)
      add_deposit(w, values);
    for (int w = 0; w < n_windows; ++w)
      add_to_children(
        w,
        values,
        [&](const std::size_t parent) { return values[parent]; },
        [](std::size_t) { return 1.f; });
    layout->for_each_covered(
      [&](const std::size_t parent, std::size_t) { values[parent] = 0; });
  }

  /** Give the parent's points the weighted means and sums of weights of the window's. */
  void
  ZoomedPreconditioner::take_means(const int window, float *values)
  {
    layout->for_each_around(window,
                            0,
                            [&](const int a, const int b, const std::size_t parent) {
                              float value = 0, weight = 0;
                              for_each_of_nine(window, a, b, [&](const std::size_t i) {
                                weight += weight_at(i);
                                value += weight_at(i) * values[i];
                              });
                              values[parent] = weight > 0 ? value / weight : 0.f;
                              sums[parent]   = weight * 4 / 9;
                            });
  }

  void
  ZoomedPreconditioner::take_means_adjoint(const int window, float *values)
  {
    add_to_children(
      window,
      values,
      [&](const std::size_t parent) {
        return sums[parent] > 0 ? 4 * values[parent] / sums[parent] : 0.f;
      },
      [&](const std::size_t i) { return weight_at(i); });
  }

  /** Fill up the window's values from the parent, as GridBoxes::interpolate() does. */
  void
  ZoomedPreconditioner::refine(const int window, float *values)
  {
    interpolate(window, values);
    const std::size_t n_grid = layout->n_local_points(),
                      end    = layout->start_of_window(window + 1);
    for (std::size_t i = layout->start_of_window(window); i < end; ++i)
      values[i] += (1 - weight_at(i)) * (room[i - n_grid] - values[i]);
  }

  void
  ZoomedPreconditioner::refine_adjoint(const int window, float *values)
  {
    const std::size_t n_grid = layout->n_local_points(),
                      end    = layout->start_of_window(window + 1);
    for (std::size_t i = layout->start_of_window(window); i < end; ++i)
      {
        room[i - n_grid] = (1 - weight_at(i)) * values[i];
        values[i] -= room[i - n_grid];
      }
    add_deposit(window, values);
  }

  /** Interpolate the parent's values to the window's points, into the window's room. */
  void
  ZoomedPreconditioner::interpolate(const int window, const float *values)
  {
    transfers[window].interpolate(transfers[window].patch_of(*layout, window, values),
                                  room_of(window));
  }

  /** The adjoint of interpolate(): add the window's room to the parent's values. */
  void
  ZoomedPreconditioner::add_deposit(const int window, float *values)
  {
    transfers[window].deposit(room_of(window), patch);
    transfers[window].add_patch(*layout, window, patch, values);
  }

  /** For each parent's point in the window, add of_parent(its position) to the nine
   *  points of the window there, times the weight(position) of each. */
  template <class OfParent, class Weight>
  void
  ZoomedPreconditioner::add_to_children(const int       window,
                                        float          *values,
                                        const OfParent &of_parent,
                                        const Weight   &weight)
  {
    const int nx = layout->windows()[window].nx, ny = layout->windows()[window].ny;
    patch.assign(static_cast<std::size_t>(nx) * ny, 0.f);
    layout->for_each_around(window,
                            0,
                            [&](const int a, const int b, const std::size_t parent) {
                              patch[static_cast<std::size_t>(b) * nx + a] =
                                of_parent(parent);
                            });
    // All ranks hold the windows, but each only its rows of the grid.
    if (layout->windows()[window].parent < 0)
      sum_in_place(layout->communicator(), patch);
    for (int b = 0; b < ny; ++b)
      for (int a = 0; a < nx; ++a)
        for_each_of_nine(window, a, b, [&](const std::size_t i) {
          values[i] += weight(i) * patch[static_cast<std::size_t>(b) * nx + a];
        });
  }

  float
  ZoomedPreconditioner::weight_at(const std::size_t i) const
  {
    return GridBoxes::weight_of(sums[i]);
  }

  float *
  ZoomedPreconditioner::room_of(const int window)
  {
    return room.data() + (layout->start_of_window(window) - layout->n_local_points());
  }

  /** Call visit(position) for the nine points of the window at point (a, b) of the
   *  parent, counted from the first one that the window covers. */
  template <class Visit>
  void
  ZoomedPreconditioner::for_each_of_nine(const int    window,
                                         const int    a,
                                         const int    b,
                                         const Visit &visit) const
  {
    const std::size_t first   = layout->start_of_window(window),
                      columns = layout->windows()[window].n_columns();
    for (int j = 3 * b; j < 3 * b + 3; ++j)
      for (int i = 3 * a; i < 3 * a + 3; ++i)
        visit(first + j * columns + i);
  }
} // namespace strait
