// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/contact/half_space_gap_problem.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  HalfSpaceGapProblem::HalfSpaceGapProblem(const SlabField   &heights,
                                           const double       contact_modulus,
                                           const AdhesionLaw &adhesion)
    : surface(heights)
    , law(adhesion)
    , transform(heights.layout_pointer())
    , unit_stiffness(M_PI * contact_modulus / heights.grid().lx)
    , aspect(heights.grid().lx / heights.grid().ly)
    , all_points(
        {{0, heights.size(), 1. / static_cast<double>(heights.grid().n_points())}})
  {
    if (TwoScaleCompliance::suits(heights.grid()))
      compliance = std::make_unique<TwoScaleCompliance>(heights.layout_pointer(),
                                                        contact_modulus,
                                                        1. / mean_stiffness());
  }

  std::size_t
  HalfSpaceGapProblem::size() const
  {
    return surface.size();
  }

  const std::vector<PointSet::Block> &
  HalfSpaceGapProblem::blocks() const
  {
    return all_points;
  }

  const double *
  HalfSpaceGapProblem::heights() const
  {
    return surface.data();
  }

  const AdhesionLaw &
  HalfSpaceGapProblem::adhesion() const
  {
    return law;
  }

  PointSet::Block
  HalfSpaceGapProblem::block_of_row(const int local_row) const
  {
    const std::size_t nx = surface.grid().nx, begin = local_row * nx;
    return {begin, begin + nx, all_points[0].weight};
  }

  double
  HalfSpaceGapProblem::stiffness(const int kx, const int ky) const
  {
    const double x = kx, y = ky * aspect;
    return unit_stiffness * std::sqrt(x * x + y * y);
  }

  double
  HalfSpaceGapProblem::mean_stiffness() const
  {
    return unit_stiffness * std::min(1., aspect);
  }

  double
  HalfSpaceGapProblem::apply(const double *displacement,
                             double       *traction,
                             const Pass   &before,
                             const Pass   &after)
  {
    double work = 0;
    transform.multiply_in_passes(
      displacement,
      traction,
      [this](const int kx, const int ky) { return stiffness(kx, ky); },
      [&](const int row) { before(block_of_row(row)); },
      [&](const double local_work) {
        work = sum(surface.layout().communicator(), local_work);
      },
      [&](const int row) { after(block_of_row(row)); });
    return work;
  }

  void
  HalfSpaceGapProblem::precondition(double *values, const Pass &before, const Pass &after)
  {
    if (compliance)
      {
        compliance->apply(
          values,
          [&](const int row) { before(block_of_row(row)); },
          [&](const int row) { after(block_of_row(row)); });
        return;
      }
    const double uniform = 1. / mean_stiffness();
    transform.multiply_in_passes(
      values,
      values,
      [=](const int kx, const int ky) {
        return kx == 0 && ky == 0 ? uniform : 1. / stiffness(kx, ky);
      },
      [&](const int row) { before(block_of_row(row)); },
      [](double) {},
      [&](const int row) { after(block_of_row(row)); });
  }

  void
  HalfSpaceGapProblem::fill_with_noise(double *values) const
  {
    const SlabLayout &slabs = surface.layout();
    const auto        nx    = static_cast<std::uint64_t>(slabs.grid().nx),
               first        = nx * slabs.first_row();
    for (std::uint64_t i = 0; i < size(); ++i)
      {
        // The finaliser of splitmix64, a hash of the global index.
        std::uint64_t z = (first + i + 1) * 0x9e3779b97f4a7c15ULL;
        z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z               = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        values[i]       = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.;
      }
  }

  void
  HalfSpaceGapProblem::sum_over_ranks(double *values, const int count) const
  {
    sum_in_place(surface.layout().communicator(), values, count);
  }

  double
  HalfSpaceGapProblem::largest_over_ranks(const double value) const
  {
    return maximum(surface.layout().communicator(), value);
  }

  long
  HalfSpaceGapProblem::n_applications() const
  {
    return transform.n_pairs();
  }
} // namespace strait
