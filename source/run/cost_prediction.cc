// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/run/cost_prediction.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** Two digits are more than is known. */
    double
    rounded(const double count)
    {
      const double unit = std::pow(10., std::floor(std::log10(std::max(count, 1.))) - 1);
      return std::round(count / unit) * unit;
    }

    std::string
    to_words(const CostPrediction::Range &range)
    {
      return format("%.0f to %.0f", rounded(range.lowest), rounded(range.highest));
    }

    // Fewer points along the throat than this, and the contact grid's error exceeds a
    // per cent: prm/quickstart.prm has 0.8 % at 3.9 points and 9 % at 2.4. Half of it
    // would promise results that are off by more, double of it ask for grids four times
    // as large as are needed.
    constexpr double points_needed = 4.;
  } // namespace

  CostPrediction::CostPrediction(const Scene &scene_, const double rms_slope)
    : scene(scene_)
    , slope(rms_slope)
  {
  }

  std::size_t
  CostPrediction::n_steps() const
  {
    const ProgrammeParameters &programme = scene.programme;
    const std::size_t          n_loads   = programme.pressures.size();
    const bool                 is_cycle  = programme.path == LoadPath::cycle;
    return (is_cycle && n_loads > 0 ? 2 * n_loads - 1 : n_loads) +
           (programme.find_threshold ? programme.reduced_loads.size() * n_slips() : 0);
  }

  std::size_t
  CostPrediction::n_slips() const
  {
    return scene.fluid.enabled ? scene.fluid.slip_lengths.size() : 1;
  }

  CostPrediction::Range
  CostPrediction::pairs_per_contact() const
  {
    if (scene.contact.adhesion.enabled)
      return {20., 300.};
    if (scene.contact.method == ContactMethod::polonsky_keer)
      return {110., 820.};
    return {18., 60.};
  }

  CostPrediction::Range
  CostPrediction::pairs_of_run() const
  {
    const auto n      = static_cast<double>(n_steps());
    Range      solves = {n, n};
    if (scene.programme.find_threshold)
      solves = {n + 7., n + 16.};
    Range pairs = pairs_per_contact();
    if (scene.fluid.feedback.enabled)
      {
        // Contacts between rounds differ little. What the fluid does to the wall depends
        // on the slip length.
        const auto slips = static_cast<double>(n_slips());
        pairs            = {40. * slips, 900. * slips};
      }
    return {solves.lowest * pairs.lowest, solves.highest * pairs.highest};
  }

  CostPrediction::Range
  CostPrediction::unknowns() const
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

  std::optional<double>
  CostPrediction::critical_load() const
  {
    // Of random surfaces the mean, 0.24, less one standard deviation: to be surprised by
    // the threshold is worse than to be warned of it. Half and double of it would warn of
    // nearly all loads, or of none.
    constexpr double rough = .19;
    // Of the square saddle that over the pressure of full contact, 2πE*Δ/λ, computed.
    constexpr double saddle = .228605;
    if (scene.surface.kind == SurfaceKind::square_saddle)
      return saddle * 2 * M_PI * scene.contact.effective_modulus *
             scene.surface.amplitude / scene.surface.size[0];
    if (scene.surface.kind == SurfaceKind::self_affine)
      return rough * scene.contact.pressure_scale(slope);
    return {};
  }

  std::optional<double>
  CostPrediction::smallest_reduced_load() const
  {
    std::optional<double> smallest;
    const auto            visit = [&smallest](const double reduced) {
      if (reduced > 0 && !(smallest && *smallest < reduced))
        smallest = reduced;
    };
    if (scene.programme.find_threshold)
      for (const double reduced : scene.programme.reduced_loads)
        visit(reduced);
    if (smallest)
      return smallest;
    const std::optional<double> critical = critical_load();
    if (critical && scene.contact.loads())
      for (const double pressure : scene.programme.pressures)
        visit(1. - pressure / *critical);
    return smallest;
  }

  std::optional<double>
  CostPrediction::points_along_throat() const
  {
    const std::optional<double> reduced = smallest_reduced_load();
    if (!reduced)
      return {};
    const double spacing  = std::max(scene.surface.size[0] / scene.contact.grid_points[0],
                                    scene.surface.size[1] / scene.contact.grid_points[1]);
    const double relative = std::pow(*reduced, .58);
    if (scene.surface.kind == SurfaceKind::square_saddle)
      return .212 * relative * scene.surface.size[0] / spacing;
    if (scene.surface.kind == SurfaceKind::self_affine)
      return .65 * relative * scene.surface.short_cut_off_wavelength / spacing;
    return {};
  }

  std::string
  CostPrediction::limiting_error() const
  {
    if (scene.contact.zoom.enabled)
      {
        // Nearer to the critical load the contact on the grid changes by a few points
        // only: doc/zoom.md, which compares grids. Half of it trusts rows that miss their
        // error.
        constexpr double points_nearest = 16.;
        return format(
          "windows follow the throat, so the largest error is not predicted: see "
          "leak_rate_error; reduced loads below about %.2g are beyond this grid of the "
          "contact, however fine the windows",
          points_nearest / (static_cast<double>(scene.contact.grid_points[0]) *
                            scene.contact.grid_points[1]));
      }
    const std::optional<double> points = points_along_throat();
    if (!points)
      return "largest error: not predicted for this surface and these loads; "
             "Output/Error budget tells";
    const bool is_searched =
      scene.programme.find_threshold && !scene.programme.reduced_loads.empty();
    const std::string throat =
      format("about %.2g grid points along the throat at a reduced load of %.2g%s, ",
             *points,
             *smallest_reduced_load(),
             scene.surface.kind == SurfaceKind::self_affine && !is_searched
               ? " (if such a seal closes early)"
               : "");
    if (*points < points_needed)
      {
        const auto enough = [&](const int n) {
          return std::ceil(n * points_needed / *points);
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

  std::vector<std::string>
  CostPrediction::lines() const
  {
    std::vector<std::string> result;
    if (scene.contact.enabled)
      result.push_back("likely cost of the contact: " + to_words(pairs_per_contact()) +
                       " FFT pairs a solution, " + to_words(pairs_of_run()) + " in all" +
                       (scene.programme.find_blow_out ? ", without the blow-out" : ""));
    if (!scene.fluid.enabled)
      return result;
    result.push_back(
      "likely cost of the flow: " + to_words(unknowns()) + " unknowns a step, at most " +
      std::to_string(scene.fluid.maximum_unknowns) + " (Fluid/Maximum unknowns)" +
      (scene.has_two_boxes() ? "; two boxes in a row take twice as many more" : ""));
    if (scene.contact.enabled)
      result.push_back(limiting_error());
    result.emplace_back(
      "these are ranges from runs listed in doc/accuracy.md, paper.md, adhesion.md and "
      "feedback.md, not from this scene");
    return result;
  }
} // namespace strait
