// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/percolation/flow_region.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace strait
{
  namespace
  {
    /** Call visit(a, b) for the points of integer a on the segment from (a0, b0) to
     *  (a1, b1). The range of a is half open, so that a chain of segments has a point on
     *  a line as often as it crosses it. */
    template <class Visit>
    void
    cross_lines(const double a0,
                const double a1,
                const double b0,
                const double b1,
                const Visit &visit)
    {
      const double low = std::min(a0, a1), high = std::max(a0, a1);
      for (int line = static_cast<int>(std::ceil(low)); line < high; ++line)
        visit(line, b0 + (b1 - b0) * (line - a0) / (a1 - a0));
    }

    /** The bit of a kind of outline: those of FlowRegion for inlet and outlet. */
    constexpr std::uint8_t
    bit_of(const OutlineKind kind)
    {
      return static_cast<std::uint8_t>(2U << static_cast<unsigned int>(kind));
    }

    /** Mark the points of the lattice of half the spacing, row by row: 1 if a point lies
     *  inside, and the bits of the kinds of outline on which it lies; 0 outside. */
    std::vector<std::uint8_t>
    mark_half_spacings(const PeriodicGrid &grid, const std::vector<OutlineEdge> &outline)
    {
      const int                 n_x = 2 * grid.nx + 1, n_y = 2 * grid.ny + 1;
      std::vector<std::uint8_t> marks(static_cast<std::size_t>(n_x) * n_y, 0);
      const auto                index = [n_x](const int x, const int y) {
        return static_cast<std::size_t>(y) * n_x + x;
      };
      // Points inside, by the even–odd rule.
      std::vector<std::vector<double>> crossings(n_y);
      for (const OutlineEdge &e : outline)
        cross_lines(e.y0, e.y1, e.x0, e.x1, [&](const int y, const double x) {
          if (y >= 0 && y < n_y)
            crossings[y].push_back(x);
        });
      for (int y = 0; y < n_y; ++y)
        {
          std::vector<double> &here = crossings[y];
          std::sort(here.begin(), here.end());
          for (std::size_t c = 0; c + 1 < here.size(); c += 2)
            for (int x = std::max(static_cast<int>(std::ceil(here[c])), 0);
                 x <= here[c + 1] && x < n_x;
                 ++x)
              marks[index(x, y)] = 1;
        }
      for (const OutlineEdge &e : outline)
        {
          const bool   steep = std::abs(e.y1 - e.y0) > std::abs(e.x1 - e.x0);
          const double a0 = steep ? e.y0 : e.x0, a1 = steep ? e.y1 : e.x1;
          const double b0 = steep ? e.x0 : e.y0, b1 = steep ? e.x1 : e.y1;
          const int    first =
            static_cast<int>(std::ceil(std::min(a0, a1) - 2 * precision_of_meshes));
          for (int a = first; a <= std::max(a0, a1) + 2 * precision_of_meshes; ++a)
            {
              const double b = a1 == a0 ? b0 : b0 + (b1 - b0) * (a - a0) / (a1 - a0);
              const int    nearest = static_cast<int>(std::lround(b));
              if (std::abs(b - nearest) > 2 * precision_of_meshes)
                continue;
              const int x = steep ? nearest : a, y = steep ? a : nearest;
              if (x >= 0 && x < n_x && y >= 0 && y < n_y)
                marks[index(x, y)] |= bit_of(e.kind);
            }
        }
      return marks;
    }

    /** Where the outline crosses the link from a point to its right or upper neighbour,
     *  by number of the link: distance from the point in spacings and kind of outline. */
    using LinkCrossings =
      std::map<std::size_t, std::vector<std::pair<double, OutlineKind>>>;

    /** Find the crossings. Link 2 k leads from point k to the right, link 2 k + 1 up. */
    LinkCrossings
    find_crossings(const PeriodicGrid &grid, const std::vector<OutlineEdge> &outline)
    {
      LinkCrossings crossings;
      const auto    note =
        [&](const double x, const double y, const bool up, OutlineKind kind) {
          const double along = up ? y : x;
          const int    n     = up ? grid.ny : grid.nx;
          const int    from  = std::clamp(static_cast<int>(std::floor(along)), 0, n - 1);
          const int    other = static_cast<int>(std::lround(up ? x : y));
          if (other < 0 || other > (up ? grid.nx : grid.ny))
            return;
          const std::size_t point =
            static_cast<std::size_t>(up ? from : other) * (grid.nx + 1) +
            (up ? other : from);
          crossings[2 * point + (up ? 1 : 0)].emplace_back(along - from, kind);
        };
      for (const OutlineEdge &e : outline)
        {
          const double x0 = .5 * e.x0, x1 = .5 * e.x1;
          const double y0 = .5 * e.y0, y1 = .5 * e.y1;
          cross_lines(y0, y1, x0, x1, [&](const int row, const double x) {
            note(x, row, false, e.kind);
          });
          cross_lines(x0, x1, y0, y1, [&](const int column, const double y) {
            note(column, y, true, e.kind);
          });
        }
      return crossings;
    }
  } // namespace

  FlowRegion::FlowRegion(const PeriodicGrid             &grid,
                         const std::vector<OutlineEdge> &outline,
                         MPI_Comm                        comm)
    : width(grid.nx + 1)
  {
    run_on_root(comm, [&]() { find_points(grid, outline); });
    n_points_inside = sum(comm, n_points_inside);
  }

  void
  FlowRegion::find_points(const PeriodicGrid             &grid,
                          const std::vector<OutlineEdge> &outline)
  {
    flags.assign(static_cast<std::size_t>(width) * (grid.ny + 1), 0);
    static_assert(bit_of(OutlineKind::inlet) == at_inlet &&
                  bit_of(OutlineKind::outlet) == at_outlet);
    // In units of half a spacing, points and midpoints have integer coordinates.
    const double             sx = 2. / grid.dx(), sy = 2. / grid.dy();
    std::vector<OutlineEdge> scaled;
    for (const auto &[x0, y0, x1, y1, kind] : outline)
      scaled.push_back({sx * x0, sy * y0, sx * x1, sy * y1, kind});
    const std::vector<std::uint8_t> marks = mark_half_spacings(grid, scaled);
    const auto                      fine  = [&](const int x, const int y) {
      return marks[static_cast<std::size_t>(y) * (2 * grid.nx + 1) + x];
    };
    for (int iy = 0; iy <= grid.ny; ++iy)
      for (int ix = 0; ix <= grid.nx; ++ix)
        if (const std::uint8_t bits = fine(2 * ix, 2 * iy); bits != 0)
          {
            std::uint8_t &flag = flags[static_cast<std::size_t>(iy) * width + ix];
            flag               = inside | (bits & (at_inlet | at_outlet));
            n_points_inside += ix < grid.nx && iy < grid.ny ? 1 : 0;
            if (ix < grid.nx && fine(2 * ix + 1, 2 * iy) != 0 &&
                fine(2 * ix + 2, 2 * iy) != 0)
              flag |= right;
            if (iy < grid.ny && fine(2 * ix, 2 * iy + 1) != 0 &&
                fine(2 * ix, 2 * iy + 2) != 0)
              flag |= up;
          }
    for (auto &[link, crossings] : find_crossings(grid, scaled))
      {
        const std::size_t first    = link / 2;
        const bool        leads_up = link % 2 == 1;
        const std::size_t second   = first + (leads_up ? width : 1);
        if (is_inside(first) == is_inside(second))
          continue;
        // The crossing nearest to the point inside decides.
        std::sort(crossings.begin(), crossings.end());
        const OutlineKind kind =
          is_inside(first) ? crossings.front().second : crossings.back().second;
        if (kind != OutlineKind::inlet && kind != OutlineKind::outlet)
          continue;
        flags[is_inside(first) ? second : first] |= bit_of(kind);
        flags[first] |= leads_up ? up : right;
      }
    const auto is_some = [this](const int bits) {
      return std::any_of(flags.begin(), flags.end(), [bits](const std::uint8_t flag) {
        return (flag & bits) == bits;
      });
    };
    require(is_some(at_inlet) && is_some(at_outlet) && !is_some(at_inlet | at_outlet),
            "The contact grid is too coarse for Fluid/Mesh: within one grid spacing it "
            "cannot tell inlet and outlet apart; raise Contact/Grid points.");
  }

  bool
  FlowRegion::is_joined(std::size_t k, const int dx, const int dy) const
  {
    // A link is stored at its left or lower end.
    if (dx < 0)
      {
        if (k % width == 0)
          return false;
        --k;
      }
    if (dy < 0)
      {
        if (k < static_cast<std::size_t>(width))
          return false;
        k -= width;
      }
    return (flags[k] & (dx != 0 ? right : up)) != 0;
  }
} // namespace strait
