// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/surface/height_function.h>

#include <muParser.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace strait
{
  namespace
  {
    const double two_pi = 2 * std::acos(-1.);
    const double sqrt_3 = std::sqrt(3.);

    HeightFunction
    lattice_peaks(const SurfaceParameters &parameters)
    {
      const double amplitude = parameters.amplitude;
      const double lx = parameters.size[0], ly = parameters.size[1];
      const bool   honeycomb  = parameters.kind == SurfaceKind::honeycomb_peaks;
      const bool   long_in_x  = lx > ly; // the side of √3 lattice spacings
      const double short_side = long_in_x ? ly : lx;
      const double long_side  = long_in_x ? lx : ly;
      if (std::abs(long_side / (sqrt_3 * short_side) - 1) > 1e-6)
        throw InputError(
          "Triangular and honeycomb peaks repeat in a box whose sides are as 1 to "
          "sqrt(3): set Surface/Size = " +
          (long_in_x ? scene_pair(parameters, sqrt_3 * ly, ly)
                     : scene_pair(parameters, lx, sqrt_3 * lx)) +
          ".");
      return [=](const double x, const double y) {
        const double along_short = two_pi * (long_in_x ? y / ly : x / lx);
        const double along_long  = two_pi * (long_in_x ? x / lx : y / ly);
        const double waves       = std::cos(2 * along_long) +
                             std::cos(along_short + along_long) +
                             std::cos(along_short - along_long);
        return amplitude * (honeycomb ? 3 - waves : 1.5 + waves);
      };
    }

    /** An expression and the variables that it is bound to. */
    struct Expression
    {
      double     x = 0.;
      double     y = 0.;
      mu::Parser parser;
    };

    HeightFunction
    parsed(const std::string &text, const std::array<double, 2> &size)
    {
      if (text.find_first_not_of(" \t") == std::string::npos)
        throw InputError(
          "Surface/Expression is empty: give the height as a function of x "
          "and y, or choose another Surface/Kind.");
      try
        {
          const auto  expression = std::make_shared<Expression>();
          mu::Parser &parser     = expression->parser;
          parser.DefineVar("x", &expression->x);
          parser.DefineVar("y", &expression->y);
          parser.DefineConst("lx", size[0]);
          parser.DefineConst("ly", size[1]);
          parser.DefineConst("pi", std::acos(-1.));
          parser.SetExpr(text);
          parser.Eval(); // muParser compiles at the first evaluation
          if (parser.GetNumResults() != 1)
            throw InputError(
              "Surface/Expression \"" + text +
              "\" has several values, separated by commas: give one height.");
          return [expression](const double x, const double y) {
            expression->x = x;
            expression->y = y;
            return expression->parser.Eval();
          };
        }
      catch (const mu::Parser::exception_type &error)
        {
          throw InputError("Surface/Expression \"" + text +
                           "\" cannot be read: " + error.GetMsg());
        }
    }
  } // namespace

  HeightFunction
  height_function(const SurfaceParameters &parameters)
  {
    const double amplitude = parameters.amplitude;
    const double lx = parameters.size[0], ly = parameters.size[1];
    switch (parameters.kind)
      {
        case SurfaceKind::flat:
          return [](double, double) { return 0.; };
        case SurfaceKind::sine:
          return
            [=](const double x, double) { return amplitude * std::cos(two_pi * x / lx); };
        case SurfaceKind::square_saddle:
          return [=](const double x, const double y) {
            return amplitude *
                   (2 + std::cos(two_pi * x / lx) + std::cos(two_pi * y / ly));
          };
        case SurfaceKind::triangular_peaks:
        case SurfaceKind::honeycomb_peaks:
          return lattice_peaks(parameters);
        case SurfaceKind::sphere:
          return [=](double x, double y) {
            x -= lx / 2;
            y -= ly / 2;
            return -(x * x + y * y) / (2 * amplitude);
          };
        case SurfaceKind::expression:
          return parsed(parameters.expression, parameters.size);
        case SurfaceKind::self_affine:
        case SurfaceKind::file:
          break;
      }
    throw std::logic_error("This kind of surface has no formula.");
  }
} // namespace strait
