// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_exponent_fit_h
#define strait_run_exponent_fit_h

#include <cmath>
#include <string>
#include <vector>

namespace strait
{
  /** A quantity at one distance from the threshold. */
  struct ScalingPoint
  {
    double reduced_load = 0.; // ε = 1 − L/L_c > 0
    double value        = 0.; // > 0

    std::string status = "ok"; // of the step that it is from
  };

  /** Of the leak rate near the threshold, as the paper has it. */
  inline constexpr double leak_rate_exponent = 69. / 20;

  /** A range of reduced loads. */
  struct LoadWindow
  {
    double from = 0.;
    double to   = 0.;

    /** Whether it holds @p reduced_load: that of a step is the one asked for but for
     *  rounding. */
    bool
    contains(const double reduced_load) const
    {
      return reduced_load >= from - 1e-9 && reduced_load <= to + 1e-9;
    }
  };

  /** Where the leak rate falls exponentially with the load. Half of its nearest end takes
   *  loads in at which the power law has begun, a larger farthest one those at which
   *  there is hardly any contact. */
  inline constexpr LoadWindow exponential_decay{.3, .7};

  /** The exponent β of value ∝ ε^β over a window of ε. */
  struct ExponentFit
  {
    double from     = 0.; // smallest ε of the window
    double to       = 0.; // largest
    double exponent = 0.;
    double error    = 0.; // standard error of the fit; 0 for two points
    int    n_points = 0;

    std::string status = "ok"; // all words of its points
  };

  /** A row of fit.csv. */
  struct FitRow : ExponentFit
  {
    std::string quantity;
    double      slip_length = 0.;
    std::string kind;               // local or fit
    double      law = std::nan(""); // what the law of closing says of a local one
  };

  /** log–log slopes between neighbouring points, in the order of falling ε. */
  std::vector<ExponentFit> local_slopes(std::vector<ScalingPoint> points);

  /**
   * Least squares on log value against log ε over the points with ε <= @p largest.
   * Fewer than two points give a result with n_points < 2.
   */
  ExponentFit fit_exponent(const std::vector<ScalingPoint> &points, double largest);

  /** s of value ∝ exp(s ε) by least squares over exponential_decay. Not a number with
   *  fewer than two points in that range. */
  double decay_rate(const std::vector<ScalingPoint> &points);

  /**
   * The reduced load ε_x at which the exponential decay far from the threshold turns
   * into the power law ε^β near it: the local exponent s ε, with s of decay_rate(),
   * reaches leak_rate_exponent, β, at ε_x = β/s. Not a number if s is not known, or below
   * β, as no load has an ε above 1.
   */
  double crossover_reduced_load(const std::vector<ScalingPoint> &points);
} // namespace strait

#endif
