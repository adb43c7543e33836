// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_half_space_problem_h
#define strait_contact_half_space_problem_h

#include <strait/contact/adhesion_law.h>
#include <strait/contact/contact_problem.h>
#include <strait/contact/pyramid_extension.h>
#include <strait/contact/two_scale_operator.h>

#include <cmath>
#include <optional>

/**
 * How a periodic elastic half-space of the contact modulus E* answers waves: u~(q) =
 * 2 p~(q)/(q E*) for q ≠ 0 and u~(0) = 0 (Johnson, Contact Mechanics, 1985). p > 0
 * presses, u > 0 points away from the substrate.
 */
namespace strait
{
  /**
   * E* q/2, by which a half-space answers a displacement by the wave that fits into a
   * periodic box kx times along x and ky times along y, a function of both.
   */
  inline auto
  wave_stiffness(const PeriodicGrid &grid, const double contact_modulus)
  {
    // In units of lx, so that tiny boxes do not underflow.
    const double unit = M_PI * contact_modulus / grid.lx, aspect = grid.lx / grid.ly;
    return [=](const int kx, const int ky) {
      const double x = kx, y = ky * aspect;
      return unit * std::sqrt(x * x + y * y);
    };
  }

  /** 2/(q E*), by which it answers a pressure, and 0 for a uniform one; to the digits of
   *  @p Number. */
  template <class Number>
  auto
  wave_compliance(const PeriodicGrid &grid, const double contact_modulus)
  {
    const double unit   = grid.lx / (M_PI * contact_modulus);
    const auto   aspect = static_cast<Number>(grid.lx / grid.ly);
    return [=](const int kx, const int ky) {
      const Number x = static_cast<Number>(kx), y = static_cast<Number>(ky) * aspect;
      const Number square = x * x + y * y;
      return square > 0 ? unit / std::sqrt(square) : 0.;
    };
  }

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

    double
    apply(const double *pressure, double *displacement, const WorkPass &after) override;
    double respond(const float    *step,
                   float          *response,
                   const Pass     &before,
                   const WorkPass &after) override;
    void   precondition(float              *values,
                        const std::uint8_t *marks,
                        const Pass         &before,
                        const Pass         &after) override;

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
    }

  private:
    const double                 modulus;
    FourierTransform             transform;
    BasicFourierTransform<float> of_steps; // to seven digits
    TwoScaleOperator             stiffness;
    PyramidExtension             extension;
  };

  /**
   * The same with adhesion: minimise ½⟨w, Kw⟩ + ⟨γ(g)⟩ + p0 ⟨g⟩ over gaps g >= 0, where
   * w = g + h and K has the symbol E* q/2. M is the inverse of K + mean_stiffness() ⟨·⟩:
   * a TwoScaleOperator or, where the grid does not suit that, exact at the cost of an FFT
   * pair.
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
    double apply(const double *displacement, double *traction, const Pass &before);

    /** Replace @p values by M values. Collective. */
    void precondition(double *values, const Pass &before);

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
    const double                    modulus;
    FourierTransform                transform;
    std::optional<TwoScaleOperator> compliance; // if the grid suits it
  };
} // namespace strait

#endif
