// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/contact/half_space_problem.h>
#include <strait/contact/wall.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  Wall::Wall(SlabField heights, const double contact_modulus)
    : modulus(contact_modulus)
    , displaced(std::move(heights))
  {
    lower_highest_peak_to_zero();
    first_rms_height = rms(displaced);
    if (!std::isfinite(first_rms_height))
      throw InputError(
        "The surface has heights that are not finite numbers; mend the "
        "Expression or File of the section Surface.");
  }

  void
  Wall::deform(const SlabField *fluid_pressure, const SlabField *indentation)
  {
    const bool is_deformed = fluid_pressure != nullptr || indentation != nullptr;
    if (!is_deformed && undeformed.empty())
      return;
    if (undeformed.empty())
      undeformed = displaced;
    load = 0.;
    if (fluid_pressure == nullptr)
      std::copy(undeformed.begin(), undeformed.end(), displaced.begin());
    else
      {
        FourierTransform(layout()).multiply(fluid_pressure->data(),
                                            displaced.data(),
                                            wave_compliance<double>(layout()->grid(),
                                                                    modulus));
        for (std::size_t i = 0; i < displaced.size(); ++i)
          displaced[i] = undeformed[i] - displaced[i];
        load = mean(*fluid_pressure);
      }
    if (indentation != nullptr)
      for (std::size_t i = 0; i < displaced.size(); ++i)
        displaced[i] -= (*indentation)[i];
    if (!is_deformed)
      undeformed = SlabField();
    lower_highest_peak_to_zero();
  }

  void
  Wall::lower_highest_peak_to_zero()
  {
    const double peak = max_value(displaced);
    for (double &h : displaced)
      h -= peak;
    mean_of_heights = mean(displaced);
  }
} // namespace strait
