// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/signals.h>
#include <strait/contact/half_space_problem.h>

#include <algorithm>

namespace strait
{
  HalfSpaceProblem::HalfSpaceProblem(const SlabField &heights,
                                     const double     contact_modulus)
    : GridProblem(heights)
    , half_space(heights.layout_pointer(), contact_modulus)
    , of_steps(heights.layout_pointer(), contact_modulus)
    , stiffness(TwoScaleOperator::stiffness(heights.layout_pointer(), contact_modulus))
  {
  }

  double
  HalfSpaceProblem::apply(const double   *pressure,
                          double         *displacement,
                          const WorkPass &after)
  {
    // Either transform needs its buffer only while it is in use.
    of_steps.release();
    const double work = half_space.apply(
      pressure, displacement, [](int) {}, by_rows(after));
    half_space.release();
    return work;
  }

  double
  HalfSpaceProblem::respond(const float    *step,
                            float          *response,
                            const Pass     &before,
                            const WorkPass &after)
  {
    return of_steps.apply(step, response, by_rows(before), by_rows(after));
  }

  void
  HalfSpaceProblem::precondition(float *values, const Pass &before, const Pass &after)
  {
    stiffness.apply(values, by_rows(before), by_rows(after));
  }

  float *
  HalfSpaceProblem::scratch()
  {
    return of_steps.scratch();
  }

  long
  HalfSpaceProblem::n_applications() const
  {
    return half_space.n_pairs() + of_steps.n_pairs();
  }

  void
  HalfSpaceProblem::release()
  {
    of_steps.release();
  }

  std::size_t
  HalfSpaceProblem::memory_consumption() const
  {
    return std::max(half_space.memory_consumption(), of_steps.memory_consumption()) +
           stiffness.memory_consumption();
  }

  HalfSpaceGapProblem::HalfSpaceGapProblem(const SlabField   &heights,
                                           const double       contact_modulus,
                                           const AdhesionLaw &adhesion)
    : GridProblem(heights)
    , law(adhesion)
    , transform(heights.layout_pointer())
    , stiffness(heights.grid(), contact_modulus)
  {
    if (TwoScaleOperator::suits_compliance(heights.grid()))
      compliance.emplace(TwoScaleOperator::compliance(heights.layout_pointer(),
                                                      contact_modulus,
                                                      1. / mean_stiffness()));
  }

  const AdhesionLaw &
  HalfSpaceGapProblem::adhesion() const
  {
    return law;
  }

  double
  HalfSpaceGapProblem::mean_stiffness() const
  {
    return std::min(stiffness(1, 0), stiffness(0, 1));
  }

  double
  HalfSpaceGapProblem::apply(const double *displacement,
                             double       *traction,
                             const Pass   &before)
  {
    interruption_point();
    double work = 0;
    transform.multiply_in_passes(
      displacement,
      traction,
      stiffness,
      by_rows(before),
      [&](const double local_work) {
        work = sum(surface.layout().communicator(), local_work);
      },
      [](int) {});
    return work;
  }

  void
  HalfSpaceGapProblem::precondition(double *values, const Pass &before, const Pass &after)
  {
    if (compliance)
      {
        compliance->apply(values, by_rows(before), by_rows(after));
        return;
      }
    const double uniform = 1. / mean_stiffness();
    transform.multiply_in_passes(
      values,
      values,
      [=](const int kx, const int ky) {
        return kx == 0 && ky == 0 ? uniform : 1. / stiffness(kx, ky);
      },
      by_rows(before),
      [](double) {},
      by_rows(after));
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

  long
  HalfSpaceGapProblem::n_applications() const
  {
    return transform.n_pairs();
  }

  std::size_t
  HalfSpaceGapProblem::memory_consumption() const
  {
    return transform.memory_consumption() +
           (compliance ? compliance->memory_consumption() : 0);
  }
} // namespace strait
