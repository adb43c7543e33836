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
  /** Add to @p all, "ok" or words joined by +, those of @p more that it lacks. */
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
    double      relative = 0.; // not a number: not known
    std::string parameter;     // that would reduce it
  };

  /** The errors of a step's leak rate, the largest first (load_sweep.h). */
  struct StepErrors
  {
    std::vector<ErrorItem> items;
    std::optional<double>  grid_order;   // observed from contact grid to contact grid
    std::optional<double>  extrapolated; // leak rate at a grid spacing of zero

    /** The first that is known. There must be some. */
    const ErrorItem &
    largest_known() const
    {
      for (const ErrorItem &item : items)
        if (!std::isnan(item.relative))
          return item;
      return items.front();
    }

    /** All of them together; not a number if one is not known or the leak rate is 0. */
    double
    sum() const
    {
      double total = 0.;
      for (const ErrorItem &item : items)
        total += item.relative;
      return items.empty() ? std::numeric_limits<double>::quiet_NaN() : total;
    }
  };

  /** With fewer grid points the contact grid's error may exceed that of a bracket of 2 %.
   *  Contact grid and interpolation change the leak rate of prm/quickstart.prm by 2 %
   *  with 2.9 points; by 10 to 27 % with 1.4 to 2.3, by 0.5 % with 6. */
  constexpr double least_points_along_throat = 3.;

  /** One limit of the model, and what a step says of it. */
  struct ValidityCheck
  {
    std::string word;             // of the column validity where the limit is passed
    double      number;           // of the step
    double      limit;            // for that number
    std::string advice;           // what it means, and what to switch on or to change
    bool        is_least = false; // it must not fall below the limit, or not exceed it

    /** Whether the model holds in this respect; a number that is none proves nothing. */
    bool
    holds() const
    {
      return is_least ? number >= limit : number <= limit;
    }
  };

  /** One step of the load programme, with all that its output may need. */
  struct Step
  {
    int         number = 0; // counts from 1
    std::string branch;     // loading or unloading
    SealState   state;
    double dissipated_energy = 0.; // by jumps of the contact on the way [energy/area]

    std::optional<StepFlow>     flow;         // unless the fluid is off
    std::optional<Leakage>      two_boxes;    // of two in a row, if the scene asks for it
    std::optional<TheoryResult> theory;       // if the scene asks for it
    std::optional<double>       reduced_load; // 1 − L/L_c, if the threshold is known
    StepErrors                  errors;       // of the leak rate, if there is one
    std::vector<std::string>    doubts;       // about a result that may have converged
    std::vector<ValidityCheck>  checks;       // of the model's limits
    double                      flow_seconds = 0.;

    /** "ok", or a word for each limit of the model that the step passes, joined by +. */
    std::string
    validity() const
    {
      std::string words = "ok";
      for (const ValidityCheck &check : checks)
        if (!check.holds())
          add_words(words, check.word);
      return words;
    }

    /** Where the path of least resistance is narrowest; not numbers if there is none. */
    std::array<double, 2>
    place_of_bottleneck() const
    {
      const std::vector<FlowPath> &paths = flow->channel.paths;
      if (paths.empty())
        return {std::nan(""), std::nan("")};
      return position_of(state.gap().layout(), paths.front().bottleneck);
    }

    /** Whether all solvers reached what was asked of them. */
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

  /** Compare @p step with every limit of the model for which @p scene gives what is
   *  needed, and warn of those that are passed. doc/validity.md lists the limits with
   *  their sources. @p rms_slope is that of the surface. Collective. */
  void judge_validity(Step &step, const Scene &scene, double rms_slope, Log &log);

  /** On the live line, the step that begins and how long it and those after it may take
   *  if each takes @p seconds_each; 0: that is not known. */
  void announce_step(int number, int n_steps, double seconds_each, Log &log);

  /** A line on a step that is done. */
  void report_step(const Step &step, int n_steps, Log &log);
} // namespace strait
