// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/map_processing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;
  using test::whole_surface;

  SurfaceParameters
  surface_of(const SurfaceKind kind, const double lx, const double ly)
  {
    SurfaceParameters parameters;
    parameters.kind      = kind;
    parameters.size      = {{lx, ly}};
    parameters.amplitude = 0.4;
    return parameters;
  }

  SurfaceParameters
  expression(const std::string &text, const double lx = 1., const double ly = 1.)
  {
    SurfaceParameters parameters = surface_of(SurfaceKind::expression, lx, ly);
    parameters.expression        = text;
    return parameters;
  }

  void
  expect_same(const std::vector<double> &one, const std::vector<double> &other)
  {
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i)
      ASSERT_NEAR(one[i], other[i], 1e-13) << "at point " << i;
  }

  TEST(AnalyticSurface, KindsAreTheirFormulas)
  {
    const double lx = 2., ly = 3.;
    const auto expect_formula = [&](const SurfaceKind kind, const std::string &formula) {
      expect_same(whole_surface(surface_of(kind, lx, ly), 12, 9),
                  whole_surface(expression(formula, lx, ly), 12, 9));
    };
    expect_formula(SurfaceKind::flat, "0");
    expect_formula(SurfaceKind::sine, "0.4 * cos(2*pi*x/lx)");
    expect_formula(SurfaceKind::square_saddle,
                   "0.4 * (2 + cos(2*pi*x/lx) + cos(2*pi*y/ly))");
    expect_formula(SurfaceKind::sphere, "-((x-lx/2)^2 + (y-ly/2)^2) / 0.8");
  }

  TEST(AnalyticSurface, ExpressionSeesItsVariables)
  {
    const auto heights =
      whole_surface(expression("x + 10*y + 100*lx + 1000*ly", 2., 4.), 4, 2);
    EXPECT_EQ(
      heights,
      (std::vector<double>{4200, 4200.5, 4201, 4201.5, 4220, 4220.5, 4221, 4221.5}));
  }

  TEST(AnalyticSurface, PeaksStandOnATriangularLattice)
  {
    // The cell of 1 × √3 spacings has a peak at its corner and one at its centre.
    const double side = 0.7;
    for (const bool turned : {false, true})
      {
        const int  nx = turned ? 36 : 24, ny = turned ? 24 : 36;
        auto       parameters = surface_of(SurfaceKind::triangular_peaks,
                                     turned ? std::sqrt(3.) * side : side,
                                     turned ? side : std::sqrt(3.) * side);
        const auto peaks      = whole_surface(parameters, nx, ny);
        EXPECT_NEAR(*std::max_element(peaks.begin(), peaks.end()), 4.5 * 0.4, 1e-13);
        EXPECT_NEAR(*std::min_element(peaks.begin(), peaks.end()), 0., 1e-13);
        EXPECT_NEAR(peaks[0], 4.5 * 0.4, 1e-13);
        EXPECT_NEAR(peaks[ny / 2 * nx + nx / 2], 4.5 * 0.4, 1e-13);
        EXPECT_EQ(std::count_if(peaks.begin(),
                                peaks.end(),
                                [](const double h) { return h > 4.49 * 0.4; }),
                  2);

        parameters.kind      = SurfaceKind::honeycomb_peaks;
        const auto honeycomb = whole_surface(parameters, nx, ny);
        for (std::size_t i = 0; i < peaks.size(); ++i)
          ASSERT_NEAR(honeycomb[i], 4.5 * 0.4 - peaks[i], 1e-13);
        // The honeycomb has two peaks for each one of the triangular lattice.
        EXPECT_EQ(std::count_if(honeycomb.begin(),
                                honeycomb.end(),
                                [](const double h) { return h > 4.49 * 0.4; }),
                  4);
      }
  }

  TEST(AnalyticSurface, PeaksHaveTheSameCurvatureInEveryDirection)
  {
    const double side = 1.;
    const int    n    = 600;
    const auto   peaks =
      whole_surface(surface_of(SurfaceKind::triangular_peaks, side, std::sqrt(3.) * side),
                    n,
                    n);
    const double dx = side / n, dy = std::sqrt(3.) * side / n;
    const double along_x = (peaks[1] - peaks[0]) / (dx * dx);
    const double along_y = (peaks[n] - peaks[0]) / (dy * dy);
    EXPECT_NEAR(along_x / along_y, 1., 1e-3);
  }

  TEST(AnalyticSurface, PeaksNeedTheirBox)
  {
    const auto message = [](const double lx, const double ly, const bool rotate) {
      auto parameters   = surface_of(SurfaceKind::honeycomb_peaks, lx, ly);
      parameters.rotate = rotate;
      return input_error([&]() { whole_surface(parameters, 4, 4); });
    };
    EXPECT_TRUE(mentions(message(1., 1., false), "Surface/Size = 1, 1.73205081."));
    EXPECT_TRUE(mentions(message(1., 1.7320, false), "Surface/Size = 1, 1.73205081."));
    EXPECT_TRUE(mentions(message(2., 1., false), "Surface/Size = 1.73205081, 1."));
    EXPECT_TRUE(mentions(message(2., 1., true), "Surface/Size = 1.73205081, 1."));
  }

  TEST(AnalyticSurface, BadExpressionsAreRefused)
  {
    const auto message = [](const std::string &text) {
      return input_error([&]() { whole_surface(expression(text), 4, 4); });
    };
    EXPECT_TRUE(mentions(message(""), "Surface/Expression is empty"));
    EXPECT_TRUE(mentions(message("sin(x"), "\"sin(x\""));
    EXPECT_TRUE(mentions(message("x + z"), "z"));
    EXPECT_TRUE(mentions(message("x, y"), "several values"));
    for (const char *text : {"x = 1", "x = 0 ? 0.1 : 0", "0.1*(x = y)", "x=y==0"})
      EXPECT_TRUE(mentions(message(text), "gives x or y another value")) << text;
  }

  TEST(AnalyticSurface, ExpressionThatTheBoxOrTheGridCutsIsPointedOut)
  {
    const auto warnings = [](const std::string &text, const bool rotate = false) {
      SurfaceParameters parameters = expression(text, 2., 1.);
      parameters.rotate            = rotate;
      Remarks remarks;
      make_surface(parameters, make_layout({8, 4, 2., 1.}, MPI_COMM_WORLD), &remarks);
      return remarks.warnings;
    };
    for (const char *text :
         {"3", "abs(x - 1)", "1e3 + sin(pi*x) * cos(2*pi*y)", "y*(1-y)"})
      EXPECT_TRUE(warnings(text).empty()) << text;
    ASSERT_EQ(warnings("1 + x").size(), 1U);
    EXPECT_TRUE(mentions(warnings("1 + x").front(), "does not repeat along x"));
    EXPECT_TRUE(mentions(warnings("1 + x").front(), "by up to 2 from"));
    EXPECT_EQ(warnings("x + y").size(), 2U);
    // Before the rotation, the box is as long as half a period of this wave.
    EXPECT_TRUE(warnings("cos(pi*x)").empty());
    EXPECT_EQ(warnings("cos(pi*x)", true).size(), 1U);
    EXPECT_TRUE(warnings("sin(2*pi*x/lx)", true).empty());
    // On eight points, seven waves look like one.
    for (const char *text : {"cos(7*pi*x)", "sin(8*pi*x)", "abs(x - 1.1) < 0.1 ? 1 : 0"})
      {
        ASSERT_EQ(warnings(text).size(), 1U) << text;
        EXPECT_TRUE(mentions(warnings(text).front(), "raise Contact/Grid points"));
      }
  }

  TEST(AnalyticSurface, ExpressionMustBeFinite)
  {
    const auto message = [](const std::string &text) {
      return input_error([&]() { whole_surface(expression(text), 4, 8); });
    };
    EXPECT_TRUE(mentions(message("1/x"), "not finite at x = 0, y = 0"));
    EXPECT_TRUE(mentions(message("sqrt(0.8 - y)"), "not finite at x = 0, y = 0.875"));
  }

  TEST(TransformedSurface, InversionChangesTheSign)
  {
    auto parameters   = expression("x - y^2");
    parameters.invert = true;
    expect_same(whole_surface(parameters, 6, 5),
                whole_surface(expression("y^2 - x"), 6, 5));
  }

  TEST(TransformedSurface, RotationTurnsBy90Degrees)
  {
    // h(x, y) = h0(y, −x), and −x is lx − x in the periodic box.
    const double lx = 2., ly = 3.;
    auto         parameters = expression("10*x + y + 100*(lx - 3)", lx, ly);
    parameters.rotate       = true;
    const auto turned       = whole_surface(parameters, 8, 5);
    const auto expected =
      whole_surface(expression("10*y + (x == 0 ? 0 : lx - x)", lx, ly), 8, 5);
    expect_same(turned, expected);
  }

  TEST(TransformedSurface, RotatedAndInvertedRandomSurface)
  {
    SurfaceParameters parameters;
    parameters.short_cut_off_wavelength = 0.2;
    parameters.size                     = {{2., 1.}};
    const int  nx = 22, ny = 11;
    const auto original = whole_surface(parameters, nx, ny);

    SurfaceParameters changed = parameters;
    changed.size              = {{1., 2.}};
    changed.rotate            = true;
    changed.invert            = true;
    const auto turned         = whole_surface(changed, ny, nx);
    for (int iy = 0; iy < nx; ++iy)
      for (int ix = 0; ix < ny; ++ix)
        ASSERT_NEAR(turned[iy * ny + ix], -original[(ny - ix) % ny * nx + iy], 1e-13);
  }
} // namespace
