// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/adhesion_law.h>
#include <strait/contact/contact_problem.h>
#include <strait/contact/pyramid_extension.h>
#include <strait/contact/two_scale_operator.h>
#include <strait/contact/wave_response.h>

namespace strait
{
  /** The points of @p heights, which are on a periodic grid, perhaps with windows. */
  ContactProblem points_of(const SlabField &heights);

  /** The contact of a half-space with heights on a periodic grid without windows. */
  class HalfSpaceProblem : public DualProblem
  {
  public:
    /**
     * @p heights must outlive this object; @p contact_modulus is E* > 0. Collective.
     */
    HalfSpaceProblem(const SlabField &heights, double contact_modulus);

    double apply(const double *pressure, double *displacement) override;
    double respond(const float *step, float *response) override;
    void   precondition(float *values, const std::uint8_t *marks) override;

    float *
    scratch() override
    {
      return single_precision.scratch();
    }

    long
    n_applications() const override
    {
      return transform.n_pairs() + single_precision.n_pairs();
    }

    /** Free the memory that is needed only while a contact is being solved. */
    void
    release()
    {
      single_precision.release();
      stiffness.release();
    }

  private:
    const double                 modulus;
    FourierTransform             transform;
    BasicFourierTransform<float> single_precision; // for respond()
    PyramidExtension             extension;
    TwoScaleOperator             stiffness;
  };

  /**
   * The contact with adhesion: minimise ½⟨w, Kw⟩ + ⟨γ(g)⟩ + p0 ⟨g⟩ over gaps g >= 0,
   * where w = g + h and K has the symbol E* q/2. On the open points M = (1−ER) C (1−ER)ᵀ
   * is close to the inverse of K + mean_stiffness() ⟨·⟩. C is about the inverse for all
   * points (TwoScaleOperator::compliance()), R restricts a field to the closed points and
   * E extends it from there to all points (PyramidExtension).
   */
  class GapProblem : public ContactProblem
  {
  public:
    /** As HalfSpaceProblem. */
    GapProblem(const SlabField   &heights,
               double             contact_modulus,
               const AdhesionLaw &adhesion);

    const AdhesionLaw adhesion;

    /** Compute the traction K w of the @p displacement w. Return <w, Kw>. Collective. */
    double apply(const double *displacement, double *traction);

    /**
     * Replace @p values, which must be 0 at the points that @p closed marks, by M
     * @p values. Collective.
     */
    void precondition(double *values, const std::uint8_t *closed);

    /** Stiffness of the longest wave, in M also of a uniform gap [pressure/length]. */
    double mean_stiffness() const;

    /** Write pseudo-random values in [−1, 1), the same on any number of ranks. */
    void fill_with_noise(double *values) const;

    /** Number of FFT pairs so far. */
    long
    n_applications() const
    {
      return transform.n_pairs();
    }

  private:
    /** Replace `moved` by C times itself. Collective. */
    void move();

    const double       modulus;
    FourierTransform   transform;
    PyramidExtension   extension;
    TwoScaleOperator   compliance;
    std::vector<float> moved, line; // scratch: for all local points, for a row
  };
} // namespace strait
