// SPDX-License-Identifier: GPL-2.0-or-later
// Shared by the tests of windows around throats.
#pragma once

#include <strait/seal/place_windows.h>

#include <gtest/gtest.h>

#include <vector>

namespace zoom_tests
{
  using namespace strait;

  using Windows = std::vector<ZoomWindow>;

  inline const ZoomParameters zoom; // 12 points along a throat

  inline SlabLayoutPtr
  box_with(const Windows &windows = {}, const int n = 256)
  {
    return with_windows(*make_layout({n, n, 1., 1.}, MPI_COMM_WORLD), windows);
  }

  inline ThroatOnPath
  throat(const int    ix,
         const int    iy,
         const int    window   = -1,
         const double points   = 3.,
         const double fraction = .5)
  {
    return {{ix, iy, window}, fraction, points};
  }

  inline Windows
  placed(const std::vector<ThroatOnPath> &throats, const Windows &windows = {})
  {
    return place_windows(*box_with(windows), throats, zoom);
  }

  /** Whether @p window covers point (@p ix, @p iy) of its parent; if that is the grid,
   *  it is periodic with @p n points along each axis. */
  inline bool
  covers(const ZoomWindow &window, const int ix, const int iy, const int n = 256)
  {
    const auto inside = [&](const int i, const int first, const int size) {
      return window.parent < 0 ? ((i - first) % n + n) % n < size
                               : i >= first && i < first + size;
    };
    return inside(ix, window.x, window.nx) && inside(iy, window.y, window.ny);
  }

  /** Check what ZoomWindow promises: a window keeps its margin within its parent, and
   *  windows of one parent are apart. */
  inline void
  expect_sound(const Windows &windows)
  {
    for (std::size_t w = 0; w < windows.size(); ++w)
      {
        const ZoomWindow &window = windows[w];
        if (window.parent >= 0)
          {
            ASSERT_LT(window.parent, static_cast<int>(w));
            const ZoomWindow &parent = windows[window.parent];
            const int         margin = ZoomWindow::margin;
            EXPECT_EQ(window.level, parent.level + 1);
            EXPECT_GE(window.x, margin);
            EXPECT_GE(window.y, margin);
            EXPECT_LE(window.x + window.nx, parent.n_columns() - margin);
            EXPECT_LE(window.y + window.ny, parent.n_rows() - margin);
          }
        else
          {
            EXPECT_EQ(window.level, 1);
          }
        // No other window of this parent covers a point of this one or next to it.
        for (std::size_t other = 0; other < w; ++other)
          for (int y = -1; y <= window.ny; ++y)
            for (int x = -1; x <= window.nx; ++x)
              ASSERT_FALSE(windows[other].parent == window.parent &&
                           covers(windows[other], window.x + x, window.y + y))
                << other << " and " << w;
      }
  }
} // namespace zoom_tests
