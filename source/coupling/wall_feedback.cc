// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/coupling/wall_feedback.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace strait
{
  namespace
  {
    constexpr int rounds_combined = 6;

    // So often the verdict may change before the two sides are enclosed.
    constexpr int changes_allowed = 3;

    FixedPoint::Product
    product_over(MPI_Comm comm)
    {
      return [comm](const std::vector<float> &a, const std::vector<float> &b) {
        double local = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
          local += static_cast<double>(a[i]) * b[i];
        return sum(comm, local);
      };
    }
  } // namespace

  WallFeedback::WallFeedback(const FeedbackParameters &feedback_parameters,
                             const SlabLayoutPtr      &layout)
    : parameters(feedback_parameters)
    , assumed(layout)
    , fixed_point(product_over(layout->communicator()),
                  parameters.acceleration == Acceleration::anderson ? rounds_combined : 0,
                  parameters.relaxation)
  {
  }

  FeedbackResult
  WallFeedback::solve(const Round        &round,
                      const double        largest_pressure,
                      const FeedbackGoal &goal)
  {
    scale = largest_pressure;
    FeedbackResult        result;
    std::optional<double> last_leak_rate;
    std::optional<bool>   last_verdict;
    int                   changes_of_verdict = 0;
    if (goal.goes_on)
      fixed_point.move_on();
    else
      fixed_point.restart();
    fixed_point.relax(parameters.relaxation);
    while (result.iterations < parameters.maximum_iterations)
      {
        const FeedbackRound now = round(assumed);
        ++result.iterations;
        result.change = difference(now.fluid_pressure, assumed);
        // Without a round before, an unchanged pressure says it all.
        const double leak_before = last_leak_rate.value_or(now.leak_rate);
        const bool   leak_agrees =
          !goal.leak_rate ||
          std::abs(now.leak_rate - leak_before) <= parameters.tolerance * now.leak_rate;
        if (result.change <= parameters.tolerance && leak_agrees)
          {
            result.converged = true;
            return result;
          }
        if (last_verdict && *last_verdict != now.percolates)
          {
            fixed_point.restart();
            fixed_point.relax(.5 * fixed_point.relaxation());
            ++changes_of_verdict;
          }
        (now.percolates ? open_side : closed_side) = assumed;
        if (changes_of_verdict > changes_allowed)
          return bisect(round, result);
        last_verdict   = now.percolates;
        last_leak_rate = now.leak_rate;
        fixed_point.advance(assumed.data(), now.fluid_pressure.data(), assumed.size());
      }
    return result;
  }

  FeedbackResult
  WallFeedback::bisect(const Round &round, FeedbackResult result)
  {
    while (difference(open_side, closed_side) > parameters.tolerance &&
           result.iterations < parameters.maximum_iterations)
      {
        for (std::size_t i = 0; i < assumed.size(); ++i)
          assumed[i] = .5 * (open_side[i] + closed_side[i]);
        const FeedbackRound now = round(assumed);
        ++result.iterations;
        result.change = difference(now.fluid_pressure, assumed);
        if (result.change <= parameters.tolerance)
          {
            result.converged = true;
            return result;
          }
        (now.percolates ? open_side : closed_side) = assumed;
      }
    assumed = open_side;
    round(assumed);
    ++result.iterations;
    result.undecided = true;
    return result;
  }

  double
  WallFeedback::difference(const SlabField &a, const SlabField &b) const
  {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      squares += (a[i] - b[i]) * (a[i] - b[i]);
    const auto n_points = static_cast<double>(a.grid().n_points());
    return std::sqrt(sum(a.layout().communicator(), squares) / n_points) / scale;
  }

  std::size_t
  WallFeedback::memory_consumption() const
  {
    return fixed_point.memory_consumption() +
           (assumed.size() + open_side.size() + closed_side.size()) * sizeof(double);
  }
} // namespace strait
