// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/surface/expression_surface.h>
#include <strait/surface/sample.h>
#include <strait/surface/scene_text.h>

#include <muParser.h>

#include <cmath>

namespace strait
{
  namespace
  {
    /** The expression bound to its variables; neither copied nor shared. */
    class Height
    {
    public:
      /** Throws mu::Parser::exception_type if the expression has no meaning. */
      Height(const std::string &expression, const std::array<double, 2> &size)
      {
        parser.DefineVar("x", &x);
        parser.DefineVar("y", &y);
        parser.DefineConst("lx", size[0]);
        parser.DefineConst("ly", size[1]);
        parser.DefineConst("pi", std::acos(-1.));
        parser.SetExpr(expression);
        parser.Eval(); // muParser compiles at the first evaluation
      }

      double
      operator()(const double at_x, const double at_y)
      {
        x = at_x;
        y = at_y;
        return parser.Eval();
      }

      int
      n_values() const
      {
        return parser.GetNumResults();
      }

    private:
      double     x = 0.;
      double     y = 0.;
      mu::Parser parser;
    };
  } // namespace

  ExpressionSurface::ExpressionSurface(const SurfaceParameters &parameters)
    : expression(parameters.expression)
    , size(parameters.size)
  {
    if (expression.find_first_not_of(" \t") == std::string::npos)
      throw InputError(
        "Surface/Expression is empty: give the height as a function of x "
        "and y, or choose another Surface/Kind.");
    try
      {
        if (Height(expression, size).n_values() != 1)
          throw InputError(
            "Surface/Expression \"" + expression +
            "\" has several values, separated by commas: give one height.");
      }
    catch (const mu::Parser::exception_type &error)
      {
        throw InputError("Surface/Expression \"" + expression +
                         "\" cannot be read: " + error.GetMsg());
      }
  }

  SlabField
  ExpressionSurface::heights(const SlabLayoutPtr &layout) const
  {
    Height      height(expression, size);
    std::string error;
    SlabField   field = sample(layout, [&](const double x, const double y) {
      const double value = height(x, y);
      if (!std::isfinite(value) && error.empty())
        error = "Surface/Expression \"" + expression +
                "\" is not finite at x = " + scene_number(x) +
                ", y = " + scene_number(y) +
                ": give one that is finite in the whole box.";
      return value;
    });
    throw_if_any(layout->communicator(), error);
    return field;
  }
} // namespace strait
