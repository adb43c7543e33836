// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_polonsky_keer_h
#define strait_contact_polonsky_keer_h

#include <strait/contact/dual_optimisation.h>

namespace strait
{
  /**
   * The textbook method, for reference: conjugate gradients on the pressure
   * that truncate negative pressures in every step (Polonsky, Keer, Wear 231,
   * 1999). Same problem, residual and result as DualConjugateGradients, at the
   * price of two applications of G for each step that changes the contact.
   */
  class PolonskyKeer : public DualOptimiser
  {
  public:
    /** Needs 16 B a local point beside the two fields of solve(). */
    PolonskyKeer(DualProblem             &problem,
                 const ContactConstraint &constraint,
                 const ContactTolerance  &tolerance);

    ContactSolution solve(double *pressure, double *gap) override;
    std::size_t     memory_consumption() const override;

  private:
    void   start();
    double centre_gap();
    void   update_direction();
    bool   step();

    DualProblem            &problem;
    const ContactConstraint constraint;
    const ContactTolerance  tolerance;

    double             *p = nullptr; // pressure
    double             *g = nullptr; // gap
    std::vector<double> t;           // direction
    std::vector<double> r;           // G t

    double gap_squared      = 0; // <g, g> under pressure, and one step before
    double last_gap_squared = 0;
    bool   restarts         = true; // points were added to the contact
  };
} // namespace strait

#endif
