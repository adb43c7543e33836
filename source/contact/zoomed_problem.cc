// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/signals.h>
#include <strait/contact/zoomed_problem.h>

#include <algorithm>

namespace strait
{
  ZoomedProblem::ZoomedProblem(const SlabField &heights, const double contact_modulus)
    : DualProblem(points_of(heights))
    , exact(heights.layout_pointer(), contact_modulus)
    , of_steps(heights.layout_pointer(), contact_modulus)
    , grid_stiffness(
        TwoScaleOperator::stiffness(heights.layout_pointer(), contact_modulus))
    , room(size())
    , pressed(size())
  {
  }

  float *
  ZoomedProblem::scratch()
  {
    return room.data();
  }

  long
  ZoomedProblem::n_applications() const
  {
    return exact.n_pairs() + of_steps.n_pairs();
  }

  double
  ZoomedProblem::apply(const double   *pressure,
                       double         *displacement,
                       const WorkPass &after)
  {
    // Either transform needs its buffer only while it is in use.
    of_steps.release();
    const double work = act(exact, pressure, displacement, after);
    exact.release();
    return work;
  }

  double
  ZoomedProblem::respond(const float    *step,
                         float          *response,
                         const Pass     &before,
                         const WorkPass &after)
  {
    // The response may take the place of the step.
    for (const Block &block : blocks())
      {
        before(block);
        std::copy(step + block.begin, step + block.end, pressed.begin() + block.begin);
      }
    return act(of_steps, pressed.data(), response, after);
  }

  template <class Number>
  double
  ZoomedProblem::act(ZoomedOperator<Number> &compliance,
                     const Number           *pressure,
                     Number                 *displacement,
                     const WorkPass         &after)
  {
    interruption_point();
    std::copy(pressure, pressure + size(), displacement);
    compliance.apply(displacement);
    const auto [work] = weighted_sums<1>(*this, [=](const std::size_t i, auto &sums) {
      sums[0] += static_cast<double>(pressure[i]) * displacement[i];
    });
    for (const Block &block : blocks())
      after(block, work);
    return work;
  }

  void
  ZoomedProblem::precondition(float *values, const Pass &before, const Pass &after)
  {
    for (const Block &block : blocks())
      before(block);
    of_steps.precondition(values, grid_stiffness);
    for (const Block &block : blocks())
      after(block);
  }
} // namespace strait
