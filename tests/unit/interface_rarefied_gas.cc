// SPDX-License-Identifier: GPL-2.0-or-later
// Flow of gases between plates, from viscous to molecular, and bounds of the flow through
// networks of channels.
#include <strait/interface/rarefied_flow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "helium.h"

namespace strait
{
  namespace
  {
    TEST(RarefiedGas, SolutionOfTheBgkEquation)
    {
      const double table[][2] = {{.01, 3.0497},
                                 {.02, 2.7111},
                                 {.05, 2.3023},
                                 {.1, 2.0327},
                                 {.2, 1.8082},
                                 {.5, 1.6019},
                                 {1., 1.5387},
                                 {2., 1.5949},
                                 {5., 1.9908},
                                 {10., 2.7686}};
      for (const auto &[delta, value] : table)
        EXPECT_NEAR(RarefiedGas::poiseuille_coefficient(delta), value, 7e-5) << delta;
    }

    // Fits of Fukui and Kaneko (1990) for walls that reflect diffusely.
    double
    fukui_kaneko(const double d)
    {
      if (d >= 5.)
        return d / 6. + 1.0162 + 1.0653 / d - 2.1354 / (d * d);
      if (d >= .15)
        return .13852 * d + 1.25087 + .15653 / d - .00969 / (d * d);
      return -2.22919 * d + 2.10673 + .01653 / d - .0000694 / (d * d);
    }

    TEST(RarefiedGas, FitsOfOthersAgree)
    {
      for (double delta = .01; delta < 1000.; delta *= 1.05)
        EXPECT_NEAR(RarefiedGas::poiseuille_coefficient(delta) / fukui_kaneko(delta),
                    1.,
                    8e-3)
          << delta;
    }

    TEST(RarefiedGas, AsymptotesContinueTheTable)
    {
      for (const double end : {std::exp2(-13.), std::exp2(4.5)})
        EXPECT_NEAR(RarefiedGas::poiseuille_coefficient(end * (1 + 1e-9)) /
                      RarefiedGas::poiseuille_coefficient(end * (1 - 1e-9)),
                    1.,
                    3e-6);
      // In molecular flow, as from the iteration of the integral equation.
      EXPECT_NEAR(RarefiedGas::poiseuille_coefficient(1e-12) +
                    std::log(1e-12) / std::sqrt(M_PI),
                  1.5 * (1. - .5772156649) / std::sqrt(M_PI),
                  1e-9);
      // Solutions of the integral equation by Galerkin's method without differences.
      EXPECT_NEAR(RarefiedGas::poiseuille_coefficient(1e-5), 6.853742, 1e-5);
      EXPECT_NEAR(RarefiedGas::poiseuille_coefficient(std::exp2(-13.)), 5.445318, 1e-5);
      // At δ = 1000 slip of first order gives the same mobility.
      const FluidParameters slipping = helium(Rarefaction::slip);
      const double          p        = 1e3 * slipping.viscosity * slipping.thermal_speed;
      EXPECT_NEAR(RarefiedGas(helium(Rarefaction::transitional)).mobility(1., p) /
                    RarefiedGas(slipping).mobility(1., p),
                  1.,
                  1e-5);
      EXPECT_DOUBLE_EQ(RarefiedGas(helium(Rarefaction::none)).mobility(1., 3.), 3.);
    }

    // Throughput of a channel, 10 mm wide and 1 mm long, from 2 to 1 bar: in closed form
    // for viscous flow and slip, from the fits above for transitional flow. At 1 bar the
    // mean free path is 191.69 nm.
    TEST(RarefiedGas, PlatesWithHelium)
    {
      const auto throughput = [](const FluidParameters &fluid, const double gap) {
        return gap * gap * gap / (12. * fluid.viscosity) * 10. *
               RarefiedGas(fluid).drive(gap, 1e5, 2e5);
      };
      EXPECT_NEAR(throughput(helium(Rarefaction::none), 1e-6) / 6.378e-4, 1., 1e-4);
      EXPECT_NEAR(throughput(slipping_helium(), 1e-6) / 1.1268e-3, 1., 1e-4);
      EXPECT_NEAR(throughput(helium(Rarefaction::slip), 1e-6) / 1.1985e-3, 1., 1e-4);
      EXPECT_NEAR(throughput(helium(Rarefaction::transitional), 1e-6) / 1.259e-3,
                  1.,
                  7e-3);
      EXPECT_NEAR(throughput(helium(Rarefaction::none), 1e-7) / 6.378e-7, 1., 1e-4);
      EXPECT_NEAR(throughput(slipping_helium(), 1e-7) / 5.528e-6, 1., 1e-4);
      EXPECT_NEAR(throughput(helium(Rarefaction::slip), 1e-7) / 6.245e-6, 1., 1e-4);
      EXPECT_NEAR(throughput(helium(Rarefaction::transitional), 1e-7) / 8.602e-6,
                  1.,
                  7e-3);
      EXPECT_NEAR(RarefiedGas(helium(Rarefaction::slip)).knudsen_number(1e-6, 1e5),
                  .19169,
                  1e-5);
    }

