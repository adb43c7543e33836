// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/interface/rarefied_gas.h>
#include <strait/run/step.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "scene_text.h"
#include "window_tools.h"

namespace
{
  using namespace strait;
  using test::error_of, test::expect_in, test::scene_of, test::operator+;

  const Overrides in_si  = {"Units/Length=m",
                            "Units/Pressure=Pa",
                            "Units/Time=s",
                            "Surface/Size=1e-4",
                            "Surface/Kind=flat"};
  const Overrides helium = {"Fluid/State=gas", "Fluid/Gas=helium"};

  /** A fluid that presses on the walls. */
  const Overrides pressed = in_si + Overrides{"Contact/Effective modulus=1e11",
                                              "Fluid/Inlet pressure=1e6",
                                              "Fluid/Wall feedback/Enabled=true"};

  /** A step with a uniform contact pressure, and a path with the same gap throughout. */
  Step
  step_at(const double pressure, const double contact_area, const double gap)
  {
    const SlabLayoutPtr layout = make_layout({4, 4, 1., 1.}, MPI_COMM_WORLD);
    Step                step;
    step.number = 1;
    step.state.contact.emplace();
    step.state.contact->nominal_pressure = pressure;
    step.state.contact->contact_area     = contact_area;
    step.state.contact->pressure         = SlabField(layout);
    for (double &value : step.state.contact->pressure)
      value = pressure;
    step.state.contact->gap = SlabField(layout);
    step.flow.emplace();
    step.flow->channel.clusters.percolates = true;
    step.flow->channel.clusters.states.assign(step.state.contact->gap.size(),
                                              NodeState::percolating);
    step.flow->channel.throat.points = 10.;
    FlowPath path;
    path.points.resize(3);
    path.gaps           = {gap, gap, gap};
    path.resistances    = {0., .5, 1.};
    path.bottleneck_gap = gap;
    step.flow->channel.paths.push_back(path);
    return step;
  }

  std::string
  verdict(const Scene &scene, Step step, const double slope = .05)
  {
    std::ostringstream out;
    Log                log(MPI_COMM_WORLD, out, Log::Screen::plain);
    judge_validity(step, scene, slope, log);
    for (const ValidityCheck &check : step.checks)
      EXPECT_EQ(out.str().find("warning: " + check.word + ": ") != std::string::npos,
                !check.holds() && !out.str().empty())
        << check.word;
    return step.validity();
  }

  /** The product, in the units of the scene [length pressure]. */
  double
  mean_free_path_times_pressure(const Scene &scene)
  {
    return RarefiedGas(scene.fluid).knudsen_number(1., 1.);
  }

  TEST(Validity, MeanFreePathOfGases)
  {
    const Scene he = scene_of("", in_si + helium);
    EXPECT_NEAR(mean_free_path_times_pressure(he), 0.019169, 1e-6);
    EXPECT_EQ(he.fluid.viscosity, 19.6e-6);
    EXPECT_NEAR(mean_free_path_times_pressure(
                  scene_of("", in_si + Overrides{"Fluid/State=gas", "Fluid/Gas=air"})),
                0.006592,
                1e-6);
    EXPECT_NEAR(mean_free_path_times_pressure(scene_of(
                  "", in_si + Overrides{"Fluid/State=gas", "Fluid/Gas=nitrogen"})),
                0.006499,
                1e-6);
    // In mm, MPa and minutes: mm MPa is 1e3 m Pa.
    const Scene mm = scene_of("",
                              helium + Overrides{"Units/Length=mm",
                                                 "Units/Pressure=MPa",
                                                 "Units/Time=min",
                                                 "Surface/Size=0.1",
                                                 "Surface/Kind=flat"});
    EXPECT_NEAR(mean_free_path_times_pressure(mm), 0.019169e-3, 1e-9);
    EXPECT_DOUBLE_EQ(mm.fluid.viscosity, 19.6e-12 / 60);
  }

