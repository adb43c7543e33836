// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/adhesion_law.h>
#include <strait/contact/contact_problem.h>
#include <strait/contact/pyramid_extension.h>
#include <strait/contact/two_scale_operator.h>
#include <strait/contact/wave_response.h>

namespace strait
{
  /** The points of @p heights, on one periodic grid, perhaps with windows. */
  ContactProblem points_of(const SlabField &heights);

  /** The contact of a half-space with heights on one periodic grid. */
  class HalfSpaceProblem : public DualProblem
  {
  public:
    /**
     * @p heights are referred to and must outlive this object; @p contact_modulus
     * is E* > 0. Collective.
     */
    HalfSpaceProblem(const SlabField &heights, double contact_modulus);

    double apply(const double *pressure, double *displacement) override;
    double respond(const float *step, float *response) override;
    void   precondition(float *values, const std::uint8_t *marks) override;

    float *
    scratch() override
    {
      return of_steps.scratch();
    }

    long
    n_applications() const override
    {
      return transform.n_pairs() + of_steps.n_pairs();
    }

    /** Free what is needed only while a contact is being solved. */
    void
    release()
    {
      of_steps.release();
      stiffness.release();
    }

  private:
    const double                 modulus;
    FourierTransform             transform;
    BasicFourierTransform<float> of_steps; // to seven digits
    PyramidExtension             extension;
    TwoScaleOperator             stiffness;
  };

  /**
   * The same with adhesion: minimise ½⟨w, Kw⟩ + ⟨γ(g)⟩ + p0 ⟨g⟩ over gaps g >= 0, where
   * w = g + h and K has the symbol E* q/2. M is close to the inverse of K +
   * mean_stiffness() ⟨·⟩ on the open points: the compliance, of which what it does to the
   * closed points is taken off, extended to all (PyramidExtension), before and after.
   */
  class GapProblem : public ContactProblem
  {
  public:
    /** As HalfSpaceProblem. */
    GapProblem(const SlabField   &heights,
               double             contact_modulus,
               const AdhesionLaw &adhesion);

    const AdhesionLaw adhesion;

    /** traction = K w. Returns <w, Kw>. Collective. */
    double apply(const double *displacement, double *traction);

    /**
     * Replace @p values, which are 0 at points that @p closed marks, by M values.
     * Collective.
     */
    void precondition(double *values, const std::uint8_t *closed);

    /** What stands in M for the stiffness of a uniform gap [pressure/length]. */
    double mean_stiffness() const;

    /** Rough values of the order one, the same however the points are dealt out. */
    void fill_with_noise(double *values) const;

    /** FFT pairs so far. */
    long
    n_applications() const
    {
      return transform.n_pairs();
    }

  private:
    /** Replace what stands in `moved` by what the compliance makes of it. */
    void move();

    const double       modulus;
    FourierTransform   transform;
    PyramidExtension   extension;
    TwoScaleOperator   compliance;
    std::vector<float> moved, line; // scratch: for all points, for those of a row
  };
} // namespace strait
