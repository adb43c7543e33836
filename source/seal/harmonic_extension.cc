// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/seal/fluid_on_wall.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    /** The equations of the points at which the pressure is sought. */
    class ExtensionProblem
    {
    public:
      ExtensionProblem(const SlabField &flow_gap, const FlowDirection direction_)
        : spring(flow_gap.size())
        , layout(flow_gap.layout())
        , direction(direction_)
        , weight_x(layout.grid().dy() / layout.grid().dx())
        , weight_y(layout.grid().dx() / layout.grid().dy())
        , share(flow_gap.size())
      {
        // The best for contacts of some twenty points across, as there are near the
        // threshold. Half of what it lacks to 2, and double, take a third more
        // iterations.
        constexpr double over_relaxation = 1.8;

        const int        nx = layout.grid().nx;
        const RowsAround rows(flow_gap);
        for (int row = 0, k = 0; row < layout.n_rows(); ++row)
          for (int ix = 0; ix < nx; ++ix, ++k)
            {
              double largest = 0;
              for (int b = -1; b <= 1; ++b)
                for (int a = -1; a <= 1; ++a)
                  largest = std::max(largest, rows[row + b][(ix + a + nx) % nx]);
              // A point is open with half of the largest gap beside it.
              const double ratio =
                largest > 0 ? 2. * std::max(flow_gap[k], 0.) / largest : 0.;
              const double sides = weight_x + weight_y;
              spring[k]          = ratio < 1 && !is_on_seam(ix, row)
                                     ? sides * ratio * ratio / (1. - ratio)
                                     : std::numeric_limits<double>::infinity();
              share[k]           = over_relaxation / (2. * sides + spring[k]);
              if (std::isfinite(spring[k]))
                points.push_back(k);
            }
      }

      bool
      is_on_seam(const int ix, const int local_row) const
      {
        return direction == FlowDirection::x ? ix == 0
                                             : layout.first_row() + local_row == 0;
      }

      /** −Laplacian times dx·dy, and the springs' pull towards 0, where the pressure is
       *  sought; the seam counts as @p inlet from its one side and as @p outlet from the
       *  other. Collective. */
      void
      apply(const SlabField &values,
            const double     inlet,
            const double     outlet,
            SlabField       &result) const
      {
        const int        nx = layout.grid().nx, ny = layout.grid().ny;
        const int        begin = layout.first_row(), n_rows = layout.n_rows();
        const bool       along_x = direction == FlowDirection::x;
        const RowsAround rows(values);
        auto             k = points.begin();
        for (int row = 0; row < n_rows; ++row)
          {
            const double *here = rows[row], *below = rows[row - 1],
                         *above = rows[row + 1];
            const int iy        = begin + row;
            for (; k != points.end() && *k < (row + 1) * nx; ++k)
              {
                const int    ix = *k - row * nx;
                const double left =
                  along_x && ix == 1 ? inlet : here[ix == 0 ? nx - 1 : ix - 1];
                const double right =
                  along_x && ix == nx - 1 ? outlet : here[ix == nx - 1 ? 0 : ix + 1];
                const double lower = !along_x && iy == 1 ? inlet : below[ix];
                const double upper = !along_x && iy == ny - 1 ? outlet : above[ix];
                result[*k]         = spring[*k] * here[ix] +
                             weight_x * (2. * here[ix] - left - right) +
                             weight_y * (2. * here[ix] - lower - upper);
              }
          }
      }

      /** z = the preconditioner times r where the pressure is sought; elsewhere z must be
       *  zero. */
      void
      precondition(const SlabField &r, SlabField &z) const
      {
        // Neighbours across the edge of the box, and of other ranks, are left out.
        const int nx = layout.grid().nx, n = nx * layout.n_rows();
        for (const int k : points)
          {
            const double left  = k % nx > 0 ? z[k - 1] : 0.;
            const double below = k >= nx ? z[k - nx] : 0.;
            z[k]               = share[k] * (r[k] + weight_x * left + weight_y * below);
          }
        for (auto point = points.rbegin(); point != points.rend(); ++point)
          {
            const int    k     = *point;
            const double right = (k + 1) % nx > 0 ? z[k + 1] : 0.;
            const double above = k + nx < n ? z[k + nx] : 0.;
            z[k] += share[k] * (weight_x * right + weight_y * above);
          }
      }

      // κ dx dy; infinite where the pressure is known.
      std::vector<double> spring;

      std::vector<int> points; // at which it is sought, ascending

    private:
      const SlabLayout   &layout;
      const FlowDirection direction;
      const double        weight_x, weight_y; // dy/dx and dx/dy

      // How much of its own equation's residual a point takes.
      std::vector<double> share;
    };
  } // namespace

  int
  extend_under_contact(SlabField          &pressure,
                       const SlabField    &flow_gap,
                       const FlowDirection direction,
                       const double        inlet_pressure,
                       const double        outlet_pressure)
  {
    // Of the boundary values' own residual, in the norm of the preconditioner: as exactly
    // as FixedPoint remembers the pressures of earlier rounds.
    constexpr double tolerance = std::numeric_limits<float>::epsilon();
    // It only ends what would go on for ever: half of it would be enough where the
    // preconditioner works, double of it fails later.
    constexpr int          max_iterations = 1000;
    const SlabLayoutPtr    layout         = pressure.layout_pointer();
    const ExtensionProblem problem(flow_gap, direction);

    // Boundary values and springs alone, which are the right-hand side.
    SlabField boundary_values(layout), load(layout);
    for (int row = 0, k = 0; row < layout->n_rows(); ++row)
      for (int ix = 0; ix < layout->grid().nx; ++ix, ++k)
        {
          if (problem.is_on_seam(ix, row))
            pressure[k] = .5 * (inlet_pressure + outlet_pressure);
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
    problem.apply(boundary_values, inlet_pressure, outlet_pressure, r);
    for (const int k : problem.points)
      r[k] -= load[k];
    const double enough = tolerance * tolerance * precondition();
    if (!(enough > 0))
      {
        // No pressure anywhere at the edge of the contact, hence none under it.
        pressure = boundary_values;
        return 0;
      }
    problem.apply(pressure, inlet_pressure, outlet_pressure, r);
    for (const int k : problem.points)
      r[k] = load[k] - r[k];

    double r_z       = precondition();
    double beta      = 0.;
    int    iteration = 0;
    while (r_z > enough && iteration < max_iterations)
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
} // namespace strait
