// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/interface/rarefied_gas.h>
#include <strait/run/step.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    // doc/validity.md lists these limits as well, with their sources and with what half
    // and double of each do.

    // Fluid pressure over load. It raises the critical load of a square saddle by 6 % at
    // this ratio, by 3 % at half of it and by 13 % at double.
    constexpr double most_fluid_pressure = .1;

    // Mean contact pressure over hardness H. At small loads elastic contact pressures p
    // have the density ∝ p exp(−p²/2s²) with the mean s √(π/2), so that they exceed H on
    // the fraction exp(−π/4 (H/mean)²) of the contact: 4 % at this ratio of the mean to
    // H, 3e-6 at half of it, 46 % at double.
    constexpr double most_of_hardness = .5;

    // Mean contact pressure over E*, if no hardness is known: few solids bear strains of
    // a tenth elastically, and those that do are no longer linear.
    constexpr double most_of_modulus = .1;

    // RMS slope. Half-space and Reynolds' equation are both of first order in the slope:
    // what they leave out is of the order of its square, here 9 %; 2 % at half of it,
    // 36 % at double.
    constexpr double most_slope = .3;

    // Slip at the walls adds about 6 Kn to the flow between plates, here 6 %.
    constexpr double most_knudsen = .01;

    // First-order slip falls short of kinetic theory by 4 % between plates at this
    // Knudsen number, by 1 % at half of it and 8 % at double.
    constexpr double most_knudsen_with_slip = .1;

    // Fraction of the load that is uncertain because of trapped fluid; leak rates change
    // by several times as much.
    constexpr double most_trapped_load = .01;

    /** Return the ratio of a fluid @p pressure to the load; infinite under tension. */
    double
    part_of_load(const Step &step, const double pressure)
    {
      const double load = std::max(step.state.contact->nominal_pressure, 0.);
      return pressure > 0. ? pressure / load : 0.;
    }

    /** Return the advice @p what if the scene allows @p change. If not, return it with
     *  the reason, or nothing unless it is the only advice. The advice that ends such a
     *  reason, after a semicolon, would be the opposite one. */
    template <typename Change>
    std::string
    advice_to(const char *what, Scene scene, const Change &change, bool is_only = true)
    {
      change(scene);
      // Patches of a seal do without this if they must.
      scene.seal.two_in_a_row = false;
      try
        {
          scene.check();
          return what;
        }
      catch (const InputError &error)
        {
          const std::string reason = error.what();
          return is_only ? std::string(what) + ", which this scene excludes: " +
                             reason.substr(0, reason.rfind(';'))
                         : "";
        }
    }

    // One function for each mechanism that the model leaves out. Those for gas, meniscus
    // and grid are for steps with a path of least resistance.

    void
    add_slope(Step &step, const Scene &scene, const double rms_slope)
    {
      if (scene.has_physical_modulus())
        step.checks.push_back(
          {"steep",
           rms_slope,
           most_slope,
           format("the rms slope of the surface is %.3g, and small slopes are assumed",
                  rms_slope)});
    }

    void
    add_contact_pressure(Step &step, const Scene &scene)
    {
      double      in_contact = std::nan("");
      const auto &contact    = step.state.contact;
      if (scene.contact.yields)
        return;
      if (contact && !contact->pressure.empty() && contact->contact_area > 0.)
        // With adhesion the wall's reaction exceeds the solid's by the attraction there.
        in_contact = mean(contact->pressure) / contact->contact_area -
                     (contact->adhesion ? contact->adhesion->attraction : 0.);
      else if (!contact && step.theory && step.theory->contact_area > 0.)
        in_contact = step.theory->pressure / step.theory->contact_area;
      if (std::isnan(in_contact)) // no contact, or no state to show
        return;
      const double of_hardness = in_contact / scene.contact.hardness;
      const double of_modulus  = in_contact / scene.contact.effective_modulus;
      if (scene.contact.hardness > 0.)
        step.checks.push_back(
          {"plastic",
           of_hardness,
           most_of_hardness,
           format("the mean pressure in contact is %.3g of Contact/Hardness, so that "
                  "asperities flow: there is more contact and less leakage than in the "
                  "elastic contact that is computed; ",
                  of_hardness) +
             advice_to("switch on Contact/Yielding", scene, [](Scene &other) {
               other.contact.yields = true;
             })});
      else if (scene.has_physical_modulus())
        step.checks.push_back(
          {"large-strain",
           of_modulus,
           most_of_modulus,
           format("the mean pressure in contact is %.3g of the effective modulus, where "
                  "few solids are linearly elastic; give Contact/Hardness if yield "
                  "decides",
                  of_modulus)});
    }

    void
    add_fluid_pressure(Step &step, const Scene &scene)
    {
      const FluidParameters &fluid = scene.fluid;
      const bool is_meant = scene.has_physical_modulus() || fluid.excess_pressure() != 1.;
      if (!step.flow || !step.state.contact || fluid.feedback.enabled || !is_meant)
        return;
      // Pressures of a liquid are relative to that outside of the seal.
      const double suction =
        fluid.is_gas ? 0. : -std::min(fluid.inlet_pressure, fluid.outlet_pressure);
      const bool   pulls = suction > fluid.excess_pressure();
      const double number =
        part_of_load(step, std::max(suction, fluid.excess_pressure()));
      step.checks.push_back(
        {"fluid-pressure",
         number,
         most_fluid_pressure,
         format("the fluid's %s is %s and %s, so that %s leaks: ",
                pulls ? "suction" : "pressure",
                (std::isinf(number) ? "without a load against it"
                                    : format("%.3g of the nominal pressure", number))
                  .c_str(),
                pulls ? "pulls the walls together" : "presses the walls apart",
                pulls ? "less" : "more") +
           advice_to("switch on Fluid/Wall feedback", scene, [](Scene &other) {
             other.fluid.feedback.enabled = true;
           })});
    }

    void
    add_meniscus(Step &step, const Scene &scene)
    {
      const FluidParameters &fluid = scene.fluid;
      if (fluid.surface_tension == 0. || fluid.is_gas)
        return;
      const double throat = step.flow->channel.paths.front().bottleneck_gap;
      const double number = 2. * fluid.surface_tension / throat /
                            std::abs(fluid.inlet_pressure - fluid.outlet_pressure);
      step.checks.push_back(
        {"capillary",
         number,
         1., // from here on a meniscus in the throat withstands the pressure
         format("the pressure across a meniscus in the throat is %.3g of the one that "
                "drives the flow: a liquid that has to enter a dry throat, or to leave "
                "it, may not leak at all",
                number)});
    }

    void
    add_grid(Step &step, const Scene &scene)
    {
      if (!scene.contact.enabled)
        return;
      // fmin ignores a number of points across that is not known.
      const Throat &throat = step.flow->channel.throat;
      const double  points = std::fmin(throat.points, throat.points_across);
      step.checks.push_back(
        {"coarse-throat",
         points,
         least_points_along_throat,
         (points > 0.
            ? format("there are %.2g grid points along or across the throat", points)
            : std::string(
                "the grid points do not tell how the gap grows along the throat")) +
           ", so that the contact grid's error may exceed that of the bracket: raise "
           "Contact/Grid points" +
           (scene.contact.zoom.enabled
              ? ""
              : advice_to(
                  ", or switch on Contact/Zoom",
                  scene,
                  [](Scene &other) { other.contact.zoom.enabled = true; },
                  false)),
         true});
    }

    /** Return the mean free path over the gap along @p path of a gas in viscous flow,
     *  whose squared pressure falls in proportion to ∫ ds/gap³: the mean over this
     *  resistance, and the value where the gap is smallest. */
    std::pair<double, double>
    knudsen_numbers(const FlowPath &path, const Scene &scene)
    {
      // Mean free path times pressure, which depends on the temperature only.
      const double constant    = RarefiedGas(scene.fluid).knudsen_number(1., 1.);
      const double inlet       = scene.fluid.inlet_pressure;
      const double outlet      = scene.fluid.outlet_pressure;
      const auto   pressure_at = [inlet, outlet](const double part) { // of the resistance
        return std::sqrt((1. - part) * inlet * inlet + part * outlet * outlet);
      };
      const auto pressure = [&](const std::size_t k) {
        return pressure_at(path.resistances[k] / path.resistance());
      };
      // The mean of λ/g over the resistance r is Σ c/g ∫ dr/p with
      // dr/p = −2 dp/(p_in² − p_out²).
      double mean = 0.;
      for (std::size_t k = 1; k < path.gaps.size(); ++k)
        mean += .5 * constant * (1. / path.gaps[k - 1] + 1. / path.gaps[k]) * 2. *
                (pressure(k - 1) - pressure(k)) / (inlet * inlet - outlet * outlet);
      return {mean,
              constant / (path.bottleneck_gap * pressure_at(path.part_before_throat()))};
    }

    void
    add_gas(Step &step, const Scene &scene)
    {
      const bool slips = scene.fluid.rarefaction == Rarefaction::slip;
      if (!scene.fluid.is_gas || scene.fluid.molar_mass == 0. ||
          scene.fluid.rarefaction == Rarefaction::transitional)
        return;
      const std::string remedy =
        advice_to("set Fluid/Rarefaction = transitional", scene, [](Scene &other) {
          other.fluid.rarefaction = Rarefaction::transitional;
        });
      const auto advice = [&](const char *place, const double number) {
        const std::string known = format("the Knudsen number %s is %.3g", place, number);
        if (slips)
          return known + ", where slip of first order is no longer enough: " + remedy;
        return known +
               format(
                 ": the gas slips along the walls and leaks faster, there by a factor "
                 "of about %.3g or more: ",
                 1. + 6. * number) +
               remedy;
      };
      const auto [mean, viscous] =
        knudsen_numbers(step.flow->channel.paths.front(), scene);
      // The flow solver knows the pressure at the throat of a gas that slips.
      const double solved    = step.flow->leakage.knudsen;
      const double at_throat = std::isnan(solved) ? viscous : solved;
      const double most      = slips ? most_knudsen_with_slip : most_knudsen;
      step.checks.push_back(
        {"rarefied", mean, most, advice("of the mean resistance", mean)});
      step.checks.push_back(
        {"rarefied-throat", at_throat, most, advice("in the throat", at_throat)});
    }

    /** The fraction of the box where fluid is trapped. Collective. */
    double
    trapped_area(const std::vector<NodeState> &states, const SlabLayoutPtr &layout)
    {
      SlabField is_trapped(layout);
      for (std::size_t k = 0; k < states.size(); ++k)
        is_trapped[k] = states[k] == NodeState::trapped ? 1. : 0.;
      return mean(is_trapped);
    }

    void
    add_trapped_fluid(Step &step, const Scene &scene)
    {
      if (!step.flow || !step.state.fluid || step.state.fluid->lifted_off)
        return;
      const auto  &trapped = step.state.fluid->trapped;
      const double area    = trapped ? trapped->guessed_area
                                     : trapped_area(step.flow->channel.clusters.states,
                                                 step.state.gap().layout_pointer());
      const double reservoirs =
        std::max(scene.fluid.inlet_pressure, scene.fluid.outlet_pressure);
      const double guessed = part_of_load(step, area * reservoirs);
      const double by_step = trapped ? part_of_load(step, trapped->uncertainty) : 0.;
      step.checks.push_back(
        {"trapped-fluid",
         std::max(guessed, by_step),
         most_trapped_load,
         guessed < by_step
           ? format("%.2g of the load hangs on when in this step fluid was cut off: "
                    "take shorter steps of Load programme/Pressures",
                    by_step)
           : format(
               "fluid of unknown pressure is trapped on %.2g %% of the area, which at "
               "the pressure of the reservoirs would carry %.2g of the load: compare "
               "runs with Fluid/Wall feedback/Pool pressure from 0 to that pressure",
               100. * area,
               guessed)});
    }
  } // namespace

  void
  judge_validity(Step &step, const Scene &scene, const double rms_slope, Log &log)
  {
    step.checks.clear();
    add_fluid_pressure(step, scene);
    add_contact_pressure(step, scene);
    add_slope(step, scene, rms_slope);
    // There is no path if nothing leaks, or nothing limits the leak.
    if (step.flow && !step.flow->channel.paths.empty())
      {
        add_gas(step, scene);
        add_meniscus(step, scene);
        add_grid(step, scene);
      }
    add_trapped_fluid(step, scene);
    for (const ValidityCheck &check : step.checks)
      {
        // Numbers differ from step to step: warn only the first time.
        const std::string start = check.word + ": ";
        const auto       &told  = log.warnings();
        const bool        is_new =
          std::none_of(told.begin(), told.end(), [&start](const std::string &warning) {
            return warning.compare(0, start.size(), start) == 0;
          });
        if (!check.holds() && is_new)
          log.warn(start + check.advice + format(" (step %d)", step.number));
      }
  }
} // namespace strait
