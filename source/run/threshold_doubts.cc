// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/validity.h>

#include <cmath>

namespace strait
{
  namespace
  {
    // Grid points along a throat. With half of it exponents pass that the grid spoils,
    // with double of it results are doubted that a finer grid would hardly change.
    constexpr double points_along_needed = 7.;

    // An error δ of L_c spoils the local exponent at reduced loads below about 20 δ:
    // there it changes ε, and by that the leak rate's slope, by a twentieth. With half of
    // it a tenth would pass, with double of it a fortieth would be doubted.
    constexpr double load_errors_needed = 20.;
  } // namespace

  std::vector<std::string>
  doubts_near_threshold(const Step &step, const Transition &threshold, Log &log)
  {
    std::vector<std::string> doubts;
    const double             reduced = *step.reduced_load;
    if (!(reduced > 0) || !step.flow->constrictions)
      return doubts;
    const double load_error = .5 * threshold.relative_width();
    if (reduced < load_errors_needed * load_error)
      {
        doubts.emplace_back("uncertain-threshold");
        log.warn(
          format("at a reduced load of %.3g the critical load, known to %.1e, is too "
                 "uncertain: a threshold tolerance of %.1e would do",
                 reduced,
                 load_error,
                 2. * reduced / load_errors_needed));
      }
    const double points_along = step.flow->constrictions->points_along;
    if (!(points_along >= points_along_needed))
      {
        doubts.emplace_back("unresolved-throat");
        log.warn(
          std::isnan(points_along)
            ? format("at a reduced load of %.3g the narrowest point is no saddle of the "
                     "gap, as on the boundary of a mesh: how well the grid resolves it "
                     "cannot be told",
                     reduced)
            : format("at a reduced load of %.3g the throat has %.2g grid points along "
                     "it, %.0f are needed: a grid finer by a factor of %.2g would do",
                     reduced,
                     points_along,
                     points_along_needed,
                     points_along_needed / points_along));
      }
    return doubts;
  }
} // namespace strait
