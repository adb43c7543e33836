// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/zoom_placement.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace strait
{
  namespace
  {
    // Of the pressure drop, and of the flow: half of it opens windows at throats that
    // move the leak rate by half a percent of their own error, double of it leaves some
    // unresolved that move it by two.
    constexpr double negligible_fraction = .01;

    // Points of its parent that a window covers each way. Half of it cuts through the
    // contact that shapes the throat, double of it costs four times as much; the critical
    // load depends on neither by more than 1e-6.
    constexpr int window_points = 80;

    using Place = std::array<long, 2>; // x and y

    /** A window by its place on the lattice that the points of its parent's level would
     *  make of the whole box. */
    struct Placed
    {
      int                level;
      Place              first;
      std::array<int, 2> n;

      /** Its first point on the lattice of its own level. */
      Place
      own_first() const
      {
        return {3 * first[0] - 1, 3 * first[1] - 1};
      }
    };

    /** Windows in places that do not depend on their parents. */
    class Placement
    {
    public:
      explicit Placement(const SlabLayout &layout_)
        : layout(layout_)
      {
        for (const ZoomWindow &window : layout.windows())
          {
            Place first = {window.x, window.y};
            if (window.parent >= 0)
              for (int d = 0; d < 2; ++d)
                first[d] += placed[window.parent].own_first()[d];
            placed.push_back({window.level, first, {window.nx, window.ny}});
          }
      }

      /** The place of a grid point, on the lattice of its level. */
      Place
      place_of(const GridPoint &point) const
      {
        if (point.window < 0)
          return {point.ix, point.iy};
        const Place first = placed[point.window].own_first();
        return {first[0] + point.ix, first[1] + point.iy};
      }

      /** Points of its level from @p point to the rim of its window. */
      int
      points_to_rim(const GridPoint &point) const
      {
        const ZoomWindow &window = layout.windows()[point.window];
        return std::min({point.ix,
                         point.iy,
                         window.n_columns() - 1 - point.ix,
                         window.n_rows() - 1 - point.iy});
      }

      /** A window of @p level around @p centre, on the lattice of the level before. */
      void
      open(const int level, const Place &centre)
      {
        Placed window{level, {}, {}};
        for (int d = 0; d < 2; ++d)
          {
            const long n_box = period(level, d);
            window.n[d]      = static_cast<int>(std::min<long>(window_points, n_box / 2));
            window.first[d]  = centre[d] - window.n[d] / 2;
          }
        for (bool is_joined = true; is_joined;)
          {
            is_joined = false;
            for (std::size_t k = 0; k < placed.size() && !is_joined; ++k)
              if (placed[k].level == level && touch(placed[k], window))
                {
                  window    = joined(window, placed[k]);
                  is_joined = true;
                  placed.erase(placed.begin() + static_cast<std::ptrdiff_t>(k));
                }
          }
        placed.push_back(window);
      }

      /** All that have a parent to lie in. */
      std::vector<ZoomWindow>
      windows()
      {
        std::stable_sort(placed.begin(),
                         placed.end(),
                         [](const Placed &a, const Placed &b) {
                           return a.level < b.level;
                         });
        std::vector<ZoomWindow> result;
        std::vector<Placed>     kept;
        for (const Placed &window : placed)
          {
            ZoomWindow found{-1,
                             window.level,
                             static_cast<int>(window.first[0]),
                             static_cast<int>(window.first[1]),
                             window.n[0],
                             window.n[1]};
            if (window.level > 1 && !find_parent(kept, window, found))
              continue;
            kept.push_back(window);
            result.push_back(found);
          }
        return result;
      }

      std::vector<Placed> placed;

    private:
      /** Points of the lattice that is the parent's of @p level, along axis @p d. */
      long
      period(const int level, const int d) const
      {
        long n = d == 0 ? layout.grid().nx : layout.grid().ny;
        for (int l = 1; l < level; ++l)
          n *= 3;
        return n;
      }

      /** From the first point of @p a to that of @p b the shorter way round. */
      long
      offset(const Placed &a, const Placed &b, const int d) const
      {
        const long n    = period(a.level, d);
        const long here = (((b.first[d] - a.first[d]) % n) + n) % n;
        return 2 * here < n ? here : here - n;
      }

      /** Whether there is no point between them. */
      bool
      touch(const Placed &a, const Placed &b) const
      {
        for (int d = 0; d < 2; ++d)
          if (const long o = offset(a, b, d); o > a.n[d] || -o > b.n[d])
            return false;
        return true;
      }

      /** The rectangle around both; @p window alone if that is too large. */
      Placed
      joined(const Placed &window, const Placed &other) const
      {
        Placed result = window;
        for (int d = 0; d < 2; ++d)
          {
            const long o     = offset(window, other, d);
            const long begin = std::min(0L, o);
            const long end   = std::max<long>(window.n[d], o + other.n[d]);
            const long most =
              std::min<long>(2 * window_points, period(window.level, d) - 2);
            if (end - begin > most)
              return window;
            result.first[d] += begin;
            result.n[d] = static_cast<int>(end - begin);
          }
        return result;
      }

      bool
      find_parent(const std::vector<Placed> &candidates,
                  const Placed              &window,
                  ZoomWindow                &found) const
      {
        constexpr long margin = ZoomWindow::margin;
        for (std::size_t p = 0; p < candidates.size(); ++p)
          {
            if (candidates[p].level != window.level - 1)
              continue;
            Placed parent = candidates[p];
            parent.first  = parent.own_first();
            parent.level  = window.level;
            Place shift;
            bool  fits = true;
            for (int d = 0; d < 2; ++d)
              {
                const long last = 3L * parent.n[d] - margin - window.n[d];
                shift[d]        = offset(parent, window, d);
                // A little beyond the margin it is moved.
                fits = fits && shift[d] > -window.n[d] / 2 &&
                       shift[d] < last + window.n[d] / 2 && last >= margin;
                shift[d] = std::clamp(shift[d], margin, std::max(last, margin));
              }
            if (!fits)
              continue;
            found.parent = static_cast<int>(p);
            found.x      = static_cast<int>(shift[0]);
            found.y      = static_cast<int>(shift[1]);
            return true;
          }
        return false;
      }

      const SlabLayout &layout;
    };

    /** Those of the windows of @p layout that @p is_kept, with their parents. */
    std::vector<ZoomWindow>
    kept_windows(const SlabLayout &layout, const std::vector<bool> &is_kept)
    {
      std::vector<ZoomWindow> result;
      std::vector<int>        new_number(is_kept.size(), -1);
      for (std::size_t w = 0; w < is_kept.size(); ++w)
        if (is_kept[w])
          {
            new_number[w] = static_cast<int>(result.size());
            result.push_back(layout.windows()[w]);
            if (result.back().parent >= 0)
              result.back().parent = new_number[result.back().parent];
          }
      return result;
    }
  } // namespace

  std::vector<ZoomWindow>
  needed_windows(const SlabLayout                &layout,
                 const std::vector<ThroatOnPath> &throats,
                 const ZoomParameters            &zoom)
  {
    const std::vector<ZoomWindow> &windows = layout.windows();
    std::vector<bool>              is_needed(windows.size(), false);
    for (const ThroatOnPath &throat : throats)
      {
        // A level more than is asked for stays: the next state may need it.
        double points = throat.points / 9.;
        int    w      = throat.point.window;
        for (; w >= 0 && points >= zoom.points_along_throat; points /= 3.)
          w = windows[w].parent;
        for (; w >= 0 && !is_needed[w]; w = windows[w].parent)
          is_needed[w] = true;
      }
    return kept_windows(layout, is_needed);
  }

  std::vector<ZoomWindow>
  place_windows(const SlabLayout                &layout,
                const std::vector<ThroatOnPath> &throats,
                const ZoomParameters            &zoom)
  {
    Placement placement(layout);
    bool      is_enough = true;
    for (const ThroatOnPath &throat : throats)
      {
        if (throat.fraction < negligible_fraction)
          continue;
        const GridPoint &point = throat.point;
        const int   level = point.window < 0 ? 0 : layout.windows()[point.window].level;
        const Place here  = placement.place_of(point);
        if (throat.points < zoom.points_along_throat && level < zoom.maximum_levels)
          {
            placement.open(level + 1, here);
            is_enough = false;
          }
        else if (level > 0 && throat.points < 3. * zoom.points_along_throat &&
                 placement.points_to_rim(point) < throat.points)
          {
            placement.open(level, {(here[0] + 1) / 3, (here[1] + 1) / 3});
            is_enough = false;
          }
      }
    return is_enough ? layout.windows() : placement.windows();
  }

  std::vector<ZoomWindow>
  without_finest(const SlabLayout &layout)
  {
    std::vector<bool> is_parent(layout.windows().size(), false);
    for (const ZoomWindow &window : layout.windows())
      if (window.parent >= 0)
        is_parent[window.parent] = true;
    return kept_windows(layout, is_parent);
  }
} // namespace strait
