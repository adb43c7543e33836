// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_run_summary_h
#define strait_run_run_summary_h

#include <cmath>
#include <string>
#include <tuple>

namespace strait
{
  /** What a run leaves besides its files. What is not known is not a number. */
  struct RunSummary
  {
    bool converged = true;  // all steps
    bool stopped   = false; // by a signal, before the last step

    // Of the threshold at the first slip length, if the scene looks for it.
    double critical_load_lower = std::nan("");
    double critical_load_upper = std::nan("");
    double contact_area        = std::nan("");

    // Of the leak rate at the smallest slip length.
    double crossover             = std::nan(""); // see crossover_reduced_load()
    double crossover_load        = std::nan(""); // the load of that
    double theory_crossover_load = std::nan(""); // that of the theory's leak rate
    double exponent              = std::nan("");
    double exponent_error        = std::nan("");

    std::string status   = "ok"; // words of all steps, and of what is not known for them
    std::string validity = "ok"; // words of all steps

    double
    critical_load() const
    {
      return .5 * (critical_load_lower + critical_load_upper);
    }

    /** All members, for what is done with each of them. */
    auto
    members()
    {
      return std::tie(converged,
                      stopped,
                      critical_load_lower,
                      critical_load_upper,
                      contact_area,
                      crossover,
                      crossover_load,
                      theory_crossover_load,
                      exponent,
                      exponent_error,
                      status,
                      validity);
    }
  };
} // namespace strait

#endif
