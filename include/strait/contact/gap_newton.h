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
    using GapDescent::GapDescent;

  private:
    Outcome descend(double residual) override;

    void   solve_model(double residual);
    double precondition();
    bool   search();

    std::vector<double> step      = field(); // of the gap
    std::vector<double> remainder = field(); // of the model's gradient
    std::vector<double> z         = field(); // M remainder
    std::vector<double> direction = field();
    std::vector<double> response  = field(); // K direction, later K step

    bool met_negative_curvature = false;
  };
} // namespace strait

#endif
