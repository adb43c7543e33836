// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_gap_descent_h
#define strait_contact_gap_descent_h

#include <strait/contact/gap_optimisation.h>

#include <vector>

namespace strait
{
  /** Of the energy: what rounding may add to it in a step downhill. Half of it may call a
   *  step uphill that is not, near the end; double of it admits steps that gain nothing.
   */
  constexpr double energy_noise = 3e-13;

  /**
   * A gap g >= 0 on its way down in energy, and what follows from it: the elastic
   * traction Kw, the derivative r of the energy by g, and the curvature of the adhesion.
   */
  class GapIterate
  {
  public:
    GapIterate(GapProblem &problem, const GapConstraint &constraint);

    /** Start at @p gap, which is made admissible, and whose array is from now on
     *  worked on. One application of K; collective. */
    void start(double *gap);

    /** K w of the gap as it is, after it was changed by others. Likewise. */
    void refresh();

    /**
     * g += length·d, where the response is K d and <d, Kd> is @p work; negative
     * values that rounding leaves become 0. Collective.
     */
    void
    move(const double *direction, const double *response, double work, double length);

    /** The values that an admissible gap may not have become the nearest ones, at
     *  the prescribed mean. Collective. */
    void make_admissible(double *gap) const;

    /** Values 0 off the free points, and at fixed mean gap of the mean 0 on them.
     *  Collective. */
    void project(double *values) const;

    /** Open, or in contact but pulled away: free to move. */
    bool
    is_free(const std::size_t i) const
    {
      return gap[i] > 0 || derivative[i] < 0;
    }

    double
    energy() const
    {
      return elastic_energy + adhesive_energy;
    }

    /** Largest violation of the conditions of a minimum [pressure]. */
    double
    violation() const
    {
      return largest_violation;
    }

    /** No contact, and the load pulls at least twice as strongly as any point. */
    bool is_detached() const;

    /** Copy energies and load to @p solution. */
    void describe(GapSolution &solution) const;

    double             *gap = nullptr;
    std::vector<double> elastic;    // K w
    std::vector<double> derivative; // r = K w + γ'(g) + p0
    std::vector<double> curvature;  // γ''(g)

  private:
    void evaluate();

    GapProblem         &problem;
    const GapConstraint constraint;
    double              pressure       = 0; // p0, at fixed mean gap so that ⟨r⟩ = 0
    double              elastic_energy = 0; // ½⟨w, Kw⟩, and p0 ⟨g⟩ at fixed load
    double              adhesive_energy   = 0;
    double              largest_violation = 0;
    double              smallest_gap      = 0;
  };

  /**
   * What all methods that go down in energy share: they begin at a gap, tell the
   * observer where they are, and stop at a stationary gap, when the surfaces part, or
   * after too many iterations. A method says how it goes one iteration further.
   */
  class GapDescent : public GapOptimiser
  {
  public:
    GapDescent(GapProblem          &problem,
               const GapConstraint &constraint,
               const GapTolerance  &tolerance,
               RelaxationObserver   observer);

    GapSolution solve(double *gap) final;

    const double *
    reaction() const final
    {
      return iterate.derivative.data();
    }

    const double *
    curvature() const final
    {
      return iterate.curvature.data();
    }

    std::size_t
    memory_consumption() const final
    {
      return n_fields * problem.size() * sizeof(double);
    }

  protected:
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

    /** A field of zeros, for a method to keep. */
    std::vector<double>
    field()
    {
      ++n_fields;
      return std::vector<double>(problem.size());
    }

    GapProblem &problem;
    GapIterate  iterate;
    double      step_length = 0; // what the observer is told; of time, for dynamics

  private:
    const GapTolerance       tolerance;
    const RelaxationObserver observer;
    int                      n_fields = 3; // those of `iterate`
  };
} // namespace strait

#endif
