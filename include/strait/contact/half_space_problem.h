// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_half_space_problem_h
#define strait_contact_half_space_problem_h

#include <strait/contact/dual_problem.h>
#include <strait/contact/half_space.h>
#include <strait/contact/two_scale_preconditioner.h>

namespace strait
{
  /** The contact of a half-space with heights on one periodic grid. */
  class HalfSpaceProblem : public DualProblem
  {
  public:
    /**
     * @p heights are referred to and must outlive this object; @p contact_modulus
     * is E* > 0. Collective.
     */
    HalfSpaceProblem(const SlabField &heights, double contact_modulus);

    std::size_t               size() const override;
    const std::vector<Block> &blocks() const override;
    const double             *heights() const override;
    double                    apply(const double   *pressure,
                                    double         *displacement,
                                    const Pass     &before,
                                    const WorkPass &after) override;
    void    precondition(double *values, const Pass &before, const Pass &after) override;
    double *scratch() override;
    void    sum_over_ranks(double *values, int count) const override;
    double  largest_over_ranks(double value) const override;
    long    n_applications() const override;

    /** Bytes on this rank, without the heights. */
    std::size_t memory_consumption() const;

  private:
    Block block_of_row(int local_row) const;

    const SlabField       &surface;
    HalfSpace              half_space;
    TwoScalePreconditioner preconditioner;
    std::vector<Block>     all_points;
  };
} // namespace strait

#endif
