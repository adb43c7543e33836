// SPDX-License-Identifier: GPL-2.0-or-later
// Gaps that vary arbitrarily between neighbouring points, as the product of a profile
// along the flow and one across it. Their interpolant is such a product as well, whose
// leak rate is known. No bracket with the status "ok" may miss it. STRAIT_TRUST_GAPS sets
// the number of gaps; doc/accuracy.md reports 500.
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "flow_fixture.h"

namespace strait
{
  namespace
  {
    using Profile = std::vector<double>;

    double
    harmonic_mean(const double a, const double b)
    {
      return a * b > 0 ? 2 * a * b / (a + b) : 0.;
    }

    /** Return the mean of a @p power of the interpolant of @p v, by adaptive quadrature
     *  on both halves of each interval, to a tolerance of 1e-13. */
    double
    mean_of_power(const Profile &v, const GapInterpolation kind, const double power)
    {
      const std::size_t n   = v.size();
      const auto        at  = [&](const std::size_t k) { return v[k % n]; };
      double            sum = 0;
      for (std::size_t k = 0; k < n; ++k)
        {
          const double a = at(k), rise = at(k + 1) - a;
          const bool   is_linear = kind == GapInterpolation::bilinear;
          const double left = is_linear ? rise : harmonic_mean(a - at(k + n - 1), rise);
          const double right =
            is_linear ? rise : harmonic_mean(rise, at(k + 2) - at(k + 1));
          const auto integrand = [&](const double t) {
            const double u = 1 - t;
            return std::pow(u * u * (1 + 2 * t) * a + t * t * (1 + 2 * u) * (a + rise) +
                              t * u * (u * left - t * right),
                            power);
          };
          using boost::math::quadrature::gauss_kronrod;
          for (const double end : {0., .5})
            sum +=
              gauss_kronrod<double, 31>::integrate(integrand, end, end + .5, 15, 1e-13);
        }
      return sum / static_cast<double>(n);
    }

    /** A gap A(x) B(y), or A(y) B(x) if the fluid flows along y, with the profiles A
     *  along the flow and B across it. */
    struct Laminate
    {
      Profile         along, across;
      FluidParameters fluid;
      std::string     name;

      SlabField
      gap() const
      {
        const int n_along  = static_cast<int>(along.size()),
                  n_across = static_cast<int>(across.size());
        const bool is_x    = fluid.direction == FlowDirection::x;
        SlabField  field(
          make_layout({is_x ? n_along : n_across, is_x ? n_across : n_along, 1., 1.},
                      MPI_COMM_WORLD));
        for (int row = 0; row < field.layout().n_rows(); ++row)
          for (int ix = 0; ix < field.layout().grid().nx; ++ix)
            {
              const int iy   = field.layout().first_row() + row;
              field(ix, row) = is_x ? along[ix] * across[iy] : along[iy] * across[ix];
            }
        return field;
      }

      double
      leak_rate() const
      {
        return mean_of_power(across, fluid.interpolation, 3.) /
               mean_of_power(along, fluid.interpolation, -3.);
      }
    };

    /** Expect that a bracket with the status "ok" contains the exact leak rate. @return
     *  whether it has that status. */
    bool
    expect_not_fooled(const Laminate &laminate)
    {
      SCOPED_TRACE(laminate.name);
      const double  exact = laminate.leak_rate();
      const Leakage flow  = leak(laminate.gap(), laminate.fluid);
      if (std::getenv("STRAIT_TRUST_GAPS") != nullptr)
        std::printf("%-40s %-13s %6llu  %.6e  %+.2e %+.2e\n",
                    laminate.name.c_str(),
                    flow.status.c_str(),
                    flow.unknowns,
                    exact,
                    flow.lower / exact - 1,
                    flow.upper / exact - 1);
      if (flow.status != "ok")
        return false;
      // The tolerance is for rounding and the floor of the conductivity.
      EXPECT_LE(flow.lower, exact * (1 + 1e-7));
      EXPECT_GE(flow.upper, exact * (1 - 1e-7));
      return true;
    }

