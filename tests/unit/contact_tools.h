// SPDX-License-Identifier: GPL-2.0-or-later
// Shared by the tests of contact: heights, and independent checks of a solution.
#pragma once

#include <strait/base/collective.h>
#include <strait/contact/contact_solver.h>
#include <strait/spectral/slab_field.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace contact_tests
{
  using namespace strait;

  inline const double pi = std::acos(-1.);

  /** Return the field @p heights(x, y) on @p grid. */
  template <class Heights>
  SlabField
  sampled(const PeriodicGrid &grid, const Heights &heights)
  {
    return sample(make_layout(grid, MPI_COMM_WORLD), heights);
  }

  /** Return a field that is neither symmetric nor smooth, the same on any number of
   *  ranks; @p a scales its wave numbers. */
  inline SlabField
  any_field(const PeriodicGrid &grid, const double a)
  {
    return sampled(grid, [&](const double x, const double y) {
      return std::sin(a * 37 * x / grid.lx + 91 * a * y / grid.ly) + 0.3 * x / grid.lx;
    });
  }

  inline double
  dot(const SlabField &a, const SlabField &b)
  {
    double product = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      product += a[i] * b[i];
    return sum(MPI_COMM_WORLD, product);
  }

  inline SlabField
  saddle_heights(const int n)
  {
    return sampled({n, n, 1., 1.}, [](const double x, const double y) {
      return 2 + std::cos(2 * pi * x) + std::cos(2 * pi * y);
    });
  }

  /**
   * Return rough heights, the same on any number of ranks: waves with wave numbers k of
   * up to @p longest per box, amplitudes ∝ k^{-1.8}, and phases from a hash.
   */
  inline SlabField
  rough_heights(const PeriodicGrid &grid, const int longest)
  {
    SlabField        field(make_layout(grid, MPI_COMM_WORLD));
    FourierTransform transform(field.layout_pointer());
    transform.synthesize(field.data(), [&](const int kx, const int ky) {
      const double k = std::hypot(kx, ky);
      if (k == 0 || k > longest)
        return std::complex<double>(0.);
      // A wave and its mirror image on the axis kx = 0 must be conjugate.
      const int  mirror = kx == 0 && ky < 0 ? -1 : 1;
      const long hash = (kx * 7919L + mirror * ky + 1000) * (kx + mirror * 31L * ky + 97);
      const double phase = mirror * 2 * pi * static_cast<double>(hash % 1009) / 1009;
      return 0.05 * std::polar(std::pow(k, -1.8), phase);
    });
    return field;
  }

  inline ContactParameters
  contact_parameters(const double         tolerance,
                     const ContactControl control = ContactControl::load,
                     const ContactMethod  method  = ContactMethod::dual_cg)
  {
    ContactParameters parameters;
    parameters.tolerance = tolerance;
    parameters.control   = control;
    parameters.method    = method;
    return parameters;
  }

  /** The value at the global point (ix, iy), on all ranks. */
  inline double
  value_at(const SlabField &field, const int ix, const int iy)
  {
    return fetch_rows(field, {iy})[ix];
  }

  inline double
  largest_difference(const SlabField &a, const SlabField &b)
  {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]));
    return maximum(a.layout().communicator(), largest);
  }

  /**
   * Return how far a state is from solving its problem, computed anew: the range of
   * G p − h − g, which is constant in a solution, over the rms height. Infinity if any
   * pressure or gap is negative, or if both are positive at any point.
   */
  inline double
  violation(const ContactState &state, const SlabField &heights, const double modulus)
  {
    SlabField gap(heights.layout_pointer());
    HalfSpaceProblem(heights, modulus).apply(state.pressure.data(), gap.data());
    double wrong = 0;
    for (std::size_t i = 0; i < gap.size(); ++i)
      {
        gap[i] -= heights[i] + state.gap[i]; // − u0
        if (state.gap[i] < 0 || state.pressure[i] < 0 ||
            state.gap[i] * state.pressure[i] != 0)
          wrong = INFINITY;
      }
    const double range = max_value(gap) - min_value(gap);
    return std::max(maximum(MPI_COMM_WORLD, wrong), range / rms(heights));
  }
} // namespace contact_tests
