// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_zoomed_problem_h
#define strait_contact_zoomed_problem_h

#include <strait/contact/half_space_problem.h>
#include <strait/contact/two_scale_operator.h>
#include <strait/spectral/fourier_transform.h>
#include <strait/spectral/slab_field.h>

#include <memory>
#include <vector>

namespace strait
{
  /**
   * The contact of a half-space with heights on a periodic grid and nested windows of
   * finer points, one problem over all points: each is unknown on the finest level that
   * has it, and stands for the area of its level.
   *
   * The pressure of a window acts on all that is around it as its mean on the parent's
   * points does, which the interpolation's adjoint spreads. Inside, the displacement is
   * interpolated from the parent's, less what that mean makes of it there, plus what the
   * pressure itself makes. Both are found in a periodic box of the window's own, a little
   * larger than it: images and means cancel in the difference, so that no kernel of free
   * space is needed. The operator is symmetric in the scalar product that is weighted by
   * area. The same with the half-space's stiffness, nearly that on the grid,
   * preconditions it.
   */
  class ZoomedProblem : public DualProblem
  {
  public:
    /** @p heights, on a layout with windows [length], are referred to and must outlive
     *  this object; @p contact_modulus is E* > 0. Collective. */
    ZoomedProblem(const SlabField &heights, double contact_modulus);
    ~ZoomedProblem() override;

    double
    apply(const double *pressure, double *displacement, const WorkPass &after) override;
    double respond(const float    *step,
                   float          *response,
                   const Pass     &before,
                   const WorkPass &after) override;
    void   precondition(float *values, const Pass &before, const Pass &after) override;
    float *scratch() override;
    long   n_applications() const override;

    /** Bytes on this rank, without the heights. */
    std::size_t memory_consumption() const;

  private:
    class Window;

    /** What waves of the number q are multiplied with. */
    enum class Symbol
    {
      compliance, // 2/(qE*)
      stiffness   // qE*/2
    };

    template <class Number>
    void take(const Number *values, const Pass &before);
    template <class Number>
    double act(const Number   *pressure,
               Number         *displacement,
               const Pass     &before,
               const WorkPass &after);
    void   gather_from_windows();
    void   spread_to_windows(Symbol symbol);
    void   transform(FourierTransform &box, double *values, Symbol symbol) const;

    const SlabLayout &
    layout() const
    {
      return grid_transform.layout();
    }

    const double                         modulus;
    FourierTransform                     grid_transform;
    TwoScaleOperator                     grid_stiffness;
    std::vector<std::unique_ptr<Window>> windows;
    std::vector<float>                   room;
    std::vector<double>                  whole; // what is worked on, all points
  };
} // namespace strait

#endif
