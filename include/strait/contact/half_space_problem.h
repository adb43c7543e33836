// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_half_space_problem_h
#define strait_contact_half_space_problem_h

#include <strait/contact/contact_problem.h>
#include <strait/contact/half_space.h>
#include <strait/contact/two_scale_operator.h>

#include <optional>

namespace strait
{
  /** The points of @p heights, on one periodic grid, perhaps with windows. */
  ContactProblem::Points points_of(const SlabField &heights);

  /** The contact of a half-space with heights on one periodic grid. */
  class HalfSpaceProblem : public DualProblem
  {
  public:
    /**
     * @p heights are referred to and must outlive this object; @p contact_modulus
     * is E* > 0. Collective.
     */
    HalfSpaceProblem(const SlabField &heights, double contact_modulus);

    double
    apply(const double *pressure, double *displacement, const WorkPass &after) override;
    double respond(const float    *step,
                   float          *response,
                   const Pass     &before,
                   const WorkPass &after) override;
    void   precondition(float *values, const Pass &before, const Pass &after) override;
    float *scratch() override;
    long   n_applications() const override;

    /** Free what is needed only while a contact is being solved. */
    void release();

  private:
    const double                 modulus;
    FourierTransform             transform;
    BasicFourierTransform<float> of_steps; // to seven digits
    TwoScaleOperator             stiffness;
  };

  /**
   * The same with adhesion: K has the symbol E* q / 2. M is a TwoScaleOperator
   * or, where the grid does not suit that, exact at the cost of an FFT pair.
   */
  class HalfSpaceGapProblem : public GapProblem
  {
  public:
    /** As HalfSpaceProblem. */
    HalfSpaceGapProblem(const SlabField   &heights,
                        double             contact_modulus,
                        const AdhesionLaw &adhesion);

    const AdhesionLaw &adhesion() const override;
    double
         apply(const double *displacement, double *traction, const Pass &before) override;
    void precondition(double *values, const Pass &before, const Pass &after) override;
    double mean_stiffness() const override;
    void   fill_with_noise(double *values) const override;
    long   n_applications() const override;

  private:
    const AdhesionLaw   law;
    FourierTransform    transform;
    const WaveStiffness stiffness;

    std::optional<TwoScaleOperator> compliance; // if the grid suits it
  };
} // namespace strait

#endif
