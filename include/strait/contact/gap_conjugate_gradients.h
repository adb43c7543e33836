// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_conjugate_gradients_h
#define strait_contact_gap_conjugate_gradients_h

#include <strait/contact/gap_descent.h>

namespace strait
{
  /**
   * Bound-constrained, preconditioned, nonlinear conjugate gradients on the gap.
   *
   * The direction t = −M r + β t lives on the free points. Its curvature is foretold
   * from the last one's, so that K need not be applied to it: the step d =
   * max(g + s t, 0) − g is formed first, K is applied to that, and the line along d,
   * on which all gaps are admissible, is searched with what is then known exactly. An
   * iteration thus costs one application of M and one of K, closing points included,
   * and the energy falls with each.
   */
  class GapConjugateGradients : public GapDescent
  {
  public:
    using GapDescent::GapDescent;

  private:
    void    begin() override;
    Outcome descend(double residual) override;

    void   precondition();
    double choose_direction();
    double form_step(double length);
    bool   go(double length);
    bool   search_line(double work);
    void   learn_reach(double ideal);

    std::vector<double> trial    = field(); // z = M r, then t
    std::vector<double> step     = field(); // d
    std::vector<double> response = field(); // K d

    // Sums over the points, of the present direction and step.
    double slope         = 0;   // <t, r>
    double foretold_work = 0;   // <t, Kt>
    double fixed_work    = 0;   // the part of it that is known
    double free_work     = 0;   // <z, r>, of which <z, Kz> is a known share
    double local_work    = 0;   // <t, γ'' t>
    double stiffness     = 1.5; // <z, Kz>/<z, r>, at first a typical value
    double last_fall     = 0;   // −<d, r> of the last step, before it
    double reach         = 1;   // by which a step that closes points exceeds the foretold
    bool   truncated     = false; // some point of the step closes
    bool   restarts      = true;
  };
} // namespace strait

#endif
