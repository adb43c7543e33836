// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_exponent_fit_h
#define strait_driver_exponent_fit_h

#include <strait/base/log.h>

#include <string>
#include <vector>

namespace strait
{
  class StateArchive;
  struct Step;

  /** A quantity at one distance from the threshold. */
  struct ScalingPoint
  {
    double reduced_load = 0.; // ε = 1 − L/L_c > 0
    double value        = 0.; // > 0
  };

  /** The exponent β of value ∝ ε^β over a window of ε. */
  struct ExponentFit
  {
    double from     = 0.; // smallest ε of the window
    double to       = 0.; // largest
    double exponent = 0.;
    double error    = 0.; // standard error of the fit; 0 for two points
    int    n_points = 0;
  };

  /** A row of fit.csv. */
  struct FitRow
  {
    std::string quantity;
    double      slip_length = 0.;
    std::string kind; // local or fit
    ExponentFit fit;
  };

  /** log–log slopes between neighbouring points, in the order of falling ε. */
  std::vector<ExponentFit> local_slopes(std::vector<ScalingPoint> points);

  /**
   * Least squares on log value against log ε over the points with ε <= @p largest.
   * Fewer than two points give a result with n_points < 2.
   */
  ExponentFit fit_exponent(const std::vector<ScalingPoint> &points, double largest);

  /**
   * The reduced load ε_x at which the exponential decay far from the threshold turns
   * into the power law ε^β near it. Far away value ∝ exp(s ε) with s from least
   * squares over 0.3 <= ε <= 0.7; the local exponent s ε reaches β = 69/20 at
   * ε_x = β/s. Not a number with fewer than two points in that range.
   */
  double crossover_reduced_load(const std::vector<ScalingPoint> &points);

  /** What a step near the threshold contributes; what is not positive is not known. */
  struct ScalingStep
  {
    double slip_length      = 0.;
    double reduced_load     = 0.;
    bool   is_trusted       = false; // nothing is in doubt (Step::doubts)
    double leak_rate        = 0.;    // magnitude
    double throat_gap       = 0.;
    double throat_length    = 0.;
    double throat_width     = 0.;
    double theory_leak_rate = 0.; // magnitude
  };

  /**
   * Exponents of leak rate and throat against 1 − L/L_c. Collects the steps that
   * converged; those in doubt are left out of the fits.
   */
  class Scaling
  {
  public:
    /** Fits use reduced loads up to @p largest_reduced_load. */
    explicit Scaling(const double largest_reduced_load)
      : largest(largest_reduced_load)
    {
    }

    /** Add a step, if it has a reduced load. */
    void collect(const Step &step);

    /** All that was collected. Collective. */
    void transfer(StateArchive &archive);

    /** The fit of the leak rate at the smallest slip, and its crossover. */
    ExponentFit leak_rate_fit() const;
    double      crossover() const;

    /** The crossover of what the theory says at the same steps; not a number without. */
    double theory_crossover() const;

    /** The local slopes of each quantity, and its fit over all steps that are trusted,
     *  which goes to @p log as well. Collective. */
    std::vector<FitRow> fits(Log &log) const;

  private:
    /** The known values of a quantity at one slip length, in the order of the steps. */
    std::vector<ScalingPoint> series(double ScalingStep::*quantity,
                                     double               slip_length,
                                     bool                 only_trusted = false) const;

    /** The smallest slip at which a quantity is known; not a number if it never is. */
    double smallest_slip(double ScalingStep::*quantity) const;

    double                   largest;
    std::vector<ScalingStep> steps;
  };
} // namespace strait

#endif
