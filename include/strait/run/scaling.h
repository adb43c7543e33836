// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_scaling_h
#define strait_run_scaling_h

#include <strait/base/log.h>
#include <strait/seal/transition_search.h>

#include <array>
#include <cmath>
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

  /** Least squares on log value against log ε over the points with ε <= @p largest. Fewer
   *  than two points give a result with n_points < 2. */
  ExponentFit fit_exponent(const std::vector<ScalingPoint> &points, double largest);

  /** Numbers that a run leaves besides its files. What is not known is not a number. */
  struct RunNumbers
  {
    bool converged = true; // all steps

    /** At the first slip length, if the scene looks for it. */
    Transition threshold = {0., std::nan(""), std::nan(""), std::nan("")};

    // Of the leak rate at the smallest slip length.
    double crossover             = std::nan(""); // ε_x, see Scaling
    double crossover_load        = std::nan(""); // the load of that
    double theory_crossover_load = std::nan(""); // that of the theory's leak rate
    double exponent              = std::nan("");
    double exponent_error        = std::nan("");
  };

  /** What a run leaves besides its files. */
  struct RunSummary : RunNumbers
  {
    std::string status   = "ok"; // words of all steps, and of what is not known for them
    std::string validity = "ok"; // words of all steps
  };

  /**
   * Exponents of leak rate and throat against 1 − L/L_c, and the reduced load ε_x at
   * which the exponential decay of the leak rate far from the threshold, exp(s ε), turns
   * into the power law ε^β near it: where the local exponent s ε reaches β,
   * leak_rate_exponent.
   *
   * Collects the steps that converged; those in doubt (Step::doubts) are left out of the
   * fits, and those whose throat has too few points for a leak rate (judge_validity) out
   * of the crossover.
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

    /** The local slopes of each quantity, and its fit over all steps that are trusted,
     *  which goes to @p log as well. Collective. */
    std::vector<FitRow> fits(Log &log) const;

    /** Tell @p summary the exponent and the crossover of the leak rate at the smallest
     *  slip, whose critical load is among @p thresholds, and the crossover of what the
     *  theory says at the same steps. Warns of steps that do not serve. Where less than
     *  two do, or where the decay is too slow for a crossover below ε = 1, the status of
     *  @p summary gets the word no-exponent or no-crossover. */
    void summarise(const std::vector<Transition> &thresholds,
                   RunSummary                    &summary,
                   Log                           &log) const;

  private:
    enum Quantity
    {
      leak_rate,
      throat_gap,
      throat_length,
      throat_width,
      theory_leak_rate,
      n_quantities
    };

    /** Which steps serve. */
    enum class Trust
    {
      all,      // that converged
      resolved, // whose leak rate the grid resolves
      doubtless // whose status is ok: for exponents
    };

    /** What a step contributes. Values that are not positive are not known. */
    struct Sample
    {
      double                           slip_length  = 0.;
      double                           reduced_load = 0.;
      std::string                      status       = "ok";
      bool                             is_coarse    = false; // its throat
      std::array<double, n_quantities> values       = {};

      /** Whether its value of @p quantity serves. */
      bool
      serves(const Quantity quantity, const Trust trust) const
      {
        return values[quantity] > 0 && !(trust == Trust::doubtless && status != "ok") &&
               !(trust == Trust::resolved && is_coarse);
      }
    };

    /** The known values of a quantity at one slip length, in the order of the steps. */
    std::vector<ScalingPoint>
    series(Quantity quantity, double slip_length, Trust trust) const;

    /** Whether two of the steps in @p window have a leak rate that serves for @p result,
     *  or all that there are. Warns of those that have none. */
    bool suffice(const char       *result,
                 double            slip_length,
                 const LoadWindow &window,
                 Trust             trust,
                 Log              &log) const;

    double              largest;
    std::vector<Sample> samples;
  };
} // namespace strait

#endif