    TEST(RarefiedFlow, PressureInvertsItsPotential)
    {
      for (const Rarefaction kind : {Rarefaction::slip, Rarefaction::transitional})
        for (const double inlet : {2e5, 1e4})
          {
            FluidParameters fluid = helium(kind);
            fluid.inlet_pressure  = inlet;
            fluid.outlet_pressure = 2.1e5 - inlet - 1e4 * (inlet > 1e5);
            const RarefiedFlow flow(fluid, {{1e-7, 1.}});
            const double       low = fluid.outlet_pressure, high = fluid.inlet_pressure;
            for (double p = 0.; p <= 2e5; p += 1e4)
              if (p >= std::min(low, high) && p <= std::max(low, high))
                {
                  const double potential =
                    flow.gas.drive(1e-7, low, p) / flow.gas.drive(1e-7, low, high);
                  EXPECT_NEAR(flow.pressure(potential), p, 1e-6 * 2e5);
                }
          }
    }

    // The pressures may differ by rounding only, or not at all.
    TEST(RarefiedFlow, PressuresThatHardlyDiffer)
    {
      for (const Rarefaction kind : {Rarefaction::slip, Rarefaction::transitional})
        for (const double outlet : {2e5 * (1. - 1e-13), 2e5})
          {
            const RarefiedFlow flow(helium(kind, outlet), {{.5e-7, 1.}, {1e-7, 1.}});
            EXPECT_NEAR(flow.pressure(.5), 2e5, 1e-6);
            EXPECT_NEAR(flow.least_weight(1e-7) / flow.largest_weight(1e-7), 1., 1e-4);
          }
    }

    /** A channel, or several networks in series or in parallel. */
    struct Network
    {
      double               gap        = 0.;
      double               resistance = 0.; // of a channel: ∫ ds/gap³ over its width
      bool                 in_a_row   = false;
      std::vector<Network> parts;

      /** Return the conductance, times 12 η, where the conductivity of a channel is
       *  @p factor of its gap times the viscous one. */
      template <typename Factor>
      double
      conductance(const Factor &factor) const
      {
        if (parts.empty())
          return factor(gap) / resistance;
        double sum = 0.;
        for (const Network &part : parts)
          sum += in_a_row ? 1. / part.conductance(factor) : part.conductance(factor);
        return in_a_row ? 1. / sum : sum;
      }

      /** Return the throughput of a gas between the pressures @p low and @p high, times
       *  12 η. */
      double
      throughput(const RarefiedGas &gas, const double low, const double high) const
      {
        if (parts.empty())
          return gas.drive(gap, low, high) / resistance;
        double sum = 0.;
        if (!in_a_row)
          {
            for (const Network &part : parts)
              sum += part.throughput(gas, low, high);
            return sum;
          }
        // Find the pressure between the two parts, of which the first is at the higher
        // pressure, by regula falsi (Illinois).
        const auto surplus = [&](const double middle) {
          return parts[0].throughput(gas, middle, high) -
                 parts[1].throughput(gas, low, middle);
        };
        double a = low, b = high, at_a = surplus(a), at_b = surplus(b), middle = a;
        for (int round = 0; round < 40 && b - a > 1e-9 * high; ++round)
          {
            middle          = (a * at_b - b * at_a) / (at_b - at_a);
            const double at = surplus(middle);
            if (at > 0.)
              {
                a    = middle;
                at_a = at;
                at_b *= .5;
              }
            else
              {
                b    = middle;
                at_b = at;
                at_a *= .5;
              }
          }
        return parts[1].throughput(gas, low, middle);
      }

