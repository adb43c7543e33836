// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/contact_parameters.h>
#include <strait/contact/dual_optimisation.h>
#include <strait/contact/gap_optimisation.h>

#include <cstdint>
#include <vector>

/** The optimisation methods, each in a source file of its own. */
namespace strait
{
  /**
   * Preconditioned nonlinear conjugate gradients on the pressure of a contact problem.
   *
   * The pressure may leave its limits in one step and is truncated in the next. The
   * direction stays conjugate to the last one although the contact set changes, and no
   * line search is needed. There is no proof of convergence, so the dual energy
   * ½<p, Gp> − <p, h> is watched: while a truncation leaves it above its lowest value so
   * far, steps follow the preconditioned gradient and truncations include no step.
   */
  class DualConjugateGradients : private DualTask
  {
  public:
    /** Where a pressure is: at 0, between its limits (or beyond), at the upper limit. */
    enum class Place : std::uint8_t
    {
      none,
      free,
      full
    };

    /** Needs 6 B per local point in addition to the two fields. */
    explicit DualConjugateGradients(const DualTask &task)
      : DualTask(task)
    {
    }

    /** See find_pressure(). */
    ContactSolution solve();

  private:
    void   find_gap();
    double choose_active_set();
    double choose_direction();
    auto   next_direction() const;
    bool   step(double slope);
    void   step_within_limits(double length);
    template <class MovePoint>
    void move(const MovePoint &move_point);
    void watch_energy();

    using Flags = std::vector<std::uint8_t>;

    // During the search the gap y, the directions and their responses are in units of
    // tolerance.unit, so that they are of the order of one in any units. Single precision
    // is enough: a gap that shrinks keeps seven digits of its own.
    std::vector<float> gap_in_units = std::vector<float>(problem.size); // y

    // These share the memory of the gap, which is needed in double precision only before
    // the first step and after the last.
    float *const direction = reinterpret_cast<float *>(gap); // t
    float *const response  = direction + problem.size;       // r = G t

    std::vector<Place> places = std::vector<Place>(problem.size); // of p
    Flags              active = Flags(problem.size, 0); // 1 where p may change: C

    double gap_shift    = 0;     // what find_gap() subtracted from the gap to get y
    double shift        = 0;     // still to be subtracted from y
    bool   any_beyond   = false; // whether any pressure is beyond its limits
    bool   gap_is_exact = false; // rather than updated by responses
    bool   truncated    = false; // by the last step; then no points join the contact
    double last_length  = 0;     // of a step along t

    // The next direction is (z − mean_z) + beta (t − mean_t) on C.
    double mean_z = 0, beta = 0, mean_t = 0;

    // The dual energy falls in every step along t, but may rise in a truncation.
    double energy        = 0;
    double energy_scale  = 0;
    double lowest_energy = 0; // of an admissible pressure
    bool   cautious      = false;
  };

  /**
   * Bound-constrained, preconditioned, nonlinear conjugate gradients on the gap.
   *
   * The direction t = −M r + β d, with the last step d, is 0 except on the free points.
   * Its curvature is predicted from that of earlier steps, so that K need not be applied
   * to it. Instead, K is applied to the projected step d = max(g + s t, 0) − g. All gaps
   * along d are admissible, and the line search along it knows the elastic energy
   * exactly. An iteration thus costs one application of M and one of K even if points
   * close, and the energy falls in each.
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

    // The prediction for <t, Kt> is fixed_work + stiffness free_work.
    double fixed_work = 0;
    double free_work  = 0;     // <z, r>
    double stiffness  = 1.5;   // <z, Kz>/<z, r>; a typical value to begin with
    double last_fall  = 0;     // −<d, r> of the last step d, with r before it
    double reach      = 1;     // of steps that close points, over the predicted length
    bool   truncated  = false; // whether the step closes any point
    bool   restarts   = true;  // whether the next direction is −z alone
  };

  /**
   * A truncated Newton method on the free points: preconditioned conjugate gradients on
   * the quadratic model of the energy, stopped early or at negative curvature, and a
   * search along the projected step. The energy falls in each iteration. The method is
   * slower than GapConjugateGradients, and independent of it as a check.
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
   * Green's-function molecular dynamics: the half-space moves in time under the forces of
   * elasticity, adhesion and load. The mass of each Fourier mode is about its stiffness,
   * so that all oscillate with about the same angular frequency 1. The wall stops points
   * that reach it. FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006) turns the
   * velocity towards the force, and stops the motion whenever it goes uphill.
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

    double mixing        = 0; // of the velocity with the direction of the acceleration
    int    steps_forward = 0; // since the motion last went uphill
  };

  /**
   * Solve a contact without adhesion by @p method, of which only dual_cg allows for an
   * upper limit of the pressure. task.pressure is a start on entry, where values beyond
   * the limits count as the limits; it must not vanish if its mean is prescribed. On
   * return it is the solution, and task.gap is g = Gp + u0 − h. The residual is the
   * largest of |g| where p is between its limits, −g where p = 0, and g where p is at its
   * upper limit, in units of the tolerance. The constraint holds exactly. Collective.
   */
  ContactSolution find_pressure(ContactMethod method, const DualTask &task);
} // namespace strait
