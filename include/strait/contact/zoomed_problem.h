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
   * The displacement of a half-space under a pressure on a periodic grid and on nested
   * windows of finer points. Each point belongs to the finest level that has it, and
   * stands for the area of a point on that level.
   *
   * Outside a window its pressure acts like a mean of it on the points of the parent,
   * which the adjoint of the interpolation computes. Inside, the displacement is
   * interpolated from the parent, minus the part that this mean causes, plus what the
   * pressure itself causes. Both are computed in periodic boxes a little larger than the
   * window. Periodic images and the mean displacement cancel in the difference, so that
   * no free-space kernel is needed. The operator is symmetric in the scalar product
   * weighted by area.
   *
   * @p Number is double or, where seven digits are enough, float. Values are laid out
   * like those of a SlabField on the layout. At points that windows cover, apply()
   * ignores them and returns 0.
   */
  template <class Number>
  class ZoomedOperator
  {
  public:
    /** Collective. */
    ZoomedOperator(const SlabLayoutPtr &layout, double contact_modulus);
    ~ZoomedOperator();

    /** Replace the pressures @p values by the displacements. Collective. */
    void apply(Number *values);

    /** As apply(), for a pressure that is continuous across the rims of windows and also
     *  given at the points that they cover. A window adds only its difference from an
     *  interpolation of its parent, so that no step arises at its rim. Displacements at
     *  covered points are meaningless. Collective. */
    void apply_to_continuous(Number *values);

    /** Multiply the values @p own of window @p window, continued by 0 outside of it, by
     *  the stiffness E* q/2. */
    void stiffen(int window, Number *own);

    /** Free the memory of the grid's transform until it is needed again. */
    void
    release()
    {
      grid_transform.release();
    }

    /** Number of FFT pairs on the grid so far. */
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
   *  finer points: one problem over all points, with a ZoomedOperator as G. */
  class ZoomedProblem : public DualProblem
  {
  public:
    /** @p heights [length], on a layout with windows, must outlive this object;
     *  @p contact_modulus is E* > 0. Collective. */
    ZoomedProblem(const SlabField &heights, double contact_modulus);

    double apply(const double *pressure, double *displacement) override;
    double respond(const float *step, float *response) override;
    void   precondition(float *values, const std::uint8_t *marks) override;

    float *
    scratch() override
    {
      return room.data();
    }

    long
    n_applications() const override
    {
      return exact.n_pairs() + single_precision.n_pairs();
    }

  private:
    template <class Number>
    double
    act(ZoomedOperator<Number> &compliance, const Number *pressure, Number *displacement);

    ZoomedOperator<double> exact;
    ZoomedOperator<float>  single_precision;
    ZoomedPreconditioner   preconditioner;
    std::vector<float>     room, pressed; // scratch; a copy of the step in respond()
  };
} // namespace strait