  TEST(Validity, GasesThatContradictThemselves)
  {
    expect_in("State = gas", error_of("", {"Fluid/Gas=air"}));
    expect_in("State = gas", error_of("", {"Fluid/Molar mass=0.03"}));
    expect_in("remove one", error_of("", helium + Overrides{"Fluid/Molar mass=0.03"}));
    expect_in("at the temperature",
              error_of("", in_si + helium + Overrides{"Fluid/Temperature=400"}));
    EXPECT_EQ(scene_of("",
                       in_si + helium +
                         Overrides{"Fluid/Temperature=400", "Fluid/Viscosity=2e-5"})
                .fluid.viscosity,
              2e-5);
    for (const Overrides &units : {Overrides{}, Overrides{"Units/Length=mm"}})
      {
        expect_in("section Units", error_of("", units + helium));
        expect_in(
          "section Units",
          error_of("", units + Overrides{"Fluid/State=gas", "Fluid/Molar mass=0.03"}));
      }
    expect_in("helium, air, nitrogen", error_of("", {"Fluid/Gas=phlogiston"}));
  }

  // Against a vacuum, the squared pressure falls linearly with the resistance r, and
  // ∫ dr/√(1−r) = 2: the mean Knudsen number is twice that at the inlet.
  TEST(Validity, KnudsenNumbersAlongAPath)
  {
    const Scene scene =
      scene_of("", in_si + helium + Overrides{"Fluid/Inlet pressure=1e5"});
    Step       step         = step_at(1., .1, 1e-6);
    FlowPath  &path         = step.flow->channel.paths.front();
    const auto expect_check = [&](const std::string &word, const double number) {
      Log log(MPI_COMM_WORLD, true);
      judge_validity(step, scene, .05, log);
      for (const ValidityCheck &check : step.checks)
        if (check.word == word)
          {
            EXPECT_NEAR(check.number, number, 1e-4);
            return;
          }
      FAIL() << word;
    };
    expect_check("rarefied", 2 * .19169);
    // The last of equal gaps is at the outlet, in a vacuum. The gas is therefore taken
    // half a step before it, after three quarters of the resistance.
    expect_check("rarefied-throat", .19169 / std::sqrt(.25));
    path.gaps.front() = path.bottleneck_gap = .5e-6;
    expect_check("rarefied-throat", .19169 / .5 / std::sqrt(.75));
    path.gaps.back() = path.bottleneck_gap = .5e-6;
    expect_check("rarefied-throat", .19169 / .5 / std::sqrt(.25));
  }

