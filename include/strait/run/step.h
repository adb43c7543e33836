// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/base/text.h>
#include <strait/percolation/bottleneck.h>
#include <strait/run/theory_prediction.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/seal_state.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace strait
{
  /** Add to @p all the words of @p more that it lacks; lists are "ok" or joined by +. */
  inline void
  add_words(std::string &all, const std::string &more)
  {
    std::vector<std::string> words =
      all == "ok" ? std::vector<std::string>() : split(all, '+');
    for (const std::string &word : split(more, '+'))
      if (word != "ok" && std::find(words.begin(), words.end(), word) == words.end())
        words.push_back(word);
    all = words.empty() ? "ok" : join(words, "+");
  }

  /** One source of error of a leak rate. */
  struct ErrorItem
  {
    std::string source;
    double      relative = 0.; // not a number if it is not known
    std::string parameter;     // that would reduce it
  };

  /** The errors of a step's leak rate: see assess_errors() in load_sweep.h. */
  struct StepErrors
  {
    std::vector<ErrorItem> items;        // unknown ones first, then the largest
    std::optional<double>  grid_order;   // of convergence with the contact grid, observed
    std::optional<double>  extrapolated; // leak rate at a grid spacing of zero

    /** The largest that is known, or the first item. There must be some. */
    const ErrorItem &
    largest_known() const
    {
      for (const ErrorItem &item : items)
        if (!std::isnan(item.relative))
          return item;
      return items.front();
    }

    /** The sum of all items; not a number if one is not known or there is none, as for a
     *  leak rate of 0. */
    double
    sum() const
    {
      double total = 0.;
      for (const ErrorItem &item : items)
        total += item.relative;
      return items.empty() ? std::numeric_limits<double>::quiet_NaN() : total;
    }
  };

  /** With fewer grid points along a throat, the error of the contact grid may exceed that
   *  of a bracket of 2 %. Contact grid and interpolation change the leak rate of
   *  prm/quickstart.prm by 2 % with 2.9 points, by 10 to 27 % with 1.4 to 2.3 points, and
   *  by 0.5 % with 6. */
  constexpr double least_points_along_throat = 3.;

  /** One limit of the model, and the number of a step that is compared with it. */
  struct ValidityCheck
  {
    std::string word;   // for the column validity, if the limit is violated
    double      number; // of the step
    double      limit;  // for that number
    std::string advice; // what a violation means, and what to change
    bool        is_lower_limit = false; // whether the limit is a lower one

    /** Whether the step keeps to the limit; false if the number is not a number. */
    bool
    holds() const
    {
      return is_lower_limit ? number >= limit : number <= limit;
    }
  };

  /** One step of the load programme, with all that its output may need. */
  struct Step
  {
    int         number = 0; // counts from 1
    std::string branch;     // loading or unloading
    SealState   state;
    double      dissipated_energy = 0.; // by jumps since the last step [energy/area]

    std::optional<StepFlow>     flow;         // unless the fluid is off
    std::optional<Leakage>      two_boxes;    // of two boxes in a row, if they are needed
    std::optional<TheoryResult> theory;       // if the scene asks for it
    std::optional<double>       reduced_load; // 1 − L/L_c, if the threshold is known
    StepErrors                  errors;       // of the leak rate, if there is one
    std::vector<std::string>    doubts;       // words for a result that may be converged
    std::vector<ValidityCheck>  checks;       // of the model's limits
    double                      flow_seconds = 0.;

    /** "ok", or a word for each limit of the model that is violated, joined by +. */
    std::string
    validity() const
    {
      std::string words = "ok";
      for (const ValidityCheck &check : checks)
        if (!check.holds())
          add_words(words, check.word);
      return words;
    }

    /** Where the path of least resistance is narrowest [length]; not numbers if there is
     *  no path. */
    std::array<double, 2>
    place_of_bottleneck() const
    {
      const std::vector<FlowPath> &paths = flow->channel.paths;
      if (paths.empty())
        return {std::nan(""), std::nan("")};
      return position_of(state.gap().layout(), paths.front().bottleneck);
    }

    /** Whether all solvers reached the accuracy that was asked for. */
    bool
    converged() const
    {
      return state.converged() && (!flow || flow->leakage.status == "ok");
    }

    /** "ok", or a short word for each thing that failed or is in doubt, joined by +. */
    std::string
    status() const
    {
      std::string words = "ok";
      if (state.contact && !state.contact->converged)
        add_words(words, "contact-not-converged");
      if (flow)
        add_words(words, flow->leakage.status);
      if (state.fluid && !state.fluid->converged)
        add_words(words,
                  state.fluid->lifted_off ? "lifted-off" : "feedback-not-converged");
      for (const std::string &doubt : doubts)
        add_words(words, doubt);
      return words;
    }
  };

  /** Compare @p step with every limit of the model for which @p scene gives the data, and
   *  warn of each that is violated, once in a run. doc/validity.md lists the limits with
   *  their sources. @p rms_slope is that of the surface. Collective. */
  void judge_validity(Step &step, const Scene &scene, double rms_slope, Log &log);

  /** Show on the live line of @p log which step begins, and how long it and those after
   *  it may take if each takes @p seconds_each; 0 if that is not known. */
  void announce_step(int number, int n_steps, double seconds_each, Log &log);

  /** Write a line on a finished step to @p log, and one on its largest error. */
  void report_step(const Step &step, int n_steps, Log &log);
} // namespace strait
