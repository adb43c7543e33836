// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/load_sweep.h>
#include <strait/run/simulation.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace strait
{
  namespace
  {
    // Fewer points along the throat than this, and the contact grid's error exceeds a
    // per cent: prm/quickstart.prm has 0.8 % at 4.6 points and 10 % at 2.3. Half of it
    // would promise results that are off by more, double of it ask for grids four times
    // as large as are needed.
    constexpr double points_needed = 4.;

    /** A range of counts. */
    struct Range
    {
      double lowest;
      double highest;
    };

    /** Two digits are more than is known. */
    double
    rounded(const double count)
    {
      const double unit = std::pow(10., std::floor(std::log10(std::max(count, 1.))) - 1);
      return std::round(count / unit) * unit;
    }

    std::string
    to_words(const Range &range)
    {
      return format("%.0f to %.0f", rounded(range.lowest), rounded(range.highest));
    }

    /** Steps that solve a contact problem, without searches. */
    std::size_t
    n_contacts(const Scene &scene)
    {
      const std::size_t n_slips =
        scene.fluid.enabled ? scene.fluid.slip_lengths.size() : 1;
      return plan_stops(scene, {}).size() / n_slips +
             scene.programme.reduced_loads.size() * n_slips;
    }

    /** FFT pairs of one contact solution at full resolution. */
    Range
    pairs_per_contact(const Scene &scene)
    {
      if (scene.contact.adhesion.enabled)
        return {20., 300.};
      if (scene.contact.method == ContactMethod::polonsky_keer)
        return {110., 820.};
      return {10., 40.};
    }

    /** FFT pairs of the run, with searches and feedback. */
    Range
    pairs_of_run(const Scene &scene)
    {
      const auto n      = static_cast<double>(n_contacts(scene));
      Range      solves = {n, n};
      if (scene.programme.find_threshold)
        solves = {n + 7., n + 16.};
      Range pairs = pairs_per_contact(scene);
      if (scene.fluid.feedback.enabled)
        pairs = {40., 900.}; // contacts between rounds differ little
      return {solves.lowest * pairs.lowest, solves.highest * pairs.highest};
    }

    /** Unknowns, of both problems, that a step's bracket takes. */
    Range
    unknowns(const Scene &scene)
    {
      const double per_cent = std::max(1., .01 / scene.fluid.target_accuracy);
      const double most     = scene.fluid.maximum_unknowns;
      const bool   is_rough = scene.surface.kind == SurfaceKind::self_affine ||
                            scene.surface.kind == SurfaceKind::file;
      // Rough gaps have many parallel paths, or one.
      const Range range = is_rough ? Range{5e3, 2e5} : Range{500., 5e3};
      return {std::min(most, per_cent * range.lowest),
              std::min(most, per_cent * range.highest)};
    }

    /** What was found of throats on surfaces of one kind. */
    struct ThroatLaw
    {
      double critical_load; // over ContactParameters::pressure_scale()
      double points;        // of the grid along a throat, over (1 − L/L_c)^0.58
    };

    /** Nothing for other surfaces. */
    std::optional<ThroatLaw>
    throat_law(const Scene &scene)
    {
      const double spacing =
        std::max(scene.surface.size[0] / scene.contact.grid_points[0],
                 scene.surface.size[1] / scene.contact.grid_points[1]);
      // Both numbers were computed.
      if (scene.surface.kind == SurfaceKind::square_saddle)
        return ThroatLaw{.228605, .212 * scene.surface.size[0] / spacing};
      // Of random critical loads the mean, 0.24, less one standard deviation: to be
      // surprised by the threshold is worse than to be warned of it. Half and double of
      // it would warn of nearly all loads, or of none.
      if (scene.surface.kind == SurfaceKind::self_affine)
        return ThroatLaw{.19, .65 * scene.surface.short_cut_off_wavelength / spacing};
      return {};
    }

    /** The smallest 1 − L/L_c that the run visits; where the scene does not ask for it,
     *  that of a @p critical load. Nothing if all loads seal. */
    std::optional<double>
    smallest_reduced_load(const Scene &scene, const double critical)
    {
      const std::vector<double> &asked = scene.programme.reduced_loads;
      if (!asked.empty())
        return *std::min_element(asked.begin(), asked.end());
      std::optional<double> smallest;
      if (scene.contact.loads())
        for (const double pressure : scene.programme.pressures)
          if (const double reduced = 1. - pressure / critical; reduced > 0)
            smallest = std::min(smallest.value_or(reduced), reduced);
      return smallest;
    }

    std::string
    limiting_error(const Scene &scene, const double rms_slope)
    {
      if (scene.contact.zoom.enabled)
        {
          // Nearer to the critical load the contact on the grid changes by a few points
          // only: doc/zoom.md, which compares grids. Half of it trusts rows that miss
          // their error.
          constexpr double points_nearest = 16.;
          return format(
            "windows follow the throat, so the largest error is not predicted: see "
            "leak_rate_error; reduced loads below about %.2g are beyond this grid of the "
            "contact, however fine the windows",
            points_nearest / (static_cast<double>(scene.contact.grid_points[0]) *
                              scene.contact.grid_points[1]));
        }
      const std::optional<ThroatLaw> law = throat_law(scene);
      const std::optional<double>    reduced =
        law ? smallest_reduced_load(scene,
                                    law->critical_load *
                                      scene.contact.pressure_scale(rms_slope))
               : std::nullopt;
      if (!reduced)
        return "largest error: not predicted for this surface and these loads; "
               "Output/Error budget tells";
      const double      points = law->points * std::pow(*reduced, .58);
      const std::string throat =
        format("about %.2g grid points along the throat at a reduced load of %.2g%s, ",
               points,
               *reduced,
               scene.surface.kind == SurfaceKind::self_affine &&
                   scene.programme.reduced_loads.empty()
                 ? " (if such a seal closes early)"
                 : "");
      if (points < points_needed)
        {
          const auto enough = [&](const int n) {
            return std::ceil(n * points_needed / points);
          };
          return throat +
                 format(
                   "so the contact grid is likely to be the largest error (a per cent "
                   "and more): Contact/Grid points = %.0f, %.0f or more would reduce it",
                   enough(scene.contact.grid_points[0]),
                   enough(scene.contact.grid_points[1]));
        }
      return throat + format(
                        "so the mesh is likely to be the largest error (± %.2g %%): "
                        "Fluid/Target accuracy would reduce it",
                        50. * scene.fluid.target_accuracy);
    }
  } // namespace

  std::vector<std::string>
  predict_cost(const Scene &scene, const double rms_slope)
  {
    std::vector<std::string> lines;
    if (scene.contact.enabled)
      lines.push_back(
        "likely cost of the contact: " + to_words(pairs_per_contact(scene)) +
        " FFT pairs a solution, " + to_words(pairs_of_run(scene)) + " in all" +
        (scene.programme.find_blow_out ? ", without the blow-out" : ""));
    if (!scene.fluid.enabled)
      return lines;
    lines.push_back(
      "likely cost of the flow: " + to_words(unknowns(scene)) +
      " unknowns a step, at most " + std::to_string(scene.fluid.maximum_unknowns) +
      " (Fluid/Maximum unknowns)" +
      (scene.has_two_boxes() ? "; two boxes in a row take twice as many more" : ""));
    if (scene.contact.enabled)
      lines.push_back(limiting_error(scene, rms_slope));
    lines.emplace_back(
      "these are ranges from runs listed in doc/accuracy.md, paper.md, adhesion.md and "
      "feedback.md, not from this scene");
    return lines;
  }
} // namespace strait
