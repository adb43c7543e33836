// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/half_space_problem.h>

namespace strait
{
  HalfSpaceProblem::HalfSpaceProblem(const SlabField &heights,
                                     const double     contact_modulus)
    : surface(heights)
    , half_space(heights.layout_pointer(), contact_modulus)
    , preconditioner(heights.layout_pointer())
    , all_points(
        {{0, heights.size(), 1. / static_cast<double>(heights.grid().n_points())}})
  {
  }

  std::size_t
  HalfSpaceProblem::size() const
  {
    return surface.size();
  }

  const std::vector<DualProblem::Block> &
  HalfSpaceProblem::blocks() const
  {
    return all_points;
  }

  const double *
  HalfSpaceProblem::heights() const
  {
    return surface.data();
  }

  DualProblem::Block
  HalfSpaceProblem::block_of_row(const int local_row) const
  {
    const std::size_t nx = surface.grid().nx, begin = local_row * nx;
    return {begin, begin + nx, all_points[0].weight};
  }

  double
  HalfSpaceProblem::apply(const double   *pressure,
                          double         *displacement,
                          const Pass     &before,
                          const WorkPass &after)
  {
    return half_space.apply(
      pressure,
      displacement,
      [&](const int row) { before(block_of_row(row)); },
      [&](const int row, const double work) { after(block_of_row(row), work); });
  }

  void
  HalfSpaceProblem::precondition(double *values, const Pass &before, const Pass &after)
  {
    preconditioner.apply(
      values,
      [&](const int row) { before(block_of_row(row)); },
      [&](const int row) { after(block_of_row(row)); });
  }

  double *
  HalfSpaceProblem::scratch()
  {
    return half_space.scratch();
  }

  void
  HalfSpaceProblem::sum_over_ranks(double *values, const int count) const
  {
    sum_in_place(surface.layout().communicator(), values, count);
  }

  double
  HalfSpaceProblem::largest_over_ranks(const double value) const
  {
    return maximum(surface.layout().communicator(), value);
  }

  long
  HalfSpaceProblem::n_applications() const
  {
    return half_space.n_fft_pairs();
  }

  std::size_t
  HalfSpaceProblem::memory_consumption() const
  {
    return half_space.memory_consumption() + preconditioner.memory_consumption();
  }
} // namespace strait
