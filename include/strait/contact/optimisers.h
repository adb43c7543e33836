// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/contact/dual_optimisation.h>
#include <strait/contact/gap_optimisation.h>

#include <cstdint>
#include <vector>

/** The methods that optimise, each with a source of its own. */
namespace strait
{
  /**
   * Preconditioned nonlinear conjugate gradients on the pressure of a contact
   * problem.
   *
   * The pressure may leave its limits in one step and is truncated in the next; the
   * direction stays conjugate to the last one although the contact set changes,
   * and no line search is needed. That has no proof of convergence, so the dual
   * energy ½<p, Gp> − <p, h> is watched: while a truncation leaves it above its
   * lowest value so far, steps go along the preconditioned gradient and truncations
   * no further.
   */
  class DualConjugateGradients : private DualTask
  {
  public:
    /** Where a pressure is: at a limit or between them (or beyond). */
    enum class Place : std::uint8_t
    {
      none,
      free,
      full
    };

    /** Needs 6 B a local point beside the two fields. */
    explicit DualConjugateGradients(const DualTask &task)
      : DualTask(task)
    {
    }

    /** As find_pressure(). */
    ContactSolution solve();

  private:
    void   find_gap();
    double survey();
    double choose_direction();
    auto   next_direction() const;
    bool   step(double slope);
    void   step_within_limits(double length);
    template <class MovePoint>
    void move(const MovePoint &move_point);
    void watch_energy();

    using Flags = std::vector<std::uint8_t>;

    // On the way the gap y, the directions and what these make of the gap are in units of
    // tolerance.unit, so that they are of the order of one in any units, and have seven
    // digits: what is left of a gap that shrinks has seven digits of its own.
    std::vector<float> gap_in_units = std::vector<float>(problem.size); // y

    // In the room of the gap, which is needed in all digits before the first step and
    // after the last.
    float *const direction = reinterpret_cast<float *>(gap); // t
    float *const response  = direction + problem.size;       // r = G t

    std::vector<Place> places     = std::vector<Place>(problem.size); // of p
    Flags              in_contact = Flags(problem.size, 0); // 1 where p may change: C

    double gap_shift    = 0;     // by which the exact gap is larger than y was at first
    double shift        = 0;     // by which y is too large
    bool   any_beyond   = false; // pressure, its limits
    bool   gap_is_exact = false; // and not the sum of responses
    bool   truncated    = false; // by the last step, after which what is open stays so
    double last_length  = 0;     // of a step along t

    // The next direction is (z − mean_z) + beta (t − mean_t) on C.
    double mean_z = 0, beta = 0, mean_t = 0;

    // The dual energy falls with every step along t, and may rise with one within the
    // limits.
    double energy        = 0;
    double energy_scale  = 0;
    double lowest_energy = 0; // of an admissible pressure
    bool   cautious      = false;
  };

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
  class GapConjugateGradients : public GapOptimiser
  {
  public:
    using GapOptimiser::GapOptimiser;

  private:
    void begin() override;
    bool descend(double residual) override;

    double choose_direction();
    double form_step(double length);
    bool   go(double length);
    bool   search_line(double work);

    std::vector<double> trial    = field(); // z = M r, then t
    std::vector<double> step     = field(); // d
    std::vector<double> response = field(); // K d

    // Of the present direction, <t, Kt> is foretold as fixed_work + stiffness free_work.
    double fixed_work = 0;
    double free_work  = 0;     // <z, r>
    double stiffness  = 1.5;   // <z, Kz>/<z, r>, at first a typical value
    double last_fall  = 0;     // −<d, r> of the last step, before it
    double reach      = 1;     // by which a step that closes points exceeds the foretold
    bool   truncated  = false; // some point of the step closes
    bool   restarts   = true;
  };

  /**
   * Truncated Newton's method on the free points: preconditioned conjugate gradients
   * on the quadratic model of the energy, stopped early or where its curvature turns
   * negative, and a search along the projected step. The energy falls with each
   * iteration. Slower than GapConjugateGradients and independent of it.
   */
  class GapNewton : public GapOptimiser
  {
  public:
    using GapOptimiser::GapOptimiser;

  private:
    bool descend(double residual) override;

    void solve_model(double residual);
    bool search();

    std::vector<double> step      = field(); // of the gap
    std::vector<double> remainder = field(); // of the model's gradient
    std::vector<double> z         = field(); // M remainder
    std::vector<double> direction = field();
    std::vector<double> response  = field(); // K direction, later K step
  };

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
    using GapOptimiser::GapOptimiser;

  private:
    void begin() override;
    bool descend(double residual) override;

    void steer();

    std::vector<double> velocity     = field();
    std::vector<double> acceleration = field(); // on the free points

    double mixing        = 0; // of the velocity with the acceleration's direction
    int    steps_forward = 0; // since the motion last went uphill
  };

  /**
   * Solve a contact without adhesion by the method of this name. Its pressure: a start on
   * entry (values beyond the limits count as these; it must not vanish if its mean is
   * prescribed), the solution on return. Its gap: on return g = Gp + u0 − h. The
   * residual is the largest of |g| between the limits of p, −g where p = 0, and g where p
   * is at its upper limit, over the unit of the tolerance; the constraint holds exactly.
   * Collective.
   */
  ContactSolution find_pressure(ContactMethod method, const DualTask &task);
} // namespace strait
