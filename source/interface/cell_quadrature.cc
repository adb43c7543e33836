// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/rounding.h>
#include <strait/interface/cell_quadrature.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // Largest over smallest gap of a part on which quadrature is trusted, and of one in
    // which the gap bends. With 1.6 for the first a gap takes half as long again to
    // prepare and the bounds are the same; with 4 points might pass by a peak of 1/K that
    // is 60 times as high as what they see. With the second
    // no integral over a random cell is too small by more than 2e-4; with an excess of
    // 0.2 it is 8e-4. Where it does not bend p + 1 points integrate a gap as even as that
    // to 10⁻⁶ (1/K, at p = 1), which need not be asked of more.
    constexpr double trusted_ratio = 2.5, trusted_ratio_with_bend = 1.05;

    // What a part may add to the integral over the cell without being halved, relative.
    // It limits what quadrature adds to the width of the bracket where cells are larger
    // than the spacing; a third of it takes no longer and changes bounds by a few 1e-5.
    constexpr double tolerance = 1e-3;

    // How often a cell is halved, and a small one, which is what is left around throats
    // and whose edge is less than this, in spacings. What is still not resolved widens
    // the bracket: fewer halvings trade the time to prepare a gap for finer meshes. The
    // larger a small one may be, the more cells beside contact are taken for closed.
    constexpr int    most_halvings = 6, most_halvings_of_small_cells = 8;
    constexpr double small_cell = .25;

    /** A rectangle of the unit cell. */
    struct Part
    {
      double x0, y0, width, height;
    };
  } // namespace

  /** The integral over one square, as it grows part by part. */
  struct CellQuadrature::Sum
  {
    using Values     = std::array<double, max_points * max_points>;
    using Quadrature = dealii::Quadrature<2>;

    const CellQuadrature &quadrature;
    const CellGap        &gap;
    const Square         &square;
    const CoefficientLaw &law;
    double               *moments;
    double                scale = 0.; // of the integral

    /** Add a part on which the coefficient is taken to be constant. */
    void
    add_constant(const Part &part, const double value)
    {
      Values values;
      values.fill(value);
      add_values(part, quadrature.coarse, values, 0.);
    }

    /** What is to be known of the gap on a part first; for rigorous bounds its range is
     *  all that counts. */
    struct Look
    {
      CellGap::Range range;
      Values         at_coarse; // points
    };

    static Look
    look_at(const CellQuadrature &quadrature, const CellGap &gap, const Part &part)
    {
      Look look{gap.range(part.x0, part.y0, part.width, part.height), {}};
      if (!quadrature.rigorous)
        evaluate(gap, part, quadrature.coarse, look.at_coarse);
      return look;
    }

    /** Add a part, which may be halved @p n_halvings times. */
    void
    add(const Part &part, const Look &look, const int n_halvings)
    {
      const CellGap::Range &range  = look.range;
      const double          area   = part.width * part.height;
      Values                values = look.at_coarse;
      const double trusted = range.bends ? trusted_ratio_with_bend : trusted_ratio;
      // Next to contact 1/K has no end, though hardly anything flows there: its largest
      // value would block channels a few spacings wide until the cells are small.
      const bool has_no_end =
        square.edge >= small_cell && range.lowest <= rounding * range.highest;
      if (!quadrature.rigorous && !range.bends &&
          range.highest <= trusted_ratio_with_bend * range.lowest)
        {
          apply_law(quadrature.coarse, values);
          add_values(part, quadrature.coarse, values, 0.);
          return;
        }
      if (!quadrature.rigorous && (range.highest <= trusted * range.lowest || has_no_end))
        {
          const double other = apply_law(quadrature.coarse, values);
          const double mean  = sample(part, quadrature.fine, values);
          const double error = std::abs(mean - other);
          if (n_halvings == 0 || has_no_end ||
              error * area <= tolerance * std::max(scale, mean * area))
            {
              add_values(part, quadrature.fine, values, error);
              return;
            }
        }
      else
        {
          const double at_lowest = law(range.lowest), at_highest = law(range.highest);
          if (n_halvings > 0 && scale == 0)
            scale = sample(part, quadrature.fine, values) * area;
          if (n_halvings == 0 ||
              std::abs(at_highest - at_lowest) * area <= tolerance * scale)
            {
              add_constant(part, std::max(at_lowest, at_highest));
              return;
            }
        }
      Part first = part, second = part;
      if (varies_more_along_x(part))
        {
          first.width = second.width = .5 * part.width;
          second.x0 += first.width;
        }
      else
        {
          first.height = second.height = .5 * part.height;
          second.y0 += first.height;
        }
      for (const Part &half : {first, second})
        add(half, look_at(quadrature, gap, half), n_halvings - 1);
    }

  private:
    /** The gap at the points of @p rule. */
    static void
    evaluate(const CellGap &gap, const Part &part, const Quadrature &rule, Values &values)
    {
      const auto &along         = rule.get_tensor_basis()[0];
      const int   n             = static_cast<int>(along.size());
      double      x[max_points] = {}, y[max_points] = {};
      for (int q = 0; q < n; ++q)
        {
          x[q] = part.x0 + part.width * along.point(q)[0];
          y[q] = part.y0 + part.height * along.point(q)[0];
        }
      gap.evaluate(n, x, y, values.data());
    }

    /** Turn gaps at the points of @p rule into the coefficient there. Returns its mean.
     */
    double
    apply_law(const Quadrature &rule, Values &values) const
    {
      double mean = 0.;
      for (unsigned int k = 0; k < rule.size(); ++k)
        {
          values[k] = law(values[k]);
          mean += rule.weight(k) * values[k];
        }
      return mean;
    }

    /** The coefficient at the points of @p rule. Returns its mean. */
    double
    sample(const Part &part, const Quadrature &rule, Values &values) const
    {
      evaluate(gap, part, rule, values);
      return apply_law(rule, values);
    }

    void
    add_values(const Part       &part,
               const Quadrature &rule,
               const Values     &values,
               const double      constant)
    {
      const auto  &along = rule.get_tensor_basis()[0];
      const int    n     = static_cast<int>(along.size());
      const double size  = 1. / square.edge; // of the unit cell, in the square's units
      const double area  = part.width * part.height * size * size;
      double       x[max_points], y[max_points], weighted[max_points * max_points];
      for (int q = 0; q < n; ++q)
        {
          x[q] = (part.x0 + part.width * along.point(q)[0] - square.x0) * size;
          y[q] = (part.y0 + part.height * along.point(q)[0] - square.y0) * size;
        }
      for (int k = 0; k < n * n; ++k)
        weighted[k] = area * rule.weight(k) * (values[k] + constant);
      quadrature.set.add_points(moments, n, x, y, weighted);
    }

    /** Whether halves beside each other are better than one above the other. */
    bool
    varies_more_along_x(const Part &part) const
    {
      const double x[2] = {part.x0, part.x0 + part.width};
      const double y[2] = {part.y0, part.y0 + part.height};
      double       g[4];
      gap.evaluate(2, x, y, g);
      // Ratios, with contact a thousandth of the largest gap: half and double of it only
      // matter where the gap closes along both axes.
      const double least = 1e-3 * *std::max_element(g, g + 4);
      const auto   ratio = [least](const double a, const double b) {
        return (std::max(a, b) + least) / (std::min(a, b) + least);
      };
      const double along_x = std::max(ratio(g[0], g[1]), ratio(g[2], g[3]));
      const double along_y = std::max(ratio(g[0], g[2]), ratio(g[1], g[3]));
      // Both are equal where the gap is open at one corner only: rounding is not to
      // decide.
      return along_x > (1 + rounding) * along_y ||
             (along_x >= (1 - rounding) * along_y && part.width > part.height);
    }
  };

  CellQuadrature::CellQuadrature(const FluidParameters &fluid)
    : set(fluid.element_degree)
    , interpolant{fluid.interpolation, fluid.direction}
    , rigorous(fluid.rigorous_bounds)
    , coarse(fluid.element_degree + 1)
    , fine(fluid.element_degree + 2)
  {
  }

  void
  CellQuadrature::integrate(const GapStencil            &gap,
                            const Square                &square,
                            const std::vector<Integral> &integrals) const
  {
    const double  x0 = std::max(square.x0, 0.), y0 = std::max(square.y0, 0.);
    const Part    part{x0,
                    y0,
                    std::min(square.x0 + square.edge, 1.) - x0,
                    std::min(square.y0 + square.edge, 1.) - y0};
    const CellGap cell(interpolant, gap);
    if (!GapInterpolant::may_be_open(gap))
      {
        for (const auto &[law, moments] : integrals)
          if (law.is_resistivity)
            Sum{*this, cell, square, law, moments}.add_constant(part, law(0.));
        return;
      }
    const Sum::Look look = Sum::look_at(*this, cell, part);
    for (const auto &[law, moments] : integrals)
      Sum{*this, cell, square, law, moments}.add(part,
                                                 look,
                                                 square.edge < small_cell
                                                   ? most_halvings_of_small_cells
                                                   : most_halvings);
  }
} // namespace strait
