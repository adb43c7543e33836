// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_zoomed_problem_h
#define strait_contact_zoomed_problem_h

#include <strait/contact/half_space_problem.h>
#include <strait/contact/zoomed_operator.h>
#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /** The contact of a half-space with heights on a periodic grid and nested windows of
   *  finer points, one problem over all points: ZoomedOperator. */
  class ZoomedProblem : public DualProblem
  {
  public:
    /** @p heights, on a layout with windows [length], are referred to and must outlive
     *  this object; @p contact_modulus is E* > 0. Collective. */
    ZoomedProblem(const SlabField &heights, double contact_modulus);

    double
    apply(const double *pressure, double *displacement, const WorkPass &after) override;
    double respond(const float    *step,
                   float          *response,
                   const Pass     &before,
                   const WorkPass &after) override;
    void   precondition(float *values, const Pass &before, const Pass &after) override;
    float *scratch() override;
    long   n_applications() const override;

  private:
    template <class Number>
    double act(ZoomedOperator<Number> &compliance,
               const Number           *pressure,
               Number                 *displacement,
               const WorkPass         &after);

    ZoomedOperator<double> exact;
    ZoomedOperator<float>  of_steps;
    TwoScaleOperator       grid_stiffness;
    std::vector<float>     room, pressed; // scratch; the step that is responded to
  };
} // namespace strait

#endif