  TEST(Validity, EachWordWhereItsLimitIsPassed)
  {
    const Overrides metal = in_si + Overrides{"Contact/Effective modulus=1e11"};
    const Overrides with_suction =
      metal + Overrides{"Fluid/Inlet pressure=0", "Fluid/Outlet pressure=-1"};
    const Overrides water = metal + Overrides{"Fluid/Inlet pressure=1e5"};
    EXPECT_EQ(verdict(scene_of("", water), step_at(1.01e6, .1, 1e-6)), "ok");
    EXPECT_EQ(verdict(scene_of("", water), step_at(.99e6, .1, 1e-6)), "fluid-pressure");
    EXPECT_EQ(verdict(scene_of("", water), step_at(-1e6, .1, 1e-6)), "fluid-pressure");
    EXPECT_EQ(verdict(scene_of("", with_suction), step_at(11., .1, 1e-6)), "ok");
    EXPECT_EQ(verdict(scene_of("", with_suction), step_at(9., .1, 1e-6)),
              "fluid-pressure");
    EXPECT_EQ(verdict(scene_of("", with_suction), step_at(0., .1, 1e-6)),
              "fluid-pressure");
    EXPECT_EQ(verdict(scene_of("", water), step_at(2e9, .1, 1e-6)), "large-strain");
    EXPECT_EQ(verdict(scene_of("", water), step_at(2e9, .1, 1e-6), .31),
              "large-strain+steep");
    const Overrides hard = water + Overrides{"Contact/Hardness=1e9"};
    EXPECT_EQ(verdict(scene_of("", hard), step_at(4.9e7, .1, 1e-6)), "ok");
    EXPECT_EQ(verdict(scene_of("", hard), step_at(5.1e7, .1, 1e-6)), "plastic");
    // With adhesion, the solid bears the reaction of the wall less the attraction.
    Step adhesive                                         = step_at(5.1e7, .1, 1e-6);
    adhesive.state.contact->adhesion.emplace().attraction = 2e7;
    EXPECT_EQ(verdict(scene_of("", hard), adhesive), "ok");
    const Overrides yields =
      hard + Overrides{"Contact/Yielding=cut-off", "Load programme/Pressures=1e6"};
    EXPECT_EQ(verdict(scene_of("", yields), step_at(5.1e7, .1, 1e-6)), "ok");
    // 2γ/g is the pressure difference, 1e5 Pa, at g = 1.44 µm.
    const Overrides wet = water + Overrides{"Fluid/Surface tension=0.072"};
    EXPECT_EQ(verdict(scene_of("", wet), step_at(2e6, .1, 1.45e-6)), "ok");
    EXPECT_EQ(verdict(scene_of("", wet), step_at(2e6, .1, 1.43e-6)), "capillary");
    const Overrides gas = water + helium;
    EXPECT_EQ(verdict(scene_of("", gas), step_at(2e6, .1, 39e-6)), "ok");
    EXPECT_EQ(verdict(scene_of("", gas), step_at(2e6, .1, 37e-6)),
              "rarefied+rarefied-throat");
    Step narrow_first = step_at(2e6, .1, 37e-6);
    narrow_first.flow->channel.paths[0].gaps[0] -= 1e-12;
    EXPECT_EQ(verdict(scene_of("", gas), narrow_first), "rarefied");
    const Overrides slip = gas + Overrides{"Fluid/Rarefaction=slip"};
    EXPECT_EQ(verdict(scene_of("", slip), step_at(2e6, .1, 4e-6)), "ok");
    EXPECT_EQ(verdict(scene_of("", slip), step_at(2e6, .1, 3.5e-6)),
              "rarefied+rarefied-throat");
    Step solved                  = step_at(2e6, .1, 4e-6);
    solved.flow->leakage.knudsen = .11;
    EXPECT_EQ(verdict(scene_of("", slip), solved), "rarefied-throat");
    const Overrides any = gas + Overrides{"Fluid/Rarefaction=transitional"};
    EXPECT_EQ(verdict(scene_of("", any), step_at(2e6, .1, 1e-9)), "ok");
    Step coarse                        = step_at(2e6, .1, 1e-6);
    coarse.flow->channel.throat.points = 2.9;
    EXPECT_EQ(verdict(scene_of("", water), coarse), "coarse-throat");
  }

  TEST(Validity, AdvisesWhatTheSceneMayHave)
  {
    const auto advice = [](const Overrides &more) {
      Step        step                 = step_at(5e7, .1, 1e-6);
      const Scene scene                = scene_of("",
                                   in_si +
                                     Overrides{"Contact/Effective modulus=1e11",
                                               "Contact/Hardness=6e8",
                                               "Fluid/Inlet pressure=1e7",
                                               "Load programme/Pressures=5e7"} +
                                     more);
      step.flow->channel.throat.points = 2.;
      std::ostringstream out;
      Log                log(MPI_COMM_WORLD, out, Log::Screen::plain);
      judge_validity(step, scene, 0., log);
      std::string all;
      for (const ValidityCheck &check : step.checks)
        all += check.advice + "\n";
      return all;
    };
    const std::string excluded = ", which this scene excludes: Contact/";
    for (const std::string effect :
         {"Contact/Yielding", "Fluid/Wall feedback", "Contact/Zoom"})
      for (const std::string two_boxes : {"false", "true"})
        expect_in("switch on " + effect + "\n",
                  advice({"Seal/Two in a row=" + two_boxes}));
    const std::string zoomed = advice({"Contact/Zoom/Enabled=true"});
    expect_in("Contact/Yielding" + excluded, zoomed);
    expect_in("switch on Fluid/Wall feedback\n", zoomed);
    expect_in("raise Contact/Grid points\n", zoomed);
    const std::string yielding = advice({"Contact/Yielding=cut-off"});
    expect_in("Fluid/Wall feedback" + excluded, yielding);
    EXPECT_EQ(yielding.find("switch Fluid/Wall feedback off"), std::string::npos)
      << "the opposite advice: " << yielding;
    expect_in("raise Contact/Grid points\n", yielding);
    const std::string pressed = advice({"Fluid/Wall feedback/Enabled=true"});
    expect_in("switch on Contact/Zoom\n", pressed);
    expect_in("knows such a bound", advice({"Contact/Solver=polonsky-keer"}));
  }