    /** Random laminates that vary along the flow, across it, and both, in turn. */
    class Laminates
    {
    public:
      explicit Laminates(const unsigned int seed)
        : random(seed)
      {
      }

      Laminate
      next()
      {
        const int n = 1 << integer(3, 5);
        Laminate  result;
        result.fluid                  = plain_fluid(integer(0, 3) == 0 ? .005 : .02);
        result.fluid.maximum_unknowns = 20000;
        if (integer(0, 4) == 0)
          result.fluid.interpolation = GapInterpolation::bilinear;
        if (integer(0, 3) == 0)
          result.fluid.direction = FlowDirection::y;
        const int orientation = n_so_far++ % 3;
        result.along          = Profile(n, 1.);
        result.across         = Profile(n, 1.);
        if (orientation != 1)
          result.along = profile(n, result.name);
        result.name += " x ";
        if (orientation != 0)
          result.across = profile(n, result.name);
        return result;
      }

    private:
      int
      integer(const int low, const int high)
      {
        return std::uniform_int_distribution<int>(low, high)(random);
      }

      double
      number(const double low, const double high)
      {
        return std::uniform_real_distribution<double>(low, high)(random);
      }

      Profile
      profile(const int n, std::string &name)
      {
        // Largest over smallest gap, up to 1e4.
        const double contrast = std::pow(10., number(.05, 4.));
        const double width    = .25 * std::log(contrast);
        const int    n_waves  = integer(std::max(1, n / 16), n / 2);
        const double phase    = number(0., 2 * pi);
        const int    kind     = integer(0, 3);
        Profile      result;
        for (int k = 0; k < n; ++k)
          {
            const double cosine = .5 + .5 * std::cos(2 * pi * k * n_waves / n + phase);
            switch (kind)
              {
                case 0: // white
                  result.push_back(number(1. / contrast, 1.));
                  break;
                case 1: // log-normal
                  result.push_back(
                    std::exp(std::normal_distribution<double>(0., width)(random)));
                  break;
                case 2: // wave
                  result.push_back(1. / contrast + (1. - 1. / contrast) * cosine);
                  break;
                default: // wave of the logarithm
                  result.push_back(std::pow(contrast, -cosine));
              }
          }
        const char *names[] = {"white", "log-normal", "wave", "log-wave"};
        char        buffer[60];
        std::snprintf(buffer,
                      sizeof(buffer),
                      "%s(%.1f,%.0f)",
                      names[kind],
                      1. * n / n_waves,
                      contrast);
        name += buffer;
        return result;
      }

      std::mt19937 random;
      int          n_so_far = 0;
    };

    TEST(FlowQuadrature, NoGoodBracketMissesTheLeakRateOfALaminate)
    {
      const char *wanted = std::getenv("STRAIT_TRUST_GAPS");
      const int   n_gaps = wanted != nullptr ? std::atoi(wanted) : 30;
      Laminates   laminates(18);
      int         n_good = 0;
      for (int k = 0; k < n_gaps; ++k)
        n_good += expect_not_fooled(laminates.next()) ? 1 : 0;
      // A program that marked every bracket as inaccurate would pass the test above.
      EXPECT_GE(2 * n_good, n_gaps);
      if (wanted != nullptr)
        std::printf("%d of %d are good\n", n_good, n_gaps);
    }

    TEST(FlowQuadrature, ColumnsThatAlternateFromPointToPoint)
    {
      for (const double narrow : {.1, 1e-4})
        for (const FlowDirection direction : {FlowDirection::x, FlowDirection::y})
          {
            Laminate columns;
            columns.name            = "columns of " + std::to_string(narrow);
            columns.fluid           = plain_fluid(.02);
            columns.fluid.direction = direction;
            columns.across.assign(8, 1.);
            for (int k = 0; k < 8; ++k)
              columns.along.push_back(k % 2 == 0 ? 1. : narrow);
            columns.fluid.maximum_unknowns = 60000;
            // The narrower ones take cells of a thousandth of a spacing, hence too many
            // unknowns.
            EXPECT_EQ(expect_not_fooled(columns), narrow > .01);
          }
    }
  } // namespace
} // namespace strait
