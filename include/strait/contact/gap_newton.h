// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_newton_h
#define strait_contact_gap_newton_h

#include <strait/contact/gap_descent.h>

namespace strait
{
  /**
   * Truncated Newton's method on the free points: preconditioned conjugate gradients
   * on the quadratic model of the energy, stopped early or where its curvature turns
   * negative, and a search along the projected step. The energy falls with each
   * iteration. Slower than GapConjugateGradients and independent of it.
   */
  class GapNewton : public GapDescent
  {
  public:
    /** Needs seven fields beside the gap. */
    GapNewton(GapProblem          &problem,
              const GapConstraint &constraint,
              const GapTolerance  &tolerance,
              RelaxationObserver   observer = {});

    std::size_t memory_consumption() const override;

  private:
    Outcome descend(double residual) override;

    void   solve_model(double residual);
    double precondition();
    bool   search();

    std::vector<double> step;      // of the gap
    std::vector<double> remainder; // of the model's gradient
    std::vector<double> z;         // M remainder
    std::vector<double> direction;
    std::vector<double> response; // K direction, later K step

    bool met_negative_curvature = false;
  };
} // namespace strait

#endif
