// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_half_space_problem_h
#define strait_contact_half_space_problem_h

#include <strait/base/collective.h>
#include <strait/contact/contact_problem.h>
#include <strait/contact/half_space.h>
#include <strait/contact/two_scale_operator.h>

#include <optional>

namespace strait
{
  /** What problems on one periodic grid have in common, perhaps with windows: its points
   *  and their heights. */
  template <class Problem>
  class GridProblem : public Problem
  {
  public:
    using Block = ContactProblem::Block;

    std::size_t
    size() const override
    {
      return surface.size();
    }

    const std::vector<Block> &
    blocks() const override
    {
      return all_points;
    }

    const double *
    heights() const override
    {
      return surface.data();
    }

    void
    sum_over_ranks(double *values, const int count) const override
    {
      sum_in_place(surface.layout().communicator(), values, count);
    }

    double
    largest_over_ranks(const double value) const override
    {
      return maximum(surface.layout().communicator(), value);
    }

  protected:
    explicit GridProblem(const SlabField &heights)
      : surface(heights)
    {
      const auto n_points = static_cast<double>(heights.grid().n_points());
      for (const SlabLayout::Range &range : heights.layout().ranges())
        all_points.push_back({range.begin, range.end, range.area / n_points});
    }

    /** The points of one row of this rank. */
    Block
    block_of_row(const int local_row) const
    {
      const std::size_t nx = surface.grid().nx, begin = local_row * nx;
      return {begin, begin + nx, all_points[0].weight};
    }

    /** @p pass for callers that go row by row. */
    std::function<void(int)>
    by_rows(const ContactProblem::Pass &pass) const
    {
      return [this, &pass](const int row) { pass(block_of_row(row)); };
    }

    /** The same for a pass that is told the work. */
    std::function<void(int, double)>
    by_rows(const DualProblem::WorkPass &pass) const
    {
      return [this, &pass](const int row, const double work) {
        pass(block_of_row(row), work);
      };
    }

    const SlabField &surface;

  private:
    std::vector<Block> all_points;
  };

  /** The contact of a half-space with heights on one periodic grid. */
  class HalfSpaceProblem : public GridProblem<DualProblem>
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

    /** Bytes on this rank while a contact is being solved, without the heights. */
    std::size_t memory_consumption() const;

  private:
    HalfSpace             half_space;
    BasicHalfSpace<float> of_steps; // the same to seven digits
    TwoScaleOperator      stiffness;
  };

  /**
   * The same with adhesion: K has the symbol E* q / 2. M is a TwoScaleOperator
   * or, where the grid does not suit that, exact at the cost of an FFT pair.
   */
  class HalfSpaceGapProblem : public GridProblem<GapProblem>
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

    /** Bytes on this rank, without the heights. */
    std::size_t memory_consumption() const;

  private:
    const AdhesionLaw   law;
    FourierTransform    transform;
    const WaveStiffness stiffness;

    std::optional<TwoScaleOperator> compliance; // if the grid suits it
  };
} // namespace strait

#endif
