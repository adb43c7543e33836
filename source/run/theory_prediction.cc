// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/theory_prediction.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    // Decades below the largest gap that bins cover. Near a contact line simulated gaps
    // fall to zero over all scales, but those beyond half of it conduct nothing already;
    // double of it only adds empty bins.
    constexpr int n_decades = 10;

    // Bins per decade in the output: half of it blurs the peak, double of it is noisy on
    // small grids.
    constexpr int bins_shown = 10;

    /** The leak rate of the box divided by its effective cubed gap. */
    double
    conductance_of_box(const Scene &scene)
    {
      const double aspect = scene.fluid.direction == FlowDirection::x
                              ? scene.surface.size[1] / scene.surface.size[0]
                              : scene.surface.size[0] / scene.surface.size[1];
      return aspect * (scene.fluid.inlet_pressure - scene.fluid.outlet_pressure) /
             (12 * scene.fluid.viscosity);
    }

    RadialSpectrum
    spectrum_of(const Scene &scene, const SlabField *heights)
    {
      return scene.theory.spectrum_of_surface ? measured_spectrum(*heights)
                                              : model_spectrum(scene.surface);
    }

    double
    relative_difference(const double a, const double b)
    {
      return a == b ? 0. : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
    }

    /** The contact fraction at which the effective medium seals, 1 − 1/n. */
    double
    critical_fraction(const Scene         &scene,
                      const PerssonTheory &with,
                      const double         slip_length,
                      const Transition    *threshold)
    {
      if (scene.theory.dimension == TheoryDimension::critical_fraction)
        return scene.theory.critical_fraction;
      if (scene.theory.dimension == TheoryDimension::bruggeman)
        return .5;
      if (scene.theory.simulated_gaps)
        return threshold->contact_area;
      const double critical = threshold->middle();
      return slip_length == 0.
               ? with.contact_area(critical)
               : with.distribution(with.solve(critical), -2 * slip_length).contact_area;
    }
  } // namespace

  TheoryPrediction::TheoryPrediction(const Scene &scene_, const SlabField *heights)
    : scene(scene_)
    , persson(spectrum_of(scene, heights),
              scene.contact.effective_modulus,
              scene.theory.gamma)
    , coarse(persson.spectrum(), scene.contact.effective_modulus, scene.theory.gamma, 2)
  {
  }

  TheoryResult
  TheoryPrediction::predict(const double      pressure,
                            const double      slip_length,
                            const SlabField  *gap,
                            const Transition *threshold) const
  {
    const bool shows_gaps = scene.output.fields != FieldOutput::none;
    // All but the error, the yielding areas, and the simulated gaps for comparison.
    const auto evaluate = [&](const PerssonTheory &with) {
      TheoryResult result;
      result.pressure     = pressure;
      result.contact_area = result.mean_gap = result.leak_rate = std::nan("");
      GapDistribution gaps;
      if (pressure > 0)
        {
          const PerssonState state = with.solve(pressure);
          result.mean_gap          = state.mean_gap;
          result.contact_area      = state.contact_area;
          gaps                     = with.distribution(state, -2 * slip_length);
          if (shows_gaps)
            result.persson_gaps =
              with.distribution(state, 0., with.bins_per_decade() / bins_shown);
        }
      if (scene.theory.simulated_gaps)
        gaps = gap_histogram(*gap, n_decades, with.bins_per_decade(), -2 * slip_length);
      if (scene.theory.simulated_gaps || pressure > 0)
        result.leak_rate =
          conductance_of_box(scene) *
          effective_cubed_gap(
            gaps, 1 / (1 - critical_fraction(scene, with, slip_length, threshold)));
      return result;
    };
    TheoryResult       result = evaluate(persson);
    const TheoryResult other  = evaluate(coarse);
    result.error              = relative_difference(result.leak_rate, other.leak_rate);
    if (scene.contact.yields)
      result.yielding = pressure > 0
                          ? persson.contact_areas(pressure, scene.contact.hardness)
                          : YieldingAreas{std::nan(""), std::nan("")};
    if (pressure > 0)
      result.error =
        std::max(result.error, relative_difference(result.mean_gap, other.mean_gap));
    // Over the bins of the theory, if it has some.
    if (gap != nullptr && shows_gaps)
      result.simulated_gaps = result.persson_gaps
                                ? gap_histogram(*gap, result.persson_gaps->edges)
                                : gap_histogram(*gap, n_decades, bins_shown);
    return result;
  }
} // namespace strait
