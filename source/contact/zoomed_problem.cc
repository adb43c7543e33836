// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/signals.h>
#include <strait/contact/window_transfer.h>
#include <strait/contact/zoomed_problem.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

    Shape
    shape_of(const FourierTransform &box)
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
    void
    put_into_box(const Shape               &shape,
                 const std::vector<double> &array,
                 const Shape               &shape_of_box,
                 std::vector<double>       &box)
    {
      std::fill(box.begin(), box.end(), 0.);
      for_each_in_the_middle(shape,
                             shape_of_box,
                             [&](const std::size_t k, const std::size_t at) {
                               box[at] = array[k];
                             });
    }
  } // namespace

  /** One window's share of the operator. */
  class ZoomedProblem::Window
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

    const int           number;
    const ZoomWindow    place;
    const SlabLayout   &layout;
    WindowTransfer      transfer;
    FourierTransform    coarse_box, fine_box;
    std::vector<double> patch, own;                 // of the parent; of the window
    std::vector<double> in_coarse_box, in_fine_box; // the same in their boxes
  };

  ZoomedProblem::ZoomedProblem(const SlabField &heights, const double contact_modulus)
    : DualProblem(points_of(heights))
    , modulus(contact_modulus)
    , grid_transform(heights.layout_pointer())
    , grid_stiffness(TwoScaleOperator::stiffness(heights.layout_pointer(), modulus))
    , room(size())
    , whole(size())
  {
    for (std::size_t w = 0; w < layout().windows().size(); ++w)
      windows.push_back(std::make_unique<Window>(layout(), static_cast<int>(w)));
  }

  ZoomedProblem::~ZoomedProblem() = default;

  float *
  ZoomedProblem::scratch()
  {
    return room.data();
  }

  long
  ZoomedProblem::n_applications() const
  {
    return grid_transform.n_pairs();
  }

  double
  ZoomedProblem::apply(const double   *pressure,
                       double         *displacement,
                       const WorkPass &after)
  {
    return act(pressure, displacement, no_pass, after);
  }

  double
  ZoomedProblem::respond(const float    *step,
                         float          *response,
                         const Pass     &before,
                         const WorkPass &after)
  {
    return act(step, response, before, after);
  }

  /** Work on @p values, 0 at covered points. */
  template <class Number>
  void
  ZoomedProblem::take(const Number *values, const Pass &before)
  {
    std::fill(whole.begin(), whole.end(), 0.);
    for (const Block &block : blocks())
      {
        before(block);
        std::copy(values + block.begin, values + block.end, whole.begin() + block.begin);
      }
    gather_from_windows();
  }

  template <class Number>
  double
  ZoomedProblem::act(const Number   *pressure,
                     Number         *displacement,
                     const Pass     &before,
                     const WorkPass &after)
  {
    interruption_point();
    take(pressure, before);
    transform(grid_transform, whole.data(), Symbol::compliance);
    spread_to_windows(Symbol::compliance);
    const auto [work] = weighted_sums<1>(*this, [&](const std::size_t i, auto &sums) {
      sums[0] += pressure[i] * whole[i];
      displacement[i] = static_cast<Number>(whole[i]);
    });
    for (const Block &block : blocks())
      after(block, work);
    return work;
  }

  void
  ZoomedProblem::precondition(float *values, const Pass &before, const Pass &after)
  {
    take(values, before);
    grid_stiffness.apply(
      whole.data(), [](int) {}, [](int) {});
    spread_to_windows(Symbol::stiffness);
    for (const Block &block : blocks())
      {
        std::copy(whole.begin() + block.begin,
                  whole.begin() + block.end,
                  values + block.begin);
        after(block);
      }
  }

  /** Give each parent the mean of what its windows have; what it has itself at points
   *  that they cover is 0. */
  void
  ZoomedProblem::gather_from_windows()
  {
    for (std::size_t w = windows.size(); w-- > 0;)
      {
        Window       &window = *windows[w];
        const double *begin  = whole.data() + layout().start_of_window(window.number);
        std::copy_n(begin, window.own.size(), window.own.begin());
        window.transfer.deposit(window.own, window.patch);
        window.for_each_of_patch([&](const std::size_t k, const std::size_t at) {
          whole[at] += window.patch[k];
        });
      }
  }

  /** Refine what the parents have found in their windows. */
  void
  ZoomedProblem::spread_to_windows(const Symbol symbol)
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
        std::fill(window.patch.begin(), window.patch.end(), 0.);
        window.for_each_of_patch([&](const std::size_t k, const std::size_t at) {
          window.patch[k] = whole[at];
        });
        if (window.place.parent < 0)
          sum_over_ranks(window.patch.data(), static_cast<int>(window.patch.size()));
        for_each_in_the_middle(patch,
                               coarse,
                               [&](const std::size_t k, const std::size_t at) {
                                 window.patch[k] -= window.in_coarse_box[at];
                               });
        put_into_box(own, window.own, fine, window.in_fine_box);
        transform(window.fine_box, window.in_fine_box.data(), symbol);
        double *result = whole.data() + layout().start_of_window(window.number);
        window.transfer.interpolate(window.patch, window.own);
        for_each_in_the_middle(own, fine, [&](const std::size_t k, const std::size_t at) {
          result[k] = window.own[k] + window.in_fine_box[at];
        });
      }
  }

  void
  ZoomedProblem::transform(FourierTransform &box,
                           double           *values,
                           const Symbol      symbol) const
  {
    const PeriodicGrid &grid = box.layout().grid();
    if (symbol == Symbol::stiffness)
      box.multiply(values, values, WaveStiffness(grid, modulus));
    else
      box.multiply(values, values, WaveCompliance<double>(grid, modulus));
  }

  std::size_t
  ZoomedProblem::memory_consumption() const
  {
    std::size_t bytes = room.size() * sizeof(float) + whole.size() * sizeof(double) +
                        grid_transform.memory_consumption() +
                        grid_stiffness.memory_consumption();
    for (const auto &window : windows)
      bytes += window->coarse_box.memory_consumption() +
               window->fine_box.memory_consumption() +
               (window->patch.size() + window->own.size() + window->in_coarse_box.size() +
                window->in_fine_box.size()) *
                 sizeof(double);
    return bytes;
  }
} // namespace strait
