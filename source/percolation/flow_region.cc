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
    /** The outline in units of half a grid spacing, so that grid points and the middles
     *  between them have integer coordinates. */
    struct Segment
    {
      double       x[2], y[2];
      std::uint8_t kind; // a bit
    };

    std::uint8_t
    bit_of(const OutlineKind kind)
    {
      return static_cast<std::uint8_t>(1U << static_cast<unsigned int>(kind));
    }

    std::vector<Segment>
    in_half_spacings(const PeriodicGrid &grid, const std::vector<OutlineEdge> &outline)
    {
      const double         sx = 2. / grid.dx(), sy = 2. / grid.dy();
      std::vector<Segment> segments;
      segments.reserve(outline.size());
      for (const OutlineEdge &edge : outline)
        segments.push_back({{edge.x0 * sx, edge.x1 * sx},
                            {edge.y0 * sy, edge.y1 * sy},
                            bit_of(edge.kind)});
      return segments;
    }

    /** Call @p visit(line, where) for each integer line from @p a0 to @p a1, half open
     *  so that a chain of segments meets a line as often as it crosses it. */
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

    /** The doubled lattice: which points lie inside, and on which parts of the outline.
     */
    class FineLattice
    {
    public:
      FineLattice(const PeriodicGrid &grid, const std::vector<Segment> &segments)
        : n_x(2 * grid.nx + 1)
        , n_y(2 * grid.ny + 1)
        , is_inside(static_cast<std::size_t>(n_x) * n_y, 0)
        , on_outline(is_inside.size(), 0)
      {
        fill_inside(segments);
        for (const Segment &segment : segments)
          mark_outline(segment);
      }

      bool
      inside(const int x, const int y) const
      {
        return is_inside[index(x, y)] != 0 || on_outline[index(x, y)] != 0;
      }

      std::uint8_t
      outline(const int x, const int y) const
      {
        return on_outline[index(x, y)];
      }

    private:
      std::size_t
      index(const int x, const int y) const
      {
        return static_cast<std::size_t>(y) * n_x + x;
      }

      /** By the even–odd rule. */
      void
      fill_inside(const std::vector<Segment> &segments)
      {
        std::vector<std::vector<double>> crossings(n_y);
        for (const Segment &s : segments)
          cross_lines(s.y[0], s.y[1], s.x[0], s.x[1], [&](const int y, const double x) {
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
                is_inside[index(x, y)] = 1;
          }
      }

      void
      mark_outline(const Segment &s)
      {
        const bool   steep = std::abs(s.y[1] - s.y[0]) > std::abs(s.x[1] - s.x[0]);
        const double a0 = steep ? s.y[0] : s.x[0], a1 = steep ? s.y[1] : s.x[1];
        const double b0 = steep ? s.x[0] : s.y[0], b1 = steep ? s.x[1] : s.y[1];
        const int    first =
          static_cast<int>(std::ceil(std::min(a0, a1) - 2 * precision_of_meshes));
        for (int a = first; a <= std::max(a0, a1) + 2 * precision_of_meshes; ++a)
          {
            const double b       = a1 == a0 ? b0 : b0 + (b1 - b0) * (a - a0) / (a1 - a0);
            const int    nearest = static_cast<int>(std::lround(b));
            if (std::abs(b - nearest) > 2 * precision_of_meshes)
              continue;
            const int x = steep ? nearest : a, y = steep ? a : nearest;
            if (x >= 0 && x < n_x && y >= 0 && y < n_y)
              on_outline[index(x, y)] |= s.kind;
          }
      }

      int                       n_x, n_y;
      std::vector<std::uint8_t> is_inside, on_outline;
    };

    /** Where segments cross the link from a point to its right or upper neighbour: how
     *  far on it, and the kind. */
    using LinkCrossings =
      std::map<std::size_t, std::vector<std::pair<double, std::uint8_t>>>;

    /** A link is numbered twice its point, and one more if it leads up. */
    LinkCrossings
    find_crossings(const PeriodicGrid &grid, const std::vector<Segment> &segments)
    {
      LinkCrossings crossings;
      const auto    note = [&](const double x, const double y, const bool up, int kind) {
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
      for (const Segment &s : segments)
        {
          const double x0 = .5 * s.x[0], x1 = .5 * s.x[1];
          const double y0 = .5 * s.y[0], y1 = .5 * s.y[1];
          cross_lines(y0, y1, x0, x1, [&](const int row, const double x) {
            note(x, row, false, s.kind);
          });
          cross_lines(x0, x1, y0, y1, [&](const int column, const double y) {
            note(column, y, true, s.kind);
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
    const std::uint8_t         inlet_bit  = bit_of(OutlineKind::inlet);
    const std::uint8_t         outlet_bit = bit_of(OutlineKind::outlet);
    const std::vector<Segment> segments   = in_half_spacings(grid, outline);
    const FineLattice          fine(grid, segments);
    const auto                 mark = [&](const std::size_t k, const std::uint8_t kinds) {
      flags[k] |= ((kinds & inlet_bit) != 0 ? at_inlet : 0) |
                  ((kinds & outlet_bit) != 0 ? at_outlet : 0);
    };
    for (int iy = 0; iy <= grid.ny; ++iy)
      for (int ix = 0; ix <= grid.nx; ++ix)
        if (fine.inside(2 * ix, 2 * iy))
          {
            const std::size_t k = static_cast<std::size_t>(iy) * width + ix;
            flags[k] |= inside;
            n_points_inside += ix < grid.nx && iy < grid.ny ? 1 : 0;
            mark(k, fine.outline(2 * ix, 2 * iy));
            if (ix < grid.nx && fine.inside(2 * ix + 1, 2 * iy) &&
                fine.inside(2 * ix + 2, 2 * iy))
              flags[k] |= right;
            if (iy < grid.ny && fine.inside(2 * ix, 2 * iy + 1) &&
                fine.inside(2 * ix, 2 * iy + 2))
              flags[k] |= up;
          }
    for (auto &[link, crossings] : find_crossings(grid, segments))
      {
        const std::size_t first    = link / 2;
        const bool        leads_up = link % 2 == 1;
        const std::size_t second   = first + (leads_up ? width : 1);
        if (is_inside(first) == is_inside(second))
          continue;
        // The part of the outline that is nearest to the point inside.
        std::sort(crossings.begin(), crossings.end());
        const std::uint8_t kind =
          is_inside(first) ? crossings.front().second : crossings.back().second;
        if (kind == bit_of(OutlineKind::wall))
          continue;
        mark(is_inside(first) ? second : first, kind);
        flags[first] |= leads_up ? up : right;
      }
    bool has_inlet = false, has_outlet = false, confused = false;
    for (std::size_t k = 0; k < flags.size(); ++k)
      {
        has_inlet  = has_inlet || is_inlet(k);
        has_outlet = has_outlet || is_outlet(k);
        confused   = confused || (is_inlet(k) && is_outlet(k));
      }
    if (confused || !has_inlet || !has_outlet)
      throw InputError(
        "The contact grid is too coarse for Fluid/Mesh: within one grid spacing it "
        "cannot tell inlet and outlet apart; raise Contact/Grid points.");
  }

  bool
  FlowRegion::is_joined(std::size_t k, const int dx, const int dy) const
  {
    // A link is kept at its left or lower end.
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
