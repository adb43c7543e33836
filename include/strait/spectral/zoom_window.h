// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_spectral_zoom_window_h
#define strait_spectral_zoom_window_h

namespace strait
{
  /**
   * A rectangle in which a field is also known on points that lie three times as densely
   * each way as those of its parent, the periodic grid or another window. It covers
   * nx × ny points of the parent, and tiles what these stand for: it has 3 nx × 3 ny
   * points, of which point (3 a + 1, 3 b + 1) is point (x + a, y + b) of the parent.
   *
   * A window of the grid may cross the periodic seam; one of a window lies inside of it
   * with at least `margin` points to spare on all sides. Windows of one parent do not
   * overlap, and have at least one point of the parent between them.
   */
  struct ZoomWindow
  {
    /** The parent's points that an interpolation into the window needs around it. Half of
     *  it shifts the critical load of the square saddle, refined threefold from 128
     *  points, by 3e-5, double of it asks more of the parent without need. */
    static constexpr int margin = 4;

    int parent = -1; // number of the window in which it lies; −1: the grid
    int level  = 1;  // how often the grid's spacing was divided by three
    int x      = 0;  // column of the first of the parent's points that it covers
    int y      = 0;  // row of the same
    int nx     = 0;  // how many of the parent's columns it covers
    int ny     = 0;  // how many of the rows

    int
    n_columns() const
    {
      return 3 * nx;
    }

    int
    n_rows() const
    {
      return 3 * ny;
    }

    bool
    operator==(const ZoomWindow &other) const
    {
      return parent == other.parent && level == other.level && x == other.x &&
             y == other.y && nx == other.nx && ny == other.ny;
    }
  };
} // namespace strait

#endif
