// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/self_affine_surface.h>

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <string>
#include <utility>

namespace strait
{
  namespace
  {
    /** The height as a formula in x and y, where A is the amplitude. */
    std::string
    formula_of(const SurfaceParameters &parameters)
    {
      const double      sqrt_3 = std::sqrt(3.);
      const double      lx = parameters.size[0], ly = parameters.size[1];
      const bool        long_in_x = lx > ly; // the side of √3 lattice spacings
      const std::string s         = long_in_x ? "2*pi*y/ly" : "2*pi*x/lx";
      const std::string t         = long_in_x ? "2*pi*x/lx" : "2*pi*y/ly";
      const std::string waves =
        "(cos(2*" + t + ") + cos(" + s + " + " + t + ") + cos(" + s + " - " + t + "))";
      switch (parameters.kind)
        {
          case SurfaceKind::flat:
            return "0";
          case SurfaceKind::sine:
            return "A*cos(2*pi*x/lx)";
          case SurfaceKind::square_saddle:
            return "A*(2 + cos(2*pi*x/lx) + cos(2*pi*y/ly))";
          case SurfaceKind::sphere:
            return "-((x - lx/2)^2 + (y - ly/2)^2)/(2*A)";
          case SurfaceKind::triangular_peaks:
          case SurfaceKind::honeycomb_peaks:
            require(!(std::abs(std::max(lx, ly) / (sqrt_3 * std::min(lx, ly)) - 1) >
                      1e-6),
                    "Triangular and honeycomb peaks repeat in a box whose sides are as 1 "
                    "to sqrt(3): set Surface/Size = " +
                      (long_in_x ? scene_pair(parameters, sqrt_3 * ly, ly)
                                 : scene_pair(parameters, lx, sqrt_3 * lx)) +
                      ".");
            return parameters.kind == SurfaceKind::honeycomb_peaks
                     ? "A*(3 - " + waves + ")"
                     : "A*(1.5 + " + waves + ")";
          default:
            break;
        }
      const std::string      &text = parameters.expression;
      static const std::regex assignment("(^|[^=<>!])=([^=]|$)");
      require(text.find_first_not_of(" \t") != std::string::npos,
              "Surface/Expression is empty: give the height as a function of x "
              "and y, or choose another Surface/Kind.");
      require(!std::regex_search(text, assignment),
              "Surface/Expression \"" + text +
                "\" gives x or y another value with =: compare with ==.");
      return text;
    }

    /** The height at (x, y), in the scene's unit of length. */
    class Formula
    {
    public:
      explicit Formula(const SurfaceParameters &parameters)
      {
        const std::string text = formula_of(parameters);
        try
          {
            parser.DefineVar("x", &x);
            parser.DefineVar("y", &y);
            parser.DefineConst("lx", parameters.size[0]);
            parser.DefineConst("ly", parameters.size[1]);
            parser.DefineConst("pi", std::acos(-1.));
            if (parameters.kind != SurfaceKind::expression)
              parser.DefineConst("A", parameters.amplitude);
            parser.SetExpr(text);
            parser.Eval(); // muParser compiles at the first evaluation
            require(parser.GetNumResults() == 1,
                    "Surface/Expression \"" + text +
                      "\" has several values, separated by commas: give one height.");
          }
        catch (const mu::Parser::exception_type &error)
          {
            throw InputError("Surface/Expression \"" + text +
                             "\" cannot be read: " + error.GetMsg());
          }
      }

      double
      operator()(const double at_x, const double at_y) const
      {
        x = at_x;
        y = at_y;
        return parser.Eval();
      }

    private:
      mutable double x = 0., y = 0.; // to which the parser is bound
      mu::Parser     parser;
    };

    /** Warn in @p remarks if the expression @p height does not repeat with the box, or is
     *  not resolved: if it has steps at the seam, or within the cells of @p field, that
     *  are larger than any from one grid point to the next. Collective. */
    void
    check_steps(const Formula &height, const SlabField &field, Remarks &remarks)
    {
      const PeriodicGrid &grid   = field.grid();
      const int           n_rows = field.layout().n_rows();
      double largest = 0., beside = 0.; // steps to the next point, and a third of the way
      for (int row = 0; row < n_rows; ++row)
        for (int ix = 0; ix < grid.nx; ++ix)
          {
            const double x     = ix * grid.dx();
            const double y     = (field.layout().first_row() + row) * grid.dy();
            const double value = field(ix, row);
            const double below = row > 0 ? field(ix, row - 1) : height(x, y - grid.dy());
            largest            = std::max(largest, std::abs(value - below));
            if (ix > 0)
              largest = std::max(largest, std::abs(value - field(ix - 1, row)));
            beside =
              std::max(beside,
                       std::abs(height(x + grid.dx() / 3, y + grid.dy() / 3) - value));
          }
      largest = maximum(field.layout().communicator(), largest);
      if (maximum(field.layout().communicator(), beside) > largest)
        {
          remarks.warnings.emplace_back(
            "Surface/Expression varies more between the points of the grid than from one "
            "to the next, so that they miss waves or peaks of it; raise Contact/Grid "
            "points");
          return; // Steps at the seam cannot be compared with those of the grid.
        }
      double across_x = 0., across_y = 0.;
      for (int iy = 0; iy < grid.ny; ++iy)
        across_x = std::max(across_x,
                            std::abs(height(grid.lx, iy * grid.dy()) -
                                     height(0., iy * grid.dy())));
      for (int ix = 0; ix < grid.nx; ++ix)
        across_y = std::max(across_y,
                            std::abs(height(ix * grid.dx(), grid.ly) -
                                     height(ix * grid.dx(), 0.)));
      for (const auto &[axis, across] : {std::pair("x", across_x), {"y", across_y}})
        if (across > largest)
          remarks.warnings.push_back(format(
            "Surface/Expression does not repeat along %s: at the end of the box it "
            "differs by up to %.3g from its beginning, where the last points of "
            "the grid are joined with the first; give whole periods, and lx and ly "
            "for the sides of the box",
            axis,
            across));
    }

