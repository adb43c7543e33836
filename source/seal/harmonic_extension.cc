// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/iteration.h>
#include <strait/contact/grid_transfer.h>
#include <strait/seal/fluid_on_wall.h>
#include <strait/spectral/fill_windows.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    /** Lines of a grid on which the pressure is known, whatever the gap is there. */
    struct KnownLines
    {
      FlowDirection direction;
      double        inlet;   // pressure of the seam, seen from the points after it
      double        outlet;  // and from those before it
      int           seam;    // the column or row that is inlet and outlet; −1: none
      bool          has_rim; // the outermost points are known as well
    };

    /** The linear system for the unknown pressures, on a grid without windows. */
    class ExtensionProblem
    {
    public:
      ExtensionProblem(const SlabField &flow_gap, const KnownLines &lines_)
        : spring(flow_gap.size())
        , layout(flow_gap.layout())
        , lines(lines_)
        , weight_x(layout.grid().dy() / layout.grid().dx())
        , weight_y(layout.grid().dx() / layout.grid().dy())
        , factor(flow_gap.size())
      {
        // Best for contacts some twenty points across, as they occur near the threshold.
        // 1.9 and 1.6 take a third more iterations.
        constexpr double over_relaxation = 1.8;

        const int        nx = layout.grid().nx;
        const RowsAround rows(flow_gap);
        for (int row = 0, k = 0; row < layout.n_rows(); ++row)
          for (int ix = 0; ix < nx; ++ix, ++k)
            {
              double largest = 0;
              for (int b = -1; b <= 1; ++b)
                for (int a = -1; a <= 1; ++a)
                  largest =
                    std::max(largest, std::abs(rows[row + b][(ix + a + nx) % nx]));
              // A point counts as open from half of the largest gap around it.
              const double ratio =
                largest > 0 ? 2. * std::abs(flow_gap[k]) / largest : 0.;
              const double sides = weight_x + weight_y;
              spring[k]          = ratio < 1 && flow_gap[k] >= 0. && !is_on_line(ix, row)
                                     ? sides * ratio * ratio / (1. - ratio)
                                     : std::numeric_limits<double>::infinity();
              factor[k]          = over_relaxation / (2. * sides + spring[k]);
              if (std::isfinite(spring[k]))
                points.push_back(k);
            }
      }

      bool
      is_on_seam(const int ix, const int local_row) const
      {
        return (lines.direction == FlowDirection::x
                  ? ix
                  : layout.first_row() + local_row) == lines.seam;
      }

      bool
      is_on_line(const int ix, const int local_row) const
      {
        const PeriodicGrid &grid = layout.grid();
        const int           iy   = layout.first_row() + local_row;
        return is_on_seam(ix, local_row) ||
               (lines.has_rim &&
                (ix == 0 || iy == 0 || ix == grid.nx - 1 || iy == grid.ny - 1));
      }

      /** Apply −∇² times dx dy, plus the springs, at the unknown points. The seam counts
       *  as @p inlet for the points after it and as @p outlet for those before it.
       *  Collective. */
      void
      apply(const SlabField &values,
            const double     inlet,
            const double     outlet,
            SlabField       &result) const
      {
        const int        nx = layout.grid().nx, ny = layout.grid().ny;
        const int        begin = layout.first_row(), n_rows = layout.n_rows();
        const bool       along_x = lines.direction == FlowDirection::x;
        const RowsAround rows(values);
        auto             k = points.begin();
        for (int row = 0; row < n_rows; ++row)
          {
            const double *here = rows[row], *below = rows[row - 1],
                         *above   = rows[row + 1];
            const int  iy         = begin + row;
            const bool after_seam = !along_x && (iy == 0 ? ny - 1 : iy - 1) == lines.seam;
            const bool before_seam =
              !along_x && (iy == ny - 1 ? 0 : iy + 1) == lines.seam;
            for (; k != points.end() && *k < (row + 1) * nx; ++k)
              {
                const int    ix    = *k - row * nx;
                const int    west  = ix == 0 ? nx - 1 : ix - 1;
                const int    east  = ix == nx - 1 ? 0 : ix + 1;
                const double left  = along_x && west == lines.seam ? inlet : here[west];
                const double right = along_x && east == lines.seam ? outlet : here[east];
                const double lower = after_seam ? inlet : below[ix];
                const double upper = before_seam ? outlet : above[ix];
                result[*k]         = spring[*k] * here[ix] +
                             weight_x * (2. * here[ix] - left - right) +
                             weight_y * (2. * here[ix] - lower - upper);
              }
          }
      }

      /** Set z to the preconditioner times r at the unknown points; z must be zero
       *  elsewhere. */
      void
      precondition(const SlabField &r, SlabField &z) const
      {
        // The rows of a rank count as one long row; neighbours on other ranks, and across
        // the periodic seams, are left out. Each point waits for the one beside it, so
        // everything else is computed first.
        const int nx = layout.grid().nx, n = nx * layout.n_rows();
        int       before  = -2;
        double    z_there = 0.;
        for (const int k : points)
          {
            const double below = k >= nx ? z[k - nx] : 0.;
            const double alone = factor[k] * (r[k] + weight_y * below);
            z_there = alone + factor[k] * weight_x * (before == k - 1 ? z_there : 0.);
            z[k]    = z_there;
            before  = k;
          }
        before = n + 1;
        for (auto point = points.rbegin(); point != points.rend(); ++point)
          {
            const int    k     = *point;
            const double above = k + nx < n ? z[k + nx] : 0.;
            const double alone = z[k] + factor[k] * weight_y * above;
            z_there = alone + factor[k] * weight_x * (before == k + 1 ? z_there : 0.);
            z[k]    = z_there;
            before  = k;
          }
      }

      // κ dx dy; infinite where the pressure is known.
      std::vector<double> spring;

      std::vector<int> points; // the unknown ones, ascending

    private:
      const SlabLayout &layout;
      const KnownLines  lines;
      const double      weight_x, weight_y; // dy/dx and dx/dy

      // Over-relaxation over the diagonal entry of each point.
      std::vector<double> factor;
    };

    /** extend_under_contact() on a grid without windows, where @p lines are known. */
    int
    extend(SlabField &pressure, const SlabField &flow_gap, const KnownLines &lines)
    {
      // Relative to the residual of the boundary values alone, in the norm of the
      // preconditioner: the precision in which FixedPoint stores earlier rounds.
      constexpr double       tolerance = std::numeric_limits<float>::epsilon();
      const SlabLayoutPtr    layout    = pressure.layout_pointer();
      const ExtensionProblem problem(flow_gap, lines);

      // Boundary values and springs make the right-hand side.
      SlabField boundary_values(layout), load(layout);
      for (int row = 0, k = 0; row < layout->n_rows(); ++row)
        for (int ix = 0; ix < layout->grid().nx; ++ix, ++k)
          {
            if (problem.is_on_seam(ix, row))
              pressure[k] = .5 * (lines.inlet + lines.outlet);
            if (std::isinf(problem.spring[k]))
              boundary_values[k] = pressure[k];
            else
              load[k] = problem.spring[k] * pressure[k];
          }

      SlabField  r(layout), z(layout), t(layout), q(layout);
      const auto precondition = [&]() {
        problem.precondition(r, z);
        return product(r, z);
      };
      problem.apply(boundary_values, lines.inlet, lines.outlet, r);
      for (const int k : problem.points)
        r[k] -= load[k];
      const double enough = tolerance * tolerance * precondition();
      if (!(enough > 0))
        {
          // There is no pressure at the edge of the contact, hence none under it.
          pressure = boundary_values;
          return 0;
        }
      problem.apply(pressure, lines.inlet, lines.outlet, r);
      for (const int k : problem.points)
        r[k] = load[k] - r[k];

      double r_z       = precondition();
      double beta      = 0.;
      int    iteration = 0;
      while (r_z > enough && iteration < iteration_limit)
        {
          for (const int k : problem.points)
            t[k] = z[k] + beta * t[k];
          problem.apply(t, 0., 0., q);
          const double alpha = r_z / product(t, q);
          for (const int k : problem.points)
            {
              pressure[k] += alpha * t[k];
              r[k] -= alpha * q[k];
            }
          const double before = r_z;
          r_z                 = precondition();
          beta                = r_z / before;
          ++iteration;
        }
      return iteration;
    }

    /** The same in window @p w, with the pressures of its parent around it as boundary
     *  values; @p lines are those of the grid. Collective if the parent is the grid. */
    int
    extend_in_window(SlabField       &pressure,
                     const SlabField &flow_gap,
                     const int        w,
                     KnownLines       lines)
    {
      const SlabLayout &layout = pressure.layout();
      const auto [dx, dy]      = layout.spacing(w);
      const int seam = layout.seam(w, lines.direction == FlowDirection::x ? 0 : 1);
      lines.seam     = seam < 0 ? -1 : seam + 1;
      lines.has_rim  = true;
      const int           nx  = layout.windows()[w].n_columns() + 2;
      const int           ny  = layout.windows()[w].n_rows() + 2;
      const SlabLayoutPtr box = make_layout({nx, ny, nx * dx, ny * dy}, MPI_COMM_SELF);
      const std::vector<double> around = around_window(pressure, w);
      SlabField                 within(box), gap(box);
      std::copy(around.begin(), around.end(), within.begin());
      const auto for_each_row = [&](const auto &visit) {
        for (int iy = 1; iy < ny - 1; ++iy)
          visit(layout.start_of_window(w) + static_cast<std::size_t>(iy - 1) * (nx - 2),
                &within(1, iy),
                &gap(1, iy));
      };
      for_each_row([&](const std::size_t k, double *of_fluid, double *of_gap) {
        std::copy_n(pressure.data() + k, nx - 2, of_fluid);
        std::copy_n(flow_gap.data() + k, nx - 2, of_gap);
      });
      const int iterations = extend(within, gap, lines);
      for_each_row([&](const std::size_t k, const double *of_fluid, const double *) {
        std::copy_n(of_fluid, nx - 2, pressure.data() + k);
      });
      return iterations;
    }
  } // namespace

  int
  extend_under_contact(SlabField          &pressure,
                       const SlabField    &flow_gap,
                       const FlowDirection direction,
                       const double        inlet_pressure,
                       const double        outlet_pressure)
  {
    const SlabLayout &layout    = pressure.layout();
    const int         n_windows = static_cast<int>(layout.windows().size());
    const KnownLines  on_grid   = {direction, inlet_pressure, outlet_pressure, 0, false};
    if (n_windows == 0)
      return extend(pressure, flow_gap, on_grid);
    const SlabLayoutPtr grid = with_windows(layout, {});
    SlabField           of_fluid(grid), of_gap(grid);
    std::copy_n(pressure.begin(), of_fluid.size(), of_fluid.begin());
    std::copy_n(flow_gap.begin(), of_gap.size(), of_gap.begin());
    int iterations = extend(of_fluid, of_gap, on_grid);
    std::copy(of_fluid.begin(), of_fluid.end(), pressure.begin());
    for (int w = 0; w < n_windows; ++w)
      iterations += extend_in_window(pressure, flow_gap, w, on_grid);
    copy_to_covered(pressure);
    return iterations;
  }
} // namespace strait
