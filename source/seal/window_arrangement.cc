// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/window_arrangement.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace strait
{
  namespace
  {
    // Points of its parent that a window covers each way. Half of it cuts through the
    // contact that shapes the throat, double of it costs four times as much; neither
    // changes the critical load by more than 1e-6.
    constexpr int window_points = 48;
  } // namespace

  WindowArrangement::WindowArrangement(const SlabLayout        &layout_,
                                       const std::vector<bool> &is_used)
    : layout(layout_)
  {
    for (std::size_t w = 0; w < is_used.size(); ++w)
      {
        const ZoomWindow &window = layout.windows()[w];
        // The first of the parent's points that it covers.
        const Place first = place_of({1, 1, static_cast<int>(w)}, window.level - 1);
        placed.push_back({window.level, first, {window.nx, window.ny}, is_used[w]});
      }
  }

  WindowArrangement::Placed
  WindowArrangement::Placed::refined() const
  {
    return {level + 1,
            {3 * first[0] - 1, 3 * first[1] - 1},
            {3 * n[0], 3 * n[1]},
            is_used};
  }

  /** The place of @p point on the lattice of the points of @p level. */
  WindowArrangement::Place
  WindowArrangement::place_of(const GridPoint &point, const int level) const
  {
    const auto [x, y] = layout.position(point.window, point.ix, point.iy);
    const double fine = std::pow(3., level);
    return {std::lround(x / layout.grid().dx() * fine),
            std::lround(y / layout.grid().dy() * fine)};
  }

  int
  WindowArrangement::level_with_close_rim(GridPoint point, double points) const
  {
    int level = 0;
    while (point.window >= 0)
      {
        const ZoomWindow &window = layout.windows()[point.window];
        const int         to_rim = std::min({point.ix,
                                             point.iy,
                                             window.n_columns() - 1 - point.ix,
                                             window.n_rows() - 1 - point.iy});
        if (to_rim < points)
          level = window.level;
        point  = {window.x + point.ix / 3, window.y + point.iy / 3, window.parent};
        points = points / 3. + ZoomWindow::margin;
      }
    return level;
  }

  bool
  WindowArrangement::open(const int level, const GridPoint &point)
  {
    const Place centre = place_of(point, level - 1);
    Placed      window{level, {}, {}, true};
    for (int d = 0; d < 2; ++d)
      {
        // A place beyond the box is equivalent to its periodic image within.
        const long n_box = period(level, d);
        window.n[d]      = static_cast<int>(std::min<long>(window_points, n_box / 2));
        window.first[d]  = (centre[d] % n_box + n_box) % n_box - window.n[d] / 2;
      }
    return add(window, placed);
  }

  std::vector<ZoomWindow>
  WindowArrangement::windows()
  {
    std::sort(placed.begin(), placed.end(), [](const Placed &a, const Placed &b) {
      return std::tie(a.level, a.first) < std::tie(b.level, b.first);
    });
    // Moving a window into its parent may push it onto another one.
    std::vector<Placed> settled;
    for (Placed window : placed)
      if (window.level == 1 || find_parent(settled, window) >= 0)
        add(window, settled);

    std::vector<ZoomWindow> result;
    for (Placed window : settled)
      {
        const int parent = find_parent(settled, window);
        Place     first  = window.first;
        for (int d = 0; parent >= 0 && d < 2; ++d)
          first[d] -= settled[parent].refined().first[d];
        result.push_back({parent,
                          window.level,
                          static_cast<int>(first[0]),
                          static_cast<int>(first[1]),
                          window.n[0],
                          window.n[1]});
      }
    return result;
  }

  /** Number of points along axis @p d of the lattice on which @p level is placed. */
  long
  WindowArrangement::period(const int level, const int d) const
  {
    long n = d == 0 ? layout.grid().nx : layout.grid().ny;
    for (int l = 1; l < level; ++l)
      n *= 3;
    return n;
  }

  /** Offset from the first point of @p a to that of @p b: forwards if that is one of a's
   *  or the next one behind them, else backwards. */
  long
  WindowArrangement::offset(const Placed &a, const Placed &b, const int d) const
  {
    const long n    = period(a.level, d);
    const long here = (((b.first[d] - a.first[d]) % n) + n) % n;
    return here <= a.n[d] ? here : here - n;
  }

  /** Whether no point lies between @p a and @p b. */
  bool
  WindowArrangement::touch(const Placed &a, const Placed &b) const
  {
    for (int d = 0; d < 2; ++d)
      if (-offset(a, b, d) > b.n[d])
        return false;
    return true;
  }

  /** Make @p window the rectangle around itself and @p other. Returns false, without a
   *  change, if that is too large. */
  bool
  WindowArrangement::join(Placed &window, const Placed &other) const
  {
    // Windows in a row, each way, that may be joined to one: more cost more than they are
    // worth; with fewer, one of two neighbouring throats goes without.
    constexpr long n_joined = 3;
    Placed         result   = window;
    for (int d = 0; d < 2; ++d)
      {
        const long o     = offset(window, other, d);
        const long most  = period(window.level, d) - 2;
        long       begin = std::min(0L, o);
        long       end   = std::max<long>(window.n[d], o + other.n[d]);
        if (end - begin > most) // all round the box
          {
            begin = (window.n[d] - most) / 2;
            end   = begin + most;
          }
        if (end - begin > n_joined * window_points)
          return false;
        result.first[d] += begin;
        result.n[d] = static_cast<int>(end - begin);
      }
    result.is_used = window.is_used || other.is_used;
    window         = result;
    return true;
  }

  /** Add @p window to @p others, joined with those that it touches, or in their place if
   *  the result is too large and they are not used. Returns false if there is no room for
   *  it, or if one in use covers the same already. */
  bool
  WindowArrangement::add(Placed window, std::vector<Placed> &others) const
  {
    std::vector<Placed> apart = others;
    const auto          near  = [&](const Placed &other) {
      return other.level == window.level && touch(other, window);
    };
    for (auto other = apart.begin();
         (other = std::find_if(apart.begin(), apart.end(), near)) != apart.end();
         apart.erase(other))
      if (!join(window, *other) && other->is_used)
        return false;
    const auto is_same = [&](const Placed &other) {
      return near(other) && other.is_used && other.n == window.n &&
             offset(other, window, 0) == 0 && offset(other, window, 1) == 0;
    };
    if (std::any_of(others.begin(), others.end(), is_same))
      return false;
    others = std::move(apart);
    others.push_back(window);
    return true;
  }

  /** Return the number of the parent of @p window among @p candidates, −1 if there is
   *  none. The window is moved to lie within its parent. */
  int
  WindowArrangement::find_parent(const std::vector<Placed> &candidates,
                                 Placed                    &window) const
  {
    constexpr int margin = ZoomWindow::margin;
    for (std::size_t p = 0; p < candidates.size(); ++p)
      {
        if (candidates[p].level != window.level - 1)
          continue;
        const Placed parent = candidates[p].refined();
        Placed       found  = window;
        bool         fits   = true;
        for (int d = 0; d < 2; ++d)
          {
            // A joined window may be larger than the room there is.
            found.n[d]       = std::min(window.n[d], parent.n[d] - 2 * margin);
            const int  n     = found.n[d];
            const long last  = parent.n[d] - margin - n;
            long       shift = offset(parent, window, d);
            if (shift >= last + margin + n / 2) // it begins before a wide parent
              shift -= period(window.level, d);
            // A window that is less than about half outside is moved inside.
            fits           = fits && shift > -n / 2 && shift < last + margin + n / 2;
            found.first[d] = parent.first[d] + std::clamp<long>(shift, margin, last);
          }
        if (!fits)
          continue;
        window = found;
        return static_cast<int>(p);
      }
    return -1;
  }
} // namespace strait
