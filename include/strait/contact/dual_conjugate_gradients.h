// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_dual_conjugate_gradients_h
#define strait_contact_dual_conjugate_gradients_h

#include <strait/contact/dual_optimisation.h>

#include <cstdint>

namespace strait
{
  /**
   * Preconditioned nonlinear conjugate gradients on the pressure of a contact
   * problem.
   *
   * The pressure may become negative for a few steps and is then truncated; the
   * direction stays conjugate to the last one although the contact set changes,
   * and no line search is needed. That has no proof of convergence, so the dual
   * energy ½<p, Gp> − <p, h> is watched: while a truncation leaves it above its
   * lowest value so far, the steps go along the preconditioned gradient and each
   * is truncated.
   */
  class DualConjugateGradients : public DualOptimiser
  {
  public:
    /** Needs 17 B a local point beside the two fields of solve(). */
    DualConjugateGradients(DualProblem             &problem,
                           const ContactConstraint &constraint,
                           const ContactTolerance  &tolerance);

    ContactSolution solve(double *pressure, double *gap) override;
    std::size_t     memory_consumption() const override;

  private:
    using Block = ContactProblem::Block;

    void   truncate();
    double survey();
    double choose_direction();
    double step(double slope);
    void   watch_energy();

    // What is done with a range of points in one pass.
    double choose_contact(const Block &range);
    void   measure(const Block &range);
    void   form_direction(const Block &range);
    void   move(const Block &range, double length);

    DualProblem            &problem;
    const ContactConstraint constraint;
    const ContactTolerance  tolerance;

    double                   *pressure = nullptr; // p, for now also negative
    double                   *gap      = nullptr; // g + shift
    std::vector<double>       direction;          // t
    std::vector<double>       response;           // r = G t
    std::vector<std::uint8_t> in_contact;         // 1 on the set C where p may change

    double shift        = 0;
    bool   any_negative = false; // pressure

    // The next direction is (z − mean_z) + beta (t − mean_t) on C.
    double mean_z = 0, beta = 0, mean_t = 0;

    WeightedSums<9> on_contact; // of measure()
    WeightedSums<3> moved;      // of move()

    // The dual energy falls with every step, and may rise with a truncation.
    double energy        = 0;
    double energy_scale  = 0;
    double lowest_energy = 0; // of an admissible pressure
    bool   cautious      = false;
  };
} // namespace strait

#endif
