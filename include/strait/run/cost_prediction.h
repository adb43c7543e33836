// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_cost_prediction_h
#define strait_run_cost_prediction_h

#include <strait/base/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /**
   * What a run is likely to cost and what will limit its accuracy, without computing
   * anything: ranges of what comparable runs took (doc/accuracy.md, doc/adhesion.md,
   * doc/feedback.md, doc/paper.md), in counts rather than seconds.
   */
  class CostPrediction
  {
  public:
    /** @p rms_slope of the heights, which the threshold of a rough surface scales
     *  with. */
    CostPrediction(const Scene &scene, double rms_slope);

    /** A range of counts. */
    struct Range
    {
      double lowest  = 0.;
      double highest = 0.;
    };

    /** Steps that solve a contact problem, without searches. */
    std::size_t n_steps() const;

    /** FFT pairs of one contact solution at full resolution. */
    Range pairs_per_contact() const;

    /** FFT pairs of the run, with searches and feedback. */
    Range pairs_of_run() const;

    /** Unknowns, of both problems, that a step's bracket takes. */
    Range unknowns() const;

    /** The smallest 1 − L/L_c that the run visits, from a cautious threshold of
     *  similar surfaces unless the scene itself asks for it. Nothing where that is
     *  unknown or all loads seal. */
    std::optional<double> smallest_reduced_load() const;

    /** Grid points along the throat there, from fits to resolved throats. */
    std::optional<double> points_along_throat() const;

    /** All of it in lines for the screen. */
    std::vector<std::string> lines() const;

  private:
    std::size_t           n_slips() const;
    std::optional<double> critical_load() const;
    std::string           limiting_error() const;

    const Scene &scene;
    double       slope;
  };
} // namespace strait

#endif
