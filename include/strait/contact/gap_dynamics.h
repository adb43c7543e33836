// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_dynamics_h
#define strait_contact_gap_dynamics_h

#include <strait/contact/gap_descent.h>

namespace strait
{
  /**
   * Green's-function molecular dynamics: the half-space moves under the forces of
   * elasticity, adhesion and load, in time. Each Fourier mode has the mass of its
   * stiffness, so that all swing with the same frequency 1; a wall stops what reaches
   * it; FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006) turns the velocity
   * towards the force, and stops the motion whenever it goes uphill.
   */
  class GapDynamics : public GapDescent
  {
  public:
    using GapDescent::GapDescent;

  private:
    void    begin() override;
    Outcome descend(double residual) override;

    void accelerate();
    void steer();
    void advance();

    std::vector<double> velocity     = field();
    std::vector<double> acceleration = field(); // on the free points

    double mixing        = 0; // of the velocity with the acceleration's direction
    int    steps_forward = 0; // since the motion last went uphill
  };
} // namespace strait

#endif
