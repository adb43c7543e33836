// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/contact/optimisers.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // In units in which the period of a mode is 2π. An explicit step of 2 or more is
    // unstable, so that double of this diverges; half of it takes twice as many steps.
    constexpr double longest_time_step = 1.2;

    // The values of FIRE's authors (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006).
    constexpr double first_mixing = .1, mixing_decay = .99;
    constexpr double speed_up = 1.1, slow_down = .5;
    constexpr int    steps_until_faster = 5;
  } // namespace

  void
  GapDynamics::begin()
  {
    std::fill(velocity.begin(), velocity.end(), 0.);
    step_length   = longest_time_step;
    mixing        = first_mixing;
    steps_forward = 0;
  }

  bool
  GapDynamics::descend(double)
  {
    // Force over mass, 0 for a point that the wall holds.
    acceleration = derivative;
    precondition(acceleration.data());
    for (double &a : acceleration)
      a = -a;
    project_on_free(velocity.data());
    steer();
    for (std::size_t i = 0; i < problem.size; ++i)
      {
        velocity[i] += step_length * acceleration[i];
        gap[i] += step_length * velocity[i];
        if (gap[i] < 0)
          velocity[i] = 0;
      }
    make_admissible(gap);
    refresh();
    return true;
  }

  void
  GapDynamics::steer()
  {
    const auto [power, v_v, a_a] =
      weighted_sums<3>(problem, [&](const auto i, auto &sums) {
        const double v = velocity[i], a = acceleration[i];
        sums[0] -= v * (is_free(i) ? derivative[i] : 0.);
        sums[1] += v * v;
        sums[2] += a * a;
      });
    if (power > 0)
      {
        const double pull = a_a > 0 ? mixing * std::sqrt(v_v / a_a) : 0.;
        for (std::size_t i = 0; i < problem.size; ++i)
          velocity[i] = (1 - mixing) * velocity[i] + pull * acceleration[i];
        if (++steps_forward > steps_until_faster)
          {
            step_length = std::min(step_length * speed_up, longest_time_step);
            mixing *= mixing_decay;
          }
        return;
      }
    std::fill(velocity.begin(), velocity.end(), 0.);
    step_length *= slow_down;
    mixing        = first_mixing;
    steps_forward = 0;
  }
} // namespace strait
