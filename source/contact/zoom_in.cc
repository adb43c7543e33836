// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/zoom_in.h>

#include <algorithm>
#include <utility>

namespace strait
{
  namespace
  {
    /** The pressure around a window, at the points of its parent. */
    class Surroundings
    {
    public:
      /** Of window @p w of the layout of @p pressure. Collective. */
      Surroundings(const SlabField &pressure, const int w)
        : n_columns(pressure.layout().windows()[w].nx + 2)
        , n_rows(pressure.layout().windows()[w].ny + 2)
        , values(static_cast<std::size_t>(n_columns) * n_rows)
      {
        const SlabLayout &layout = pressure.layout();
        layout.for_each_around(w, 1, [&](const int a, const int b, const std::size_t k) {
          values[static_cast<std::size_t>(b + 1) * n_columns + a + 1] = pressure[k];
        });
        if (layout.windows()[w].parent < 0)
          sum_in_place(layout.communicator(),
                       values.data(),
                       static_cast<int>(values.size()));
      }

      /** Linear between the parent's points, at point (@p ix, @p iy) of the window; 0
       *  where the nearest of these does not touch. */
      double
      operator()(const int ix, const int iy) const
      {
        if (!(at(ix / 3 + 1, iy / 3 + 1) > 0))
          return 0.;
        const int    a = (ix + 2) / 3, b = (iy + 2) / 3;
        const double s = (ix + 2) % 3 / 3., t = (iy + 2) % 3 / 3.;
        return (1 - t) * ((1 - s) * at(a, b) + s * at(a + 1, b)) +
               t * ((1 - s) * at(a, b + 1) + s * at(a + 1, b + 1));
      }

    private:
      double
      at(const int a, const int b) const
      {
        // The last column and row are only asked for with the weight 0.
        return values[static_cast<std::size_t>(std::min(b, n_rows - 1)) * n_columns +
                      std::min(a, n_columns - 1)];
      }

      int                 n_columns, n_rows;
      std::vector<double> values;
    };

    /** The window of @p layout where window @p w of @p other is, or −1. */
    int
    find_window(const SlabLayout &layout, const SlabLayout &other, const int w)
    {
      const ZoomWindow &wanted = other.windows()[w];
      for (std::size_t k = 0; k < layout.windows().size(); ++k)
        {
          const ZoomWindow &window = layout.windows()[k];
          if (window.level == wanted.level && window.nx == wanted.nx &&
              window.ny == wanted.ny &&
              layout.position(static_cast<int>(k), 0, 0) == other.position(w, 0, 0))
            return static_cast<int>(k);
        }
      return -1;
    }
  } // namespace

  SlabField
  zoom_in(const SlabField &pressure, std::vector<ZoomWindow> windows)
  {
    const SlabLayout   &old    = pressure.layout();
    const SlabLayoutPtr layout = with_windows(old, std::move(windows));
    SlabField           result(layout);
    std::copy_n(pressure.begin(), layout->n_local_points(), result.begin());
    for (int w = 0; w < static_cast<int>(layout->windows().size()); ++w)
      {
        const ZoomWindow &window = layout->windows()[w];
        std::size_t       k      = layout->start_of_window(w);
        if (const int known = find_window(old, *layout, w); known >= 0)
          std::copy(pressure.data() + old.start_of_window(known),
                    pressure.data() + old.start_of_window(known + 1),
                    result.data() + k);
        else
          {
            const Surroundings around(result, w);
            for (int iy = 0; iy < window.n_rows(); ++iy)
              for (int ix = 0; ix < window.n_columns(); ++ix)
                result[k++] = around(ix, iy);
          }
      }
    return result;
  }
} // namespace strait
