// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/signals.h>
#include <strait/contact/half_space_problem.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    /** Multiply waves by @p symbol. Return the mean of in·out. Collective. */
    template <class Number, class Symbol>
    double
    multiply(BasicFourierTransform<Number> &transform,
             const Number                  *in,
             Number                        *out,
             const Symbol                  &symbol)
    {
      interruption_point();
      return sum(transform.layout().communicator(), transform.multiply(in, out, symbol));
    }
  } // namespace

  ContactProblem
  points_of(const SlabField &heights)
  {
    const SlabLayout &layout = heights.layout();
    return {layout.communicator(),
            heights.size(),
            heights.data(),
            layout.ranges(),
            static_cast<double>(layout.grid().n_points())};
  }

  HalfSpaceProblem::HalfSpaceProblem(const SlabField &heights,
                                     const double     contact_modulus)
    : DualProblem(points_of(heights))
    , modulus(contact_modulus)
    , transform(heights.layout_pointer())
    , single_precision(heights.layout_pointer())
    , extension(heights.layout_pointer())
    , stiffness(TwoScaleOperator::stiffness(heights.layout_pointer(),
                                            extension.finest().layout,
                                            modulus))
  {
  }

  double
  HalfSpaceProblem::apply(const double *pressure, double *displacement)
  {
    // Either transform needs its buffer only while it is in use.
    release();
    const double work =
      multiply(transform,
               pressure,
               displacement,
               wave_compliance<double>(transform.layout().grid(), modulus));
    transform.release();
    return work;
  }

  double
  HalfSpaceProblem::respond(const float *step, float *response)
  {
    return multiply(single_precision,
                    step,
                    response,
                    wave_compliance<float>(single_precision.layout().grid(), modulus));
  }

  void
  HalfSpaceProblem::precondition(float *values, const std::uint8_t *marks)
  {
    extension.gather(values, marks);
    extension.spread(values, marks);
    stiffness.on_boxes(extension.finest().values.own.data());
    stiffness.on_points(values);
    extension.extend_adjoint(values, marks);
  }

  GapProblem::GapProblem(const SlabField   &heights,
                         const double       contact_modulus,
                         const AdhesionLaw &adhesion_)
    : ContactProblem(points_of(heights))
    , adhesion(adhesion_)
    , modulus(contact_modulus)
    , transform(heights.layout_pointer())
    , extension(heights.layout_pointer())
    , compliance(TwoScaleOperator::compliance(heights.layout_pointer(),
                                              extension.finest().layout,
                                              modulus,
                                              1. / mean_stiffness()))
    , moved(heights.size())
    , line(heights.grid().nx)
  {
  }

  double
  GapProblem::mean_stiffness() const
  {
    const auto stiffness = wave_stiffness(transform.layout().grid(), modulus);
    return std::min(stiffness(1, 0), stiffness(0, 1));
  }

  double
  GapProblem::apply(const double *displacement, double *traction)
  {
    return multiply(transform,
                    displacement,
                    traction,
                    wave_stiffness(transform.layout().grid(), modulus));
  }

  void
  GapProblem::precondition(double *values, const std::uint8_t *closed)
  {
    float *v = moved.data();
    std::copy(values, values + size, v);
    extension.gather(v, closed);
    extension.extend_adjoint(v, closed);
    for (std::size_t i = 0; i < size; ++i)
      v[i] = static_cast<float>(values[i]) - v[i];
    move();
    for (std::size_t i = 0; i < size; ++i)
      {
        values[i] = closed[i] ? 0. : v[i];
        v[i]      = closed[i] ? v[i] : 0.f;
      }
    extension.gather(v, closed);
    extension.spread(v, closed);
    for (std::size_t i = 0; i < size; ++i)
      values[i] -= closed[i] ? 0. : v[i];
  }

  void
  GapProblem::move()
  {
    const std::size_t               nx    = line.size();
    GridBoxes                      &boxes = extension.finest();
    const std::vector<std::uint8_t> unmarked(nx);
    boxes.values.clear();
    for (int row = 0; row < transform.layout().n_rows(); ++row)
      {
        std::copy_n(moved.data() + row * nx, nx, line.data());
        boxes.interpolate_adjoint(row, line.data(), unmarked.data());
      }
    boxes.values.send();
    compliance.on_boxes(boxes.values.own.data());
    boxes.values.fetch();
    compliance.on_points(moved.data());
    for (int row = 0; row < transform.layout().n_rows(); ++row)
      {
        boxes.interpolate(row, line.data(), unmarked.data());
        for (std::size_t i = 0; i < nx; ++i)
          moved[row * nx + i] += line[i];
      }
  }

  void
  GapProblem::fill_with_noise(double *values) const
  {
    const SlabLayout &slabs = transform.layout();
    const auto        nx    = static_cast<std::uint64_t>(slabs.grid().nx),
               first        = nx * slabs.first_row();
    for (std::uint64_t i = 0; i < size; ++i)
      {
        // The finaliser of splitmix64, a hash of the global index.
        std::uint64_t z = (first + i + 1) * 0x9e3779b97f4a7c15ULL;
        z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z               = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        values[i]       = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.;
      }
  }
} // namespace strait
