// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_scaling_h
#define strait_run_scaling_h

#include <strait/base/log.h>
#include <strait/run/exponent_fit.h>

#include <array>
#include <string>
#include <vector>

namespace strait
{
  class StateArchive;
  struct RunSummary;
  struct Step;
  struct Transition;

  /**
   * Exponents of leak rate and throat against 1 − L/L_c. Collects the steps that
   * converged; those in doubt (Step::doubts) are left out of the fits, and those whose
   * throat has too few points for a leak rate (validity.h) out of the crossover.
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

    /** Tell @p summary the exponent and the crossover of the leak rate at the smallest
     *  slip, whose critical load is among @p thresholds, and the crossover of what the
     *  theory says at the same steps. Its status gets words for what could not be told of
     *  the leak rate because too few of the steps it takes are resolved: no-exponent,
     *  no-crossover; and the latter as well if the leak rate decays too slowly for one.
     */
    void summarise(const std::vector<Transition> &thresholds, RunSummary &summary) const;

    /** The local slopes of each quantity, and its fit over all steps that are trusted,
     *  which goes to @p log as well, with a warning of what is missing. Collective. */
    std::vector<FitRow> fits(Log &log) const;

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

    /** The slip length nearest to 0 of all steps, for which summarise() speaks; NaN
     *  without steps. */
    double smallest_slip() const;

    /** What the steps at the smallest slip give a result: how many there are in its
     *  window, how many have a leak rate that serves, and the status of the others. */
    struct Supply
    {
      const char *result;
      const char *word; // of the column status if there is no result
      LoadWindow  window;
      Trust       trust;
      int         n_steps          = 0;
      int         n_used           = 0;
      std::string status_of_others = "ok";

      /** Whether there is no result because too few steps serve. */
      bool
      is_short() const
      {
        return n_steps > n_used && n_used < 2;
      }
    };

    /** Those of the exponent and of the crossover of the leak rate. */
    std::array<Supply, 2> supplies() const;

    /** Whether @p quantity decays so slowly that it has no crossover. */
    bool is_slow(Quantity quantity) const;
    void report_missing(Log &log) const;

    double              largest;
    std::vector<Sample> samples;
  };
} // namespace strait

#endif
