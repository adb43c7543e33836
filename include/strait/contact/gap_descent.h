// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_descent_h
#define strait_contact_gap_descent_h

#include <strait/contact/gap_iterate.h>

namespace strait
{
  /**
   * What all methods that go down in energy share: they begin at a gap, tell the
   * observer where they are, and stop at a stationary gap, when the surfaces part, or
   * after too many iterations. A method says how it goes one iteration further.
   */
  class GapDescent : public GapOptimiser
  {
  public:
    GapSolution solve(double *gap) final;

    const double *
    reaction() const final
    {
      return iterate.derivative.data();
    }

  protected:
    GapDescent(GapProblem          &problem,
               const GapConstraint &constraint,
               const GapTolerance  &tolerance,
               RelaxationObserver   observer);

    /** What a step came to. */
    enum class Outcome
    {
      moved,
      again, // not moved, but another attempt from the same gap is worth while
      stuck
    };

    /** Forget what was learned on the way to another solution. */
    virtual void
    begin()
    {
    }

    /** One iteration from the present gap, whose residual is @p residual. */
    virtual Outcome descend(double residual) = 0;

    GapProblem &problem;
    GapIterate  iterate;
    double      step_length = 0; // what the observer is told; of time, for dynamics

  private:
    const GapTolerance       tolerance;
    const RelaxationObserver observer;
  };
} // namespace strait

#endif
