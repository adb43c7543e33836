// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/contact/wall.h>
#include <strait/contact/zoomed_problem.h>
#include <strait/spectral/fill_windows.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  Wall::Wall(SlabField surface, const double contact_modulus)
    : heights(std::move(surface))
    , modulus(contact_modulus)
  {
    lower_highest_peak_to_zero();
    rms_height = rms(heights);
    require(std::isfinite(rms_height),
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
      undeformed = heights;
    fluid_load = 0.;
    if (fluid_pressure == nullptr)
      std::copy(undeformed.begin(), undeformed.end(), heights.begin());
    else
      {
        // The pressure may have windows that the heights have not.
        std::copy_n(fluid_pressure->begin(), heights.size(), heights.begin());
        ZoomedOperator<double>(heights.layout_pointer(), modulus)
          .apply_to_continuous(heights.data());
        for (std::size_t i = 0; i < heights.size(); ++i)
          heights[i] = undeformed[i] - heights[i];
        copy_to_covered(heights);
        fluid_load = mean(*fluid_pressure);
      }
    if (indentation != nullptr)
      for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] -= (*indentation)[i];
    if (!is_deformed)
      undeformed = SlabField();
    lower_highest_peak_to_zero();
  }

  void
  Wall::lower_highest_peak_to_zero()
  {
    const double peak = max_value(heights);
    for (double &h : heights)
      h -= peak;
    mean_height = mean(heights);
  }
} // namespace strait
