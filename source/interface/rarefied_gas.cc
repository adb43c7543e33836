// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/rarefied_gas.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    // Q_P by the BGK equation at δ = 2^(first_exponent + k/2); the first entry by the
    // expansion below it.
    constexpr double                 first_exponent = -13.;
    constexpr std::array<double, 36> solution       = {
            {5.445317, 5.250961, 5.056922, 4.863336, 4.670323, 4.478037, 4.286667, 4.096450,
             3.907663, 3.720658, 3.535839, 3.353689, 3.174770, 2.999726, 2.829287, 2.664272,
             2.505582, 2.354204, 2.211201, 2.077721, 1.955002, 1.844397, 1.747428, 1.665866,
             1.601874, 1.558234, 1.538678, 1.548410, 1.594857, 1.688788, 1.845900, 2.089040,
             2.451206, 2.979593, 3.741129, 4.830333}};
  } // namespace

  RarefiedGas::RarefiedGas(const FluidParameters &fluid)
    : kind(fluid.rarefaction)
    , scale(fluid.viscosity * fluid.thermal_speed)
    , slip(1.1466 * (2. - fluid.accommodation) / fluid.accommodation * std::sqrt(M_PI) /
           2.)
  {
  }

  double
  RarefiedGas::poiseuille_coefficient(const double delta)
  {
    // Q_P of the table minus that of viscous flow.
    static const auto excess = []() {
      auto result = solution;
      for (std::size_t k = 0; k < result.size(); ++k)
        result[k] -= std::exp2(first_exponent + .5 * static_cast<double>(k)) / 6.;
      return result;
    }();
    const double place = 2. * (std::log2(delta) - first_exponent);
    if (place <= 0.) // two steps of iteration of the integral equation, from ψ = 1
      {
        using boost::math::double_constants::euler;
        const double m       = 1. - 1.5 * euler - std::log(delta);
        const double squared = m * m + m + 5. / 6. - M_PI * M_PI / 18.;
        return (m + .5) / std::sqrt(M_PI) + delta * (1. / 3. + squared / M_PI);
      }
    if (place >= solution.size() - 1.) // the expansion in 1/δ
      return delta / 6. + 1.016191 + (1.0653 - 2.1354 / delta) / delta;
    // The cubic through four neighbours of the excess, which has no more than one bend.
    const auto k =
      std::clamp<std::size_t>(static_cast<std::size_t>(place), 1, solution.size() - 3);
    const double t = place - static_cast<double>(k);
    return delta / 6. - t * (t - 1.) * (t - 2.) / 6. * excess[k - 1] +
           (t + 1.) * (t - 1.) * (t - 2.) / 2. * excess[k] -
           (t + 1.) * t * (t - 2.) / 2. * excess[k + 1] +
           (t + 1.) * t * (t - 1.) / 6. * excess[k + 2];
  }

  double
  RarefiedGas::mobility(const double gap, const double p) const
  {
    if (kind != Rarefaction::transitional)
      return p + (kind == Rarefaction::slip ? 6. * scale * slip / gap : 0.);
    // In a vacuum Q_P is infinite.
    constexpr double least = std::numeric_limits<double>::min();
    return 6. * scale / gap * poiseuille_coefficient(std::max(p * gap / scale, least));
  }

  double
  RarefiedGas::mean_mobility(const double gap, const double low, const double high) const
  {
    if (kind != Rarefaction::transitional)
      return mobility(gap, .5 * (low + high));
    // Integrate over t with p = low + (high − low) t⁴, which tames the logarithm at
    // vacuum. The relative error of these points is 5·10⁻⁷, that of half as many 3·10⁻⁶.
    const auto integrand = [&](const double t) {
      return 4. * t * t * t * mobility(gap, low + (high - low) * std::pow(t, 4));
    };
    return boost::math::quadrature::gauss<double, 30>::integrate(integrand, 0., 1.);
  }

  double
  RarefiedGas::knudsen_number(const double gap, const double p) const
  {
    return .5 * std::sqrt(M_PI) * scale / (gap * p);
  }
} // namespace strait
