// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/zoom_in.h>

#include <algorithm>
#include <utility>

namespace strait
{
  namespace
  {
    /** Values around a window, of a parent that all ranks hold or share. */
    class Surroundings
    {
    public:
      /** Collective. */
      Surroundings(const SlabField &field, const ZoomWindow &window)
        : n_columns(window.nx + 2)
        , values(static_cast<std::size_t>(n_columns) * (window.ny + 2))
      {
        const SlabLayout &layout = field.layout();
        const int         nx = layout.grid().nx, ny = layout.grid().ny;
        for (int b = 0; b < window.ny + 2; ++b)
          for (int a = 0; a < n_columns; ++a)
            {
              const int ix = window.x + a - 1, iy = window.y + b - 1;
              double   &value = values[static_cast<std::size_t>(b) * n_columns + a];
              if (window.parent >= 0)
                value = field[layout.start_of_window(window.parent) +
                              static_cast<std::size_t>(iy) *
                                layout.windows()[window.parent].n_columns() +
                              ix];
              else if (const int row = (iy + ny) % ny - layout.first_row();
                       row >= 0 && row < layout.n_rows())
                value = field((ix + nx) % nx, row);
            }
        if (window.parent < 0)
          sum_in_place(layout.communicator(),
                       values.data(),
                       static_cast<int>(values.size()));
      }

      /** Linear between the parent's points, at point (@p ix, @p iy) of the window. */
      double
      interpolate(const int ix, const int iy) const
      {
        const int    a = (ix + 2) / 3, b = (iy + 2) / 3;
        const double s = (ix + 2) % 3 / 3., t = (iy + 2) % 3 / 3.;
        return (1 - t) * ((1 - s) * at(a, b) + s * at(a + 1, b)) +
               t * ((1 - s) * at(a, b + 1) + s * at(a + 1, b + 1));
      }

      /** At the parent's point nearest to point (@p ix, @p iy) of the window. */
      double
      nearest(const int ix, const int iy) const
      {
        return at(ix / 3 + 1, iy / 3 + 1);
      }

    private:
      double
      at(const int a, const int b) const
      {
        // The last column and row are only asked for with the weight 0.
        const int n_rows = static_cast<int>(values.size()) / n_columns;
        return values[static_cast<std::size_t>(std::min(b, n_rows - 1)) * n_columns +
                      std::min(a, n_columns - 1)];
      }

      int                 n_columns;
      std::vector<double> values;
    };

    /** Interpolate pressure and gap into window @p w: no wider a contact than the
     * parent's points say. Collective. */
    void
    interpolate(ContactState &state, const int w)
    {
      const SlabLayout  &layout = state.gap.layout();
      const ZoomWindow  &window = layout.windows()[w];
      const Surroundings pressure(state.pressure, window), gap(state.gap, window);
      std::size_t        k = layout.start_of_window(w);
      for (int iy = 0; iy < window.n_rows(); ++iy)
        for (int ix = 0; ix < window.n_columns(); ++ix, ++k)
          {
            const bool touches = pressure.nearest(ix, iy) > 0;
            state.pressure[k]  = touches ? pressure.interpolate(ix, iy) : 0.;
            state.gap[k]       = touches ? 0. : gap.interpolate(ix, iy);
          }
    }

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

    SlabField
    on_layout(const SlabField &field, const SlabLayoutPtr &layout)
    {
      SlabField result(layout);
      std::copy_n(field.begin(), layout->n_local_points(), result.begin());
      return result;
    }
  } // namespace

  ContactState
  zoom_in(ContactState state, std::vector<ZoomWindow> windows)
  {
    const SlabLayoutPtr layout = with_windows(state.gap.layout(), std::move(windows));
    const SlabField     old_pressure = std::move(state.pressure);
    const SlabField     old_gap      = std::move(state.gap);
    state.pressure                   = on_layout(old_pressure, layout);
    state.gap                        = on_layout(old_gap, layout);
    state.approach                   = Approach(state.approach.target());
    for (int w = 0; w < static_cast<int>(layout->windows().size()); ++w)
      {
        const SlabLayout &old   = old_gap.layout();
        const int         known = find_window(old, *layout, w);
        if (known < 0)
          {
            interpolate(state, w);
            continue;
          }
        const auto copy = [&](const SlabField &from, SlabField &to) {
          std::copy(from.begin() +
                      static_cast<std::ptrdiff_t>(old.start_of_window(known)),
                    from.begin() +
                      static_cast<std::ptrdiff_t>(old.start_of_window(known + 1)),
                    to.begin() + static_cast<std::ptrdiff_t>(layout->start_of_window(w)));
        };
        copy(old_pressure, state.pressure);
        copy(old_gap, state.gap);
      }
    return state;
  }
} // namespace strait