      /** Return the channels along the path of least resistance, sorted by gap. */
      std::vector<PathPart>
      path() const
      {
        if (parts.empty())
          return {{gap, resistance}};
        std::vector<PathPart> all, best;
        double                least = 0.;
        for (const Network &part : parts)
          {
            const std::vector<PathPart> other = part.path();
            double                      sum   = 0.;
            for (const PathPart &each : other)
              sum += each.resistance;
            if (best.empty() || sum < least)
              {
                best  = other;
                least = sum;
              }
            all.insert(all.end(), other.begin(), other.end());
          }
        std::vector<PathPart> &result = in_a_row ? all : best;
        std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
          return a.gap < b.gap;
        });
        return result;
      }
    };

    Network
    random_network(std::mt19937 &random, const int depth)
    {
      const auto number = [&](const double low, const double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
      };
      Network network;
      if (depth == 0 || number(0., 1.) < .15)
        {
          network.gap = 1e-7 * std::exp(number(-2., 2.));
          network.resistance =
            std::exp(number(-1., 1.)) / std::pow(network.gap / 1e-7, 3);
          return network;
        }
      network.in_a_row = number(0., 1.) < .6;
      for (int k = 0; k < 2; ++k)
        network.parts.push_back(random_network(random, depth - 1));
      return network;
    }

    // The bounds hold in any network, although they are chosen for a single path: that of
    // least resistance, which makes them close.
    TEST(RarefiedFlow, BoundsOfRandomNetworks)
    {
      std::mt19937 random(1);
      double       widths = 0., widest = 0.;
      int          n_closer = 0;
      for (int n = 0; n < 200; ++n)
        {
          FluidParameters fluid =
            n % 2 == 0 ? slipping_helium() : helium(Rarefaction::transitional);
          fluid.inlet_pressure       = 1e5 * std::exp(random() % 5 - 2.);
          fluid.outlet_pressure      = n % 4 < 2 ? 0. : .3 * fluid.inlet_pressure;
          const Network      network = random_network(random, n % 5 == 0 ? 3 : 2);
          const RarefiedFlow flow(fluid, network.path());
          const double       exact =
            network.throughput(flow.gas, fluid.outlet_pressure, fluid.inlet_pressure) /
            fluid.mean_pressure();
          const double lower = flow.drive() * network.conductance(flow.least_weight);
          const double upper = flow.drive() * network.conductance(flow.largest_weight);
          EXPECT_LE(lower, exact) << n;
          EXPECT_GE(upper, exact) << n;
          ASSERT_EQ(flow.molecular_weight.has_value(), n % 2 == 0);
          if (flow.molecular_weight)
            {
              const GapFactor one(1e-7, [](double) { return 1.; });
              const double    viscous   = network.conductance(one);
              const double    molecular = network.conductance(*flow.molecular_weight);
              const double    of_two    = flow.two_gas_lower_bound(viscous, molecular);
              EXPECT_LE(of_two, exact) << n;
              n_closer += of_two > lower ? 1 : 0;
              // The bound is no less than what one of the two gases leaks alone plus θ
              // times what the other one does.
              const double p_in = fluid.inlet_pressure, p_out = fluid.outlet_pressure;
              const double theta =
                8. / 9. * std::pow(std::pow(p_in, 1.5) - std::pow(p_out, 1.5), 2) /
                ((p_in - p_out) * (p_in * p_in - p_out * p_out));
              const double r = flow.gas.mobility(1e-7, 0.) /
                               (*flow.molecular_weight)(1e-7); // at the reference gap
              const double of_viscous = (p_in - p_out) * viscous;
              const double of_molecular =
                (p_in - p_out) * r * molecular / fluid.mean_pressure();
              EXPECT_GE(of_two * 1.0001,
                        std::max(of_viscous + theta * of_molecular,
                                 theta * of_viscous + of_molecular));
            }
          widths += (upper - lower) / upper / 200.;
          widest = std::max(widest, (upper - lower) / upper);
        }
      EXPECT_LT(widths, .02);
      EXPECT_LT(widest, .2);
      EXPECT_GT(n_closer, 10);
    }

    // Channels in series attain the bounds: the upper one with the wide channel at the
    // inlet, the lower one with the narrow channel there. Expected numbers: closed form.
    TEST(RarefiedFlow, ChannelsInARowForwardAndBackward)
    {
      const FluidParameters fluid = slipping_helium();
      const Network         wide{1e-6, .125e2 / 1e-18, false, {}};
      const Network         narrow{.2e-6, .001e2 / 8e-21, false, {}};
      const Network         forward{0., 0., true, {wide, narrow}},
        backward{0., 0., true, {narrow, wide}};
      const RarefiedFlow flow(fluid, {{.2e-6, 1.}, {1e-6, 1.}});
      const double       unit  = 12. * fluid.viscosity;
      const double       most  = forward.throughput(flow.gas, 0., 2e5) / unit;
      const double       least = backward.throughput(flow.gas, 0., 2e5) / unit;
      EXPECT_NEAR(most / 1.181399e-5, 1., 1e-5);
      EXPECT_NEAR(least / 1.052064e-5, 1., 1e-5);
      EXPECT_NEAR(most / least, 1.12293, 1e-4);
      const double drive = flow.drive() * fluid.mean_pressure() / unit;
      EXPECT_NEAR(drive * forward.conductance(flow.largest_weight) / most, 1., 1e-3);
      EXPECT_NEAR(drive * forward.conductance(flow.least_weight) / least, 1., 1e-3);
    }
  } // namespace
} // namespace strait