  TEST(Validity, TrappedFluidWithFeedback)
  {
    const Scene scene = scene_of("", pressed);
    Step        step  = step_at(1e7, .1, 1e-6);
    step.state.fluid.emplace();
    EXPECT_EQ(verdict(scene, step), "ok");
    for (NodeState &state : step.flow->channel.clusters.states)
      state = NodeState::trapped;
    EXPECT_EQ(verdict(scene, step), "trapped-fluid");
    // For a gas, its absolute pressure counts, even if both reservoirs have the same.
    const Scene gas =
      scene_of("", pressed + helium + Overrides{"Fluid/Outlet pressure=1e6"});
    expect_in("trapped-fluid", verdict(gas, step));
    step.state.contact->nominal_pressure = 1.01e8;
    EXPECT_EQ(verdict(scene, step), "ok");
  }

  // It does not count by points: windows have more, and every rank holds those.
  TEST(Validity, FluidThatIsTrappedInWindowsCountsByItsAreaParallel)
  {
    const Scene scene = scene_of("", pressed);
    Step        step  = step_at(1e7, .1, 1e-6);
    step.state.fluid.emplace();
    step.state.contact->gap =
      SlabField(window_tests::layout_with(32, {window_tests::window_at(8, 8, 12, 12)}));
    step.flow->channel.clusters.states.assign(step.state.contact->gap.size(),
                                              NodeState::trapped);
    Log silent(MPI_COMM_WORLD, true);
    judge_validity(step, scene, .05, silent);
    const auto &check =
      *std::find_if(step.checks.begin(), step.checks.end(), [](const auto &each) {
        return each.word == "trapped-fluid";
      });
    EXPECT_NEAR(check.number, .1, 1e-12);
  }

  // In reduced units, neither the slope nor a pressure difference of 1 means anything.
  TEST(Validity, ReducedUnits)
  {
    EXPECT_EQ(verdict(scene_of(""), step_at(.1, .1, 1.), 1.), "ok");
    EXPECT_EQ(verdict(scene_of("", {"Fluid/Inlet pressure=0.05"}), step_at(.1, .1, 1.)),
              "fluid-pressure");
  }

  TEST(Validity, NothingIsClaimedOfWhatIsNotThere)
  {
    const Scene scene =
      scene_of("", in_si + helium + Overrides{"Contact/Effective modulus=1e11"});
    Step sealed = step_at(2e6, .1, 1e-6);
    sealed.flow->channel.paths.clear();
    EXPECT_EQ(verdict(scene, sealed), "ok");
    Step untouched = step_at(0., 0., 1e-6);
    untouched.flow.reset();
    EXPECT_EQ(verdict(scene, untouched), "ok");
  }

  TEST(Validity, RecordHasEveryNumber)
  {
    const Scene        scene = scene_of("", in_si);
    Step               step  = step_at(1e-3, .1, 1.);
    std::ostringstream out;
    Log                log(MPI_COMM_WORLD, out, Log::Screen::plain);
    judge_validity(step, scene, .5, log);
    const auto check_of = [&step](const std::string &word) {
      return *std::find_if(step.checks.begin(),
                           step.checks.end(),
                           [&word](const ValidityCheck &check) {
                             return check.word == word;
                           });
    };
    EXPECT_EQ(check_of("steep").number, .5);
    EXPECT_EQ(check_of("steep").limit, .3);
    EXPECT_FALSE(check_of("steep").is_lower_limit || check_of("steep").holds());
    expect_in("the rms slope", check_of("steep").advice);
    EXPECT_TRUE(check_of("coarse-throat").is_lower_limit);
    EXPECT_EQ(check_of("coarse-throat").limit, 3.);
  }

  TEST(Words, AreJoinedOnce)
  {
    std::string all = "ok";
    add_words(all, "ok");
    EXPECT_EQ(all, "ok");
    add_words(all, "a+b");
    add_words(all, "b+c");
    add_words(all, "ok");
    EXPECT_EQ(all, "a+b+c");
  }
} // namespace
