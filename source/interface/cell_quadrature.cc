// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/rounding.h>
#include <strait/interface/cell_quadrature.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace strait
{
  namespace
  {
    // Largest over smallest gap of a part, up to which quadrature is trusted and up to
    // which the part counts as even. With 1.6 for the first a gap takes longer to prepare
    // and the bounds are the same; with 4 points might miss a peak of 1/K that is 60
    // times as high as what they see. In an even part bends do not matter, and without
    // bends p + 1 points are enough, with an allowance. Half the excess over 1 gives the
    // same; with double of it the allowance would be up to 4·10⁻⁴ of the integral.
    constexpr double trusted_ratio = 2.5, even_ratio = 1.1;

    // The allowance for p + 1 points, relative to the integral, over the square of the
    // relative variation: they are exact to first order in it. With none, one bracket of
    // a laminate in thirty misses the leak rate, by up to 4·10⁻⁶; with a third or three
    // times of it none does, and cells are as many.
    constexpr double unevenness = .01;

    // What a part may add to the integral over the cell without being divided, relative
    // to the integral. It limits what quadrature adds to the width of the bracket where
    // cells are larger than the spacing. A third of it takes no longer and changes the
    // bounds by a few 1e-5.
    constexpr double tolerance = 1e-3;

    // Largest number of successive divisions. What they leave unresolved widens the
    // bracket: half of it costs one cell in a hundred more, double of it changes nothing.
    constexpr int most_divisions = 8;

    // Edge, in spacings, of the cells that the mesh finally has around throats. Only on
    // smaller cells is 1/K next to contact replaced by its largest value. The larger this
    // edge, the more cells beside contact would count as closed.
    constexpr double small_cell = .25;

    /** A rectangle of the unit cell. */
    struct Part
    {
      std::array<double, 2> start, size; // along x and y

      double
      area() const
      {
        return size[0] * size[1];
      }
    };
  } // namespace

  /** Sums up, part by part, what one cell contributes to the moments of one square. */
  struct CellQuadrature::Sums
  {
    using Values     = std::array<double, max_points * max_points>;
    using Quadrature = dealii::Quadrature<2>;

    const CellQuadrature &quadrature;
    const CellGap        &gap;
    const Square         &square;

    /** What is known of the gap on a part, for all coefficients. Rigorous bounds rest on
     *  the range alone. */
    struct GapSamples
    {
      CellGap::Range        range;
      Values                at_coarse = {}; // gaps at the points of the coarse rule
      std::optional<Values> at_fine   = {}; // of the fine rule, once needed
    };

    GapSamples
    look_at(const Part &part) const
    {
      GapSamples look{
        gap.range(part.start[0], part.start[1], part.size[0], part.size[1])};
      if (!quadrature.rigorous)
        evaluate(part, quadrature.coarse, look.at_coarse);
      return look;
    }

    /** Add a part, which may be divided @p n_divisions times in succession, to the
     *  integrals from @p begin to @p end, whose order changes. */
    void
    add(const Part &part,
        GapSamples  look,
        const int   n_divisions,
        Integral   *begin,
        Integral   *end) const
    {
      end = std::partition(begin, end, [&](Integral &sum) {
        return !take(part, look, n_divisions > 0, sum);
      });
      if (begin != end)
        for (const Part &piece : divide(part, look.range))
          add(piece, look_at(piece), n_divisions - 1, begin, end);
    }

    /** Add a part on which the coefficient is taken to be constant. */
    void
    add_constant(const Part &part, const double value, double *moments) const
    {
      Values values;
      values.fill(value);
      add_values(part, quadrature.coarse, values, 0., moments);
    }

  private:
    /** Add a part to @p sum and return true; or return false if the part has to be
     *  divided for that, which @p may_divide allows. */
    bool
    take(const Part &part, GapSamples &look, const bool may_divide, Integral &sum) const
    {
      const CellGap::Range &range   = look.range;
      const double          trusted = range.bends() ? even_ratio : trusted_ratio;
      // Next to contact 1/K is practically unbounded, though hardly anything flows there.
      // Its largest value would block channels a few spacings wide until the cells are
      // small.
      const bool touches_contact =
        square.edge >= small_cell && range.lowest <= rounding * range.highest;
      if (!quadrature.rigorous && !range.bends() &&
          range.highest <= even_ratio * range.lowest)
        {
          Values       values = look.at_coarse;
          const double mean   = apply_law(quadrature.coarse, sum.law, values);
          const double rise =
            range.highest > range.lowest ? range.highest / range.lowest - 1. : 0.;
          add_values(part,
                     quadrature.coarse,
                     values,
                     unevenness * rise * rise * mean,
                     sum.moments);
          return true;
        }
      if (!quadrature.rigorous &&
          (range.highest <= trusted * range.lowest || touches_contact))
        {
          Values       values = look.at_coarse;
          const double other  = apply_law(quadrature.coarse, sum.law, values);
          const double mean   = sample(part, sum.law, look, values);
          const double error  = std::abs(mean - other);
          if (may_divide && !touches_contact &&
              error * part.area() > tolerance * std::max(sum.scale, mean * part.area()))
            return false;
          add_values(part, quadrature.fine, values, error, sum.moments);
          return true;
        }
      const double at_lowest = sum.law(range.lowest), at_highest = sum.law(range.highest);
      Values       values;
      if (may_divide && sum.scale == 0)
        sum.scale = sample(part, sum.law, look, values) * part.area();
      if (may_divide &&
          std::abs(at_highest - at_lowest) * part.area() > tolerance * sum.scale)
        return false;
      add_constant(part, std::max(at_lowest, at_highest), sum.moments);
      return true;
    }

    /** Evaluate the gap at the points of @p rule. */
    void
    evaluate(const Part &part, const Quadrature &rule, Values &values) const
    {
      const auto &along         = rule.get_tensor_basis()[0];
      const int   n             = static_cast<int>(along.size());
      double      x[max_points] = {}, y[max_points] = {};
      for (int q = 0; q < n; ++q)
        {
          x[q] = part.start[0] + part.size[0] * along.point(q)[0];
          y[q] = part.start[1] + part.size[1] * along.point(q)[0];
        }
      gap.evaluate(n, x, y, values.data());
    }

    /** Turn the gaps at the points of @p rule into the coefficient; return its mean. */
    static double
    apply_law(const Quadrature &rule, const CoefficientLaw &law, Values &values)
    {
      double mean = 0.;
      for (unsigned int k = 0; k < rule.size(); ++k)
        {
          values[k] = law(values[k]);
          mean += rule.weight(k) * values[k];
        }
      return mean;
    }

    /** Evaluate the coefficient at the points of the fine rule; return its mean. */
    double
    sample(const Part           &part,
           const CoefficientLaw &law,
           GapSamples           &look,
           Values               &values) const
    {
      if (!look.at_fine)
        evaluate(part, quadrature.fine, look.at_fine.emplace());
      values = *look.at_fine;
      return apply_law(quadrature.fine, law, values);
    }

    void
    add_values(const Part       &part,
               const Quadrature &rule,
               const Values     &values,
               const double      constant,
               double           *moments) const
    {
      const auto  &along = rule.get_tensor_basis()[0];
      const int    n     = static_cast<int>(along.size());
      const double size  = 1. / square.edge; // of the unit cell, over the square's
      const double area  = part.area() * size * size;
      double       x[max_points], y[max_points], weighted[max_points * max_points];
      for (int q = 0; q < n; ++q)
        {
          x[q] = (part.start[0] + part.size[0] * along.point(q)[0] - square.x0) * size;
          y[q] = (part.start[1] + part.size[1] * along.point(q)[0] - square.y0) * size;
        }
      for (int k = 0; k < n * n; ++k)
        weighted[k] = area * rule.weight(k) * (values[k] + constant);
      quadrature.set.add_points(moments, n, x, y, weighted);
    }

    /** Return the parts on both sides of a line on which the gap bends, or else two
     *  halves. */
    std::array<Part, 2>
    divide(const Part &part, const CellGap::Range &range) const
    {
      const bool   bends = range.bends() && !quadrature.rigorous;
      const int    axis  = bends ? quadrature.interpolant.direction == FlowDirection::y
                                 : !varies_more_along_x(part);
      const double start = part.start[axis], size = part.size[axis];
      const double first =
        bends ? gap.bend(range.crossing, start, start + size) - start : .5 * size;
      std::array<Part, 2> parts = {part, part};
      parts[0].size[axis]       = first;
      parts[1].start[axis]      = start + first;
      parts[1].size[axis]       = size - first;
      return parts;
    }

    /** Whether to divide into halves beside each other rather than above each other. */
    bool
    varies_more_along_x(const Part &part) const
    {
      const double x[2] = {part.start[0], part.start[0] + part.size[0]};
      const double y[2] = {part.start[1], part.start[1] + part.size[1]};
      double       g[4];
      gap.evaluate(2, x, y, g);
      // A thousandth of the largest gap is added, so that ratios are finite in contact.
      // Half and double of it matter only where the gap closes along both axes.
      const double least = 1e-3 * *std::max_element(g, g + 4);
      const auto   ratio = [least](const double a, const double b) {
        return (std::max(a, b) + least) / (std::min(a, b) + least);
      };
      const double along_x = std::max(ratio(g[0], g[1]), ratio(g[2], g[3]));
      const double along_y = std::max(ratio(g[0], g[2]), ratio(g[1], g[3]));
      // Both are equal where the gap is open at one corner only: rounding must not
      // decide.
      return along_x > (1 + rounding) * along_y ||
             (along_x >= (1 - rounding) * along_y && part.size[0] > part.size[1]);
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
    const Part    part{{{x0, y0}},
                    {{std::min(square.x0 + square.edge, 1.) - x0,
                         std::min(square.y0 + square.edge, 1.) - y0}}};
    const CellGap cell(interpolant, gap);
    const Sums    sums{*this, cell, square};
    if (!GapInterpolant::may_be_open(gap))
      {
        for (const Integral &integral : integrals)
          if (integral.law.is_resistivity)
            sums.add_constant(part, integral.law(0.), integral.moments);
        return;
      }
    boost::container::small_vector<Integral, 2> all(integrals.begin(), integrals.end());
    sums.add(
      part, sums.look_at(part), most_divisions, all.data(), all.data() + all.size());
  }
} // namespace strait
