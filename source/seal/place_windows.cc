// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/place_windows.h>
#include <strait/seal/window_arrangement.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** The number of points that a throat needs along it: its error falls at least with
     *  the square of the spacing, and counts by its fraction of the pressure drop. */
    double
    points_wanted(const ThroatOnPath &throat, const ZoomParameters &zoom)
    {
      return std::sqrt(throat.fraction) * zoom.points_along_throat;
    }

    /** Mark the windows of @p layout that the throats need, and one level more of each,
     *  as the next state may need it. */
    std::vector<bool>
    find_needed(const SlabLayout                &layout,
                const std::vector<ThroatOnPath> &throats,
                const ZoomParameters            &zoom)
    {
      const std::vector<ZoomWindow> &windows = layout.windows();
      std::vector<bool>              is_needed(windows.size(), false);
      for (const ThroatOnPath &throat : throats)
        {
          const double wanted = points_wanted(throat, zoom);
          double       points = throat.points / 9.;
          int          w      = throat.point.window;
          for (; w >= 0 && points >= wanted; points /= 3.)
            w = windows[w].parent;
          for (; w >= 0 && !is_needed[w]; w = windows[w].parent)
            is_needed[w] = true;
        }
      return is_needed;
    }
  } // namespace

  std::vector<ZoomWindow>
  needed_windows(const SlabLayout                &layout,
                 const std::vector<ThroatOnPath> &throats,
                 const ZoomParameters            &zoom)
  {
    const std::vector<bool> is_needed = find_needed(layout, throats, zoom);
    std::vector<ZoomWindow> result;
    std::vector<int>        new_number(is_needed.size(), -1);
    for (std::size_t w = 0; w < is_needed.size(); ++w)
      if (is_needed[w])
        {
          new_number[w] = static_cast<int>(result.size());
          result.push_back(layout.windows()[w]);
          if (result.back().parent >= 0)
            result.back().parent = new_number[result.back().parent];
        }
    return result;
  }

  std::vector<ZoomWindow>
  place_windows(const SlabLayout                &layout,
                const std::vector<ThroatOnPath> &throats,
                const ZoomParameters            &zoom)
  {
    WindowArrangement         arrangement(layout, find_needed(layout, throats, zoom));
    bool                      is_enough = true;
    std::vector<ThroatOnPath> by_weight = throats;
    std::stable_sort(by_weight.begin(),
                     by_weight.end(),
                     [](const ThroatOnPath &a, const ThroatOnPath &b) {
                       return a.fraction > b.fraction;
                     });
    for (const ThroatOnPath &throat : by_weight)
      {
        const double     wanted = points_wanted(throat, zoom);
        const GridPoint &point  = throat.point;
        if (throat.points >= 3. * wanted)
          continue;
        const int  level = point.window < 0 ? 0 : layout.windows()[point.window].level;
        const bool is_coarse = throat.points < wanted && level < zoom.maximum_levels;
        const int  margin    = is_coarse ? ZoomWindow::margin : 0;
        const int  narrow =
          arrangement.level_with_close_rim(point, throat.points + margin);
        if (narrow > 0 && arrangement.open(narrow, point))
          is_enough = false;
        else if (is_coarse && arrangement.open(level + 1, point))
          {
            is_enough = false;
            // Open the next level, too: it is known well enough where it will lie.
            if (3. * throat.points < wanted && level + 1 < zoom.maximum_levels)
              arrangement.open(level + 2, point);
          }
      }
    return is_enough ? layout.windows() : arrangement.windows();
  }
} // namespace strait
