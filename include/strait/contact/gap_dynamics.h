// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_dynamics_h
#define strait_contact_gap_dynamics_h

#include <strait/contact/gap_iterate.h>

namespace strait
{
  /**
   * Green's-function molecular dynamics: the half-space moves under the forces of
   * elasticity, adhesion and load, in time. Each Fourier mode has the mass of its
   * stiffness, so that all swing with the same frequency 1; a wall stops what reaches
   * it; FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006) turns the velocity
   * towards the force, and stops the motion whenever it goes uphill.
   */
  class GapDynamics : public GapOptimiser
  {
  public:
    /** Needs four fields beside the gap. */
    GapDynamics(GapProblem          &problem,
                const GapConstraint &constraint,
                const GapTolerance  &tolerance,
                RelaxationObserver   observer = {});

    GapSolution   solve(double *gap) override;
    const double *reaction() const override;
    std::size_t   memory_consumption() const override;

  private:
    void accelerate();
    void steer();
    void advance();

    GapProblem              &problem;
    const GapTolerance       tolerance;
    const RelaxationObserver observer;
    GapIterate               iterate;
    std::vector<double>      velocity;
    std::vector<double>      acceleration; // on the free points

    double time_step     = 0;
    double mixing        = 0; // of the velocity with the acceleration's direction
    int    steps_forward = 0; // since the motion last went uphill
  };
} // namespace strait

#endif