    /** The heights of a surface that is given by a formula. Collective. */
    SlabField
    heights_of_formula(const SurfaceParameters &parameters,
                       const SlabLayoutPtr     &layout,
                       Remarks                 &remarks)
    {
      const Formula height(parameters);
      std::string   error;
      SlabField     field = sample(layout, [&](const double x, const double y) {
        const double value = height(x, y);
        if (!std::isfinite(value) && error.empty())
          error = "Surface/Expression \"" + parameters.expression +
                  "\" is not finite at x = " + scene_number(x) +
                  ", y = " + scene_number(y) +
                  ": give one that is finite in the whole box.";
        return value;
      });
      throw_if_any(layout->communicator(), error);
      if (parameters.kind == SurfaceKind::expression)
        check_steps(height, field, remarks);
      return field;
    }

    /**
     * The heights of one map, or of two rough bodies face to face: the second one, seen
     * from its side, is turned over: h(x, y) = h_first(x, y) + h_second(−x, y).
     * Collective.
     */
    SlabField
    measured_heights(const SurfaceParameters &parameters,
                     const SlabLayoutPtr     &layout,
                     Remarks                 &remarks)
    {
      if (parameters.seed != 1 && parameters.map.windows == std::array<int, 2>{{1, 1}})
        remarks.warnings.emplace_back(
          "Surface/Seed changes nothing of a map without Surface/Windows, which it counts");
      std::optional<bool> have_unit;
      SlabField           heights =
        heights_of_map(parameters, parameters.map.file, layout, have_unit, remarks);
      if (parameters.map.second_file.empty())
        return heights;
      const SlabField other = heights_of_map(
        parameters, parameters.map.second_file, layout, have_unit, remarks);
      const int nx = layout->grid().nx;
      for (int row = 0; row < layout->n_rows(); ++row)
        for (int ix = 0; ix < nx; ++ix)
          heights(ix, row) += other((nx - ix) % nx, row); // −x in the periodic box
      return heights;
    }

    /** The heights before they are inverted and rotated. Collective. */
    SlabField
    original_heights(const SurfaceParameters &parameters,
                     const SlabLayoutPtr     &layout,
                     Remarks                 &remarks)
    {
      switch (parameters.kind)
        {
          case SurfaceKind::self_affine:
            return SelfAffineSurface(parameters, layout->communicator()).heights(layout);
          case SurfaceKind::file:
            return measured_heights(parameters, layout, remarks);
          default:
            return heights_of_formula(parameters, layout, remarks);
        }
    }

    /**
     * Rotate counter-clockwise by 90° about the origin: h(x, y) = h_before(y, −x), where
     * the box of @p before is ly × lx. Collective.
     */
    SlabField
    rotated(const SlabField &before, const SlabLayoutPtr &layout)
    {
      const std::vector<double> whole = gather_on_root(before);
      const std::size_t         nx = layout->grid().nx, ny = layout->grid().ny;
      std::vector<double>       turned(whole.size());
      for (std::size_t k = 0; k < turned.size(); ++k)
        turned[k] = whole[(nx - k % nx) % nx * ny + k / nx]; // −x in the periodic box
      return scatter_from_root(layout, turned);
    }
  } // namespace

  SlabField
  make_surface(const SurfaceParameters &parameters,
               const SlabLayoutPtr     &layout,
               Remarks                 *remarks)
  {
    // The scene's Size is the box of the result; the original has its sides exchanged.
    SurfaceParameters original        = parameters;
    SlabLayoutPtr     before_rotation = layout;
    if (parameters.rotate)
      {
        const PeriodicGrid &grid = layout->grid();
        std::swap(original.size[0], original.size[1]);
        before_rotation =
          make_layout({grid.ny, grid.nx, grid.ly, grid.lx}, layout->communicator());
      }
    Remarks   unwanted;
    SlabField field = original_heights(original,
                                       before_rotation,
                                       remarks != nullptr ? *remarks : unwanted);
    if (parameters.invert)
      for (double &height : field)
        height = -height;
    return parameters.rotate ? rotated(field, layout) : field;
  }
} // namespace strait
