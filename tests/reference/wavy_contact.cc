// SPDX-License-Identifier: GPL-2.0-or-later
#include "wavy_contact.h"

#include <algorithm>
#include <cmath>

namespace strait::reference
{
  namespace
  {
    /** P = p0/p*, limited to 1, the value of complete contact. */
    double
    relative_load(const Westergaard &contact)
    {
      return std::min(contact.nominal_pressure / contact.full_pressure(), 1.);
    }
  } // namespace

  double
  Westergaard::full_pressure() const
  {
    return M_PI * modulus * amplitude / wavelength;
  }

  double
  Westergaard::contact_half_width() const
  {
    return wavelength / M_PI * std::asin(std::sqrt(relative_load(*this)));
  }

  double
  Westergaard::pressure(const double x) const
  {
    const double psi     = M_PI * x / wavelength;
    const double load    = relative_load(*this);
    const double surplus = std::max(nominal_pressure - full_pressure(), 0.);
    const double inside  = load - std::sin(psi) * std::sin(psi);
    if (inside <= 0)
      return surplus;
    // The absolute value, as cos ψ has the period 2λ but the pressure the period λ.
    return surplus + 2 * full_pressure() * std::abs(std::cos(psi)) * std::sqrt(inside);
  }

  double
  Westergaard::gap(const double x) const
  {
    const double load     = relative_load(*this);
    const double distance = std::abs(std::sin(M_PI * x / wavelength));
    const double outside  = distance * distance - load;
    if (outside <= 0)
      return 0.;
    const double wave = distance * std::sqrt(outside);
    return 2 * amplitude *
           (load > 0 ? wave - load * std::acosh(distance / std::sqrt(load)) : wave);
  }

  double
  Westergaard::mean_gap() const
  {
    const double load = relative_load(*this);
    return amplitude * (1 - load + (load > 0 ? load * std::log(load) : 0.));
  }

  namespace product_wave
  {
    double
    full_pressure(const double amplitude, const double wavelength, const double modulus)
    {
      return std::sqrt(2.) * M_PI * modulus * amplitude / wavelength;
    }

    double
    contact_fraction_at_low_load(const double load)
    {
      return M_PI * std::pow(3 * load / (8 * M_PI), 2. / 3.);
    }

    double
    contact_fraction_at_high_load(const double load)
    {
      return 1 - 3 * (1 - load) / (2 * M_PI);
    }
  } // namespace product_wave

  namespace square_saddle
  {
    double
    full_pressure(const double amplitude, const double wavelength, const double modulus)
    {
      return 2 * M_PI * modulus * amplitude / wavelength;
    }

    double
    curvature_radius(const double amplitude, const double wavelength)
    {
      return wavelength * wavelength / (2 * std::sqrt(2.) * M_PI * M_PI * amplitude);
    }
  } // namespace square_saddle
} // namespace strait::reference
