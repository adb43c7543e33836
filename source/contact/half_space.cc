// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/signals.h>
#include <strait/contact/half_space.h>

#include <cmath>

namespace strait
{
  template <class Number>
  BasicHalfSpace<Number>::BasicHalfSpace(const SlabLayoutPtr &layout,
                                         const double         contact_modulus)
    : Transform(layout)
    , modulus(contact_modulus)
  {
  }

  template <class Number>
  double
  BasicHalfSpace<Number>::apply(const Number *pressure, Number *displacement)
  {
    return apply(
      pressure, displacement, [](int) {}, [](int, double) {});
  }

  template <class Number>
  double
  BasicHalfSpace<Number>::apply(const Number                           *pressure,
                                Number                                 *displacement,
                                const std::function<void(int)>         &before,
                                const std::function<void(int, double)> &after)
  {
    interruption_point();
    // 2/(qE*) with q = 2π |(kx/lx, ky/ly)|, in units of lx so that tiny boxes do
    // not underflow.
    const PeriodicGrid &grid   = this->layout().grid();
    const auto          aspect = static_cast<Number>(grid.lx / grid.ly);
    const double        factor = grid.lx / (M_PI * modulus);
    const auto          symbol = [=](const int kx, const int ky) {
      const Number x = static_cast<Number>(kx), y = static_cast<Number>(ky) * aspect;
      const Number k2 = x * x + y * y;
      return k2 > 0 ? factor / std::sqrt(k2) : 0.;
    };
    double work = 0;
    this->multiply_in_passes(
      pressure,
      displacement,
      symbol,
      before,
      [&](const double local_work) {
        work = sum(this->layout().communicator(), local_work);
      },
      [&](const int row) { after(row, work); });
    return work;
  }

  template class BasicHalfSpace<float>;
  template class BasicHalfSpace<double>;
} // namespace strait
