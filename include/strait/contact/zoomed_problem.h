// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/half_space_problem.h>
#include <strait/contact/zoomed_preconditioner.h>
#include <strait/spectral/fourier_transform.h>

#include <memory>
#include <vector>

namespace strait
{
  /**
   * What the surface of a half-space does under a pressure on a periodic grid and on
   * nested windows of finer points. Each point is known on the finest level that has it,
   * and stands for the area of its level.
   *
   * The pressure of a window acts on all that is around it as its mean on the parent's
   * points does, which the interpolation's adjoint spreads. Inside, the displacement is
   * interpolated from the parent's, less what that mean makes of it there, plus what the
   * pressure itself makes. Both are found in a periodic box of the window's own, a little
   * larger than it: images and means cancel in the difference, so that no kernel of free
   * space is needed. The operator is symmetric in the scalar product that is weighted by
   * area.
   *
   * @p Number is double or, for what need not be more than seven digits, float. Values
   * are those of a SlabField on the layout; at points that windows cover they are
   * ignored, and 0 in the end.
   */
  template <class Number>
  class ZoomedOperator
  {
  public:
    /** Collective. */
    ZoomedOperator(const SlabLayoutPtr &layout, double contact_modulus);
    ~ZoomedOperator();

    /** Replace pressures by displacements. Collective. */
    void apply(Number *values);

    /** The same of a pressure that goes on beyond the windows, and is given at the points
     *  that they cover as well. A window then adds what it knows beyond an interpolation
     *  of its parent, so that nothing ends at its rim; where it covers others the result
     *  means nothing. Collective. */
    void apply_to_continuous(Number *values);

    /** Replace the values of window @p window, which are 0 outside of it, by what
     * stiffness makes of them there. */
    void stiffen(int window, Number *own);

    /** Give back the room that only apply() needs, until it is called again. */
    void
    release()
    {
      grid_transform.release();
    }

    /** FFT pairs on the grid so far. */
    long
    n_pairs() const
    {
      return grid_transform.n_pairs();
    }

  private:
    class Window;

    void clear_covered(Number *values) const;
    void respond(Number *values);
    void gather_from_windows(Number *values);
    void spread_to_windows(Number *values);

    const SlabLayout &
    layout() const
    {
      return grid_transform.layout();
    }

    const double                         modulus;
    BasicFourierTransform<Number>        grid_transform;
    std::vector<std::unique_ptr<Window>> windows;
  };

  /** The contact of a half-space with heights on a periodic grid and nested windows of
   *  finer points, one problem over all points: ZoomedOperator. */
  class ZoomedProblem : public DualProblem
  {
  public:
    /** @p heights, on a layout with windows [length], are referred to and must outlive
     *  this object; @p contact_modulus is E* > 0. Collective. */
    ZoomedProblem(const SlabField &heights, double contact_modulus);

    double apply(const double *pressure, double *displacement) override;
    double respond(const float *step, float *response) override;
    void   precondition(float *values, const std::uint8_t *marks) override;

    /** What a fluid of the pressure @p pressure does to the surface, at the points that
     *  no window covers. Collective. */
    void displace(const SlabField &pressure, double *displacement);

    float *
    scratch() override
    {
      return room.data();
    }

    long
    n_applications() const override
    {
      return exact.n_pairs() + of_steps.n_pairs();
    }

  private:
    template <class Number>
    double
    act(ZoomedOperator<Number> &compliance, const Number *pressure, Number *displacement);

    ZoomedOperator<double> exact;
    ZoomedOperator<float>  of_steps;
    ZoomedPreconditioner   preconditioner;
    std::vector<float>     room, pressed; // scratch; the step that is responded to
  };
} // namespace strait
