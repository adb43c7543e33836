// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_half_space_gap_problem_h
#define strait_contact_half_space_gap_problem_h

#include <strait/contact/gap_problem.h>
#include <strait/contact/two_scale_compliance.h>
#include <strait/spectral/fourier_transform.h>

#include <memory>

namespace strait
{
  /**
   * The adhesive contact of a half-space with heights on one periodic grid: K has the
   * symbol E* q / 2. M is a TwoScaleCompliance or, where the grid does not suit that,
   * exact at the cost of an FFT pair.
   */
  class HalfSpaceGapProblem : public GapProblem
  {
  public:
    /**
     * @p heights are referred to and must outlive this object; @p contact_modulus
     * is E* > 0. Collective.
     */
    HalfSpaceGapProblem(const SlabField   &heights,
                        double             contact_modulus,
                        const AdhesionLaw &adhesion);

    std::size_t               size() const override;
    const std::vector<Block> &blocks() const override;
    const double             *heights() const override;
    const AdhesionLaw        &adhesion() const override;
    double                    apply(const double *displacement,
                                    double       *traction,
                                    const Pass   &before,
                                    const Pass   &after) override;
    void   precondition(double *values, const Pass &before, const Pass &after) override;
    double mean_stiffness() const override;
    void   fill_with_noise(double *values) const override;
    void   sum_over_ranks(double *values, int count) const override;
    double largest_over_ranks(double value) const override;
    long   n_applications() const override;

    /** Bytes on this rank, without the heights. */
    std::size_t
    memory_consumption() const
    {
      return transform.memory_consumption() +
             (compliance ? compliance->memory_consumption() : 0);
    }

  private:
    Block  block_of_row(int local_row) const;
    double stiffness(int kx, int ky) const;

    const SlabField   &surface;
    const AdhesionLaw  law;
    FourierTransform   transform;
    double             unit_stiffness; // of the wave that fits into the box once along x
    double             aspect;         // lx/ly
    std::vector<Block> all_points;

    std::unique_ptr<TwoScaleCompliance> compliance; // if the grid suits it
  };
} // namespace strait

#endif
