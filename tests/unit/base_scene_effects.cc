// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>

#include "scene_text.h"

using namespace strait;
using test::error_of, test::expect_in, test::scene_of, test::operator+;

TEST(Scene, FeedbackIsOfOneSlipLength)
{
  const Overrides feedback = {"Fluid/Wall feedback/Enabled=true"};
  scene_of("", feedback + Overrides{"Fluid/Slip length=-1e-3"});
  expect_in("one path of states",
            error_of("", feedback + Overrides{"Fluid/Slip length=0, -1e-3"}));
}

TEST(Scene, SeedsAreOfSurfacesThatDiffer)
{
  const Overrides seeds = {"Realisations/Seeds=1, 2"};
  scene_of("", seeds);
  expect_in("would be copies", error_of("", seeds + Overrides{"Surface/Kind=sine"}));
}

TEST(Scene, AnOrientationAloneIsARealisation)
{
  EXPECT_FALSE(scene_of("").realisations.enabled());
  EXPECT_FALSE(scene_of("", {"Realisations/Orientations=as is"}).realisations.enabled());
  EXPECT_TRUE(
    scene_of("", {"Realisations/Orientations=inverted"}).realisations.enabled());
}

TEST(Scene, MeshAndWhatGoesWithIt)
{
  EXPECT_TRUE(scene_of("").fluid.mesh_file.empty());
  const std::string mesh = "Fluid/Mesh=/seals/a.msh";
  EXPECT_EQ(scene_of("", {mesh}).fluid.mesh_file, "/seals/a.msh");
  for (const char *other : {"Fluid/Direction=y",
                            "Fluid/Bounds=rigorous",
                            "Fluid/Wall feedback/Enabled=true",
                            "Theory/Enabled=true",
                            "Output/Error budget=true"})
    expect_in("Fluid/Mesh", error_of("", {mesh, other}));
  expect_in(
    "Fluid/Mesh",
    error_of(
      "", {mesh, "Theory/Enabled=true", "Contact/Enabled=false", "Fluid/Enabled=false"}));
}

TEST(Scene, TrappedFluidNeedsWhatItsLawNeeds)
{
  const std::string feedback = "Fluid/Wall feedback/";
  const Overrides   enabled  = {feedback + "Enabled=true"};
  EXPECT_EQ(scene_of("", enabled).fluid.feedback.trapped_fluid, TrappedFluidLaw::drained);

  const Overrides gas = enabled + Overrides{feedback + "Trapped fluid=gas"};
  expect_in("needs absolute pressures", error_of("", gas));
  const Overrides is_gas = gas + Overrides{"Fluid/State=gas"};
  EXPECT_EQ(scene_of("", is_gas).fluid.feedback.trapped_fluid, TrappedFluidLaw::gas);
  for (const std::string law : {"incompressible", "compressible"})
    expect_in("set Trapped fluid = gas or drained",
              error_of("", is_gas + Overrides{feedback + "Trapped fluid=" + law}));
  expect_in("Pool pressure is negative",
            error_of("", is_gas + Overrides{feedback + "Pool pressure=-1"}));

  const Overrides liquid = enabled + Overrides{feedback + "Trapped fluid=compressible"};
  expect_in("needs Bulk modulus", error_of("", liquid));
  const Overrides stiff =
    liquid + Overrides{feedback + "Bulk modulus=2", feedback + "Bulk modulus slope=7"};
  EXPECT_EQ(scene_of("", stiff).fluid.feedback.bulk_modulus, 2.);
  const std::string vapour = feedback + "Vapour pressure=-1";
  expect_in("Bulk modulus is not positive", error_of("", stiff + Overrides{vapour}));
  for (const std::string pressure : {"Fluid/Wall feedback/Pool pressure=-.1",
                                     "Fluid/Inlet pressure=-.1",
                                     "Fluid/Outlet pressure=-.1"})
    {
      expect_in(
        "Vapour pressure is 0, but the least of Inlet, Outlet and Pool pressure "
        "-0.1",
        error_of("", stiff + Overrides{pressure}));
      const std::string law = feedback + "Trapped fluid=incompressible";
      scene_of("", enabled + Overrides{law, vapour, pressure});
      scene_of("", enabled + Overrides{pressure}); // drained: no fluid is trapped
    }
  // A drained fluid has no use for the bulk modulus.
  EXPECT_EQ(scene_of("", enabled + Overrides{feedback + "Bulk modulus=2"}).warnings(),
            std::vector<std::string>{"without Fluid/Wall feedback/Trapped fluid = "
                                     "compressible these have no effect: Bulk modulus"});
}

TEST(Scene, TheTemperatureOfAGasCountsInSccm)
{
  const Overrides gas             = {"Units/Length=m",
                                     "Surface/Size=1e-4",
                                     "Surface/Roll-off wavelength=5e-5",
                                     "Surface/Short cut-off wavelength=1e-5",
                                     "Units/Pressure=Pa",
                                     "Units/Time=s",
                                     "Contact/Effective modulus=1e9",
                                     "Fluid/State=gas",
                                     "Fluid/Viscosity=2e-5",
                                     "Fluid/Inlet pressure=2e5",
                                     "Fluid/Temperature=350"};
  const auto      says_it_is_idle = [](const Scene &scene) {
    const auto warnings = scene.warnings();
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string &warning) {
      return warning.find("Temperature") != std::string::npos;
    });
  };
  EXPECT_TRUE(says_it_is_idle(scene_of("", gas)));
  EXPECT_FALSE(
    says_it_is_idle(scene_of("", gas + Overrides{"Output/Leak rate units=sccm"})));
}

TEST(Scene, RealisationsOfAMapAreItsWindows)
{
  // With size, grid points and unit of length given, the map's file is not read.
  const Overrides map = {"Surface/Kind=file",
                         "Surface/File=/a/map.nc",
                         "Surface/Size=1",
                         "Contact/Grid points=64",
                         "Units/Length=m"};
  const Overrides two = map + Overrides{"Realisations/Seeds=1, 4"};
  expect_in("set Surface/Windows", error_of("", two));
  expect_in("numbered from 1 to 3",
            error_of("", two + Overrides{"Surface/Windows=3, 1"}));
  EXPECT_EQ(scene_of("", two + Overrides{"Surface/Windows=2"}).surface.map.windows[1], 2);
  expect_in("numbered from 1 to 4",
            error_of("", map + Overrides{"Surface/Windows=2", "Surface/Seed=0"}));
}

TEST(Scene, WholeSealAndWhatGoesWithIt)
{
  const Overrides seal = {"Seal/Enabled=true",
                          "Seal/Circumference=30",
                          "Seal/Contact width=4",
                          "Realisations/Seeds=1, 2"};
  EXPECT_FALSE(scene_of("").seal.enabled);
  EXPECT_TRUE(scene_of("", seal).has_two_boxes());
  EXPECT_TRUE(scene_of("", {"Seal/Two in a row=true"}).has_two_boxes());
  EXPECT_FALSE(scene_of("").has_two_boxes());
  EXPECT_FALSE(scene_of("", seal + Overrides{"Seal/Contact width=1.4"}).has_two_boxes());
  EXPECT_FALSE(scene_of("", seal + Overrides{"Fluid/Direction=y"}).has_two_boxes());
  expect_in("at least two patches",
            error_of("", seal + Overrides{"Realisations/Seeds="}));
  expect_in("set Seal/Circumference", error_of("", {"Seal/Enabled=true"}));
  expect_in("Contact/Control = load",
            error_of("", seal + Overrides{"Contact/Control=mean gap"}));
  expect_in("Seal/Two in a row needs",
            error_of("", {"Seal/Two in a row=true", "Fluid/Direction=y"}));
  // A keyword is not taken for a path, and an absolute path stays as it is.
  EXPECT_EQ(scene_of("", {"Seal/Pressure profile=hertz"}).seal.pressure_profile, "hertz");
  EXPECT_EQ(scene_of("", {"Seal/Pressure profile=/a/p.csv"}).seal.pressure_profile,
            "/a/p.csv");
}

TEST(Scene, YieldingAndWhatGoesWithIt)
{
  const Overrides hard       = {"Contact/Yielding=cut-off", "Contact/Hardness=1"};
  const auto      error_with = [&](const Overrides &more) {
    Overrides all = hard;
    all.insert(all.end(), more.begin(), more.end());
    return error_of("", all);
  };
  EXPECT_FALSE(scene_of("", {"Contact/Hardness=1"}).contact.yields);
  EXPECT_TRUE(scene_of("", hard).contact.yields);
  expect_in("set Contact/Hardness", error_of("", {"Contact/Yielding=cut-off"}));
  expect_in("switch Contact/Adhesion off",
            error_with({"Contact/Adhesion/Enabled=true",
                        "Contact/Adhesion/Surface energy=0.004",
                        "Contact/Adhesion/Range=0.02",
                        "Contact/Adhesion/Solver=GFMD"}));
  expect_in("set Contact/Solver = dual CG", error_with({"Contact/Solver=polonsky-keer"}));
  expect_in("set Contact/Control = load", error_with({"Contact/Control=mean gap"}));
  expect_in("switch Contact/Zoom off", error_with({"Contact/Zoom/Enabled=true"}));
  expect_in("switch Fluid/Wall feedback off",
            error_with({"Fluid/Wall feedback/Enabled=true"}));
  for (const char *pressures : {"0.1, 0.2", ""})
    expect_in("which must be the largest",
              error_with({"Load programme/Find threshold=true",
                          "Load programme/Path=unloading",
                          std::string("Load programme/Pressures=") + pressures}));
  for (const char *pressure : {"1", "2"})
    expect_in("cannot bear",
              error_with({std::string("Load programme/Pressures=0.1, ") + pressure}));
}

TEST(Scene, RarefactionAndWhatGoesWithIt)
{
  const Overrides helium = {"Fluid/State=gas",
                            "Fluid/Gas=helium",
                            "Units/Length=mm",
                            "Units/Pressure=Pa",
                            "Units/Time=s",
                            "Surface/Size=1"};
  const auto      with   = [&](const std::string &kind, const std::string &other) {
    Overrides all = helium;
    all.push_back("Fluid/Rarefaction=" + kind);
    all.push_back(other);
    return all;
  };
  const FluidParameters fluid =
    scene_of("", with("slip", "Fluid/Accommodation=0.9")).fluid;
  EXPECT_EQ(fluid.rarefaction, Rarefaction::slip);
  EXPECT_NEAR(fluid.thermal_speed, 1103.6e3, 50.); // mm/s
  for (const char *other :
       {"Fluid/Slip length=-1e-9", "Fluid/Wall feedback/Enabled=true"})
    expect_in("Fluid/Rarefaction", error_of("", with("slip", other)));
  expect_in("diffusely", error_of("", with("transitional", "Fluid/Accommodation=0.9")));
  for (const Overrides &unknown :
       {Overrides{"Fluid/Rarefaction=slip"},
        Overrides{"Fluid/Rarefaction=slip", "Fluid/State=gas"}})
    expect_in("molecules", error_of("", unknown));
}

TEST(Scene, BlowOutNeedsLoadsThatPress)
{
  expect_in("Find blow-out needs loads that press",
            error_of("",
                     {"Contact/Adhesion/Enabled=true",
                      "Contact/Adhesion/Surface energy=0.01",
                      "Contact/Adhesion/Tabor number=1",
                      "Fluid/Wall feedback/Enabled=true",
                      "Load programme/Find blow-out=true",
                      "Load programme/Pressures=0.1, 0"}));
}

TEST(Scene, ZoomNeedsRoomForWindows)
{
  expect_in("Grid points of 8 or more",
            error_of("", {"Contact/Zoom/Enabled=true", "Contact/Grid points=4, 32"}));
}

TEST(Scene, AdhesionAndYieldingAreOfAContact)
{
  expect_in("Contact/Enabled = false",
            error_of("",
                     {"Contact/Enabled=false",
                      "Contact/Yielding=cut-off",
                      "Contact/Hardness=1"}));
  expect_in("Contact/Enabled = false",
            error_of("",
                     {"Contact/Enabled=false",
                      "Contact/Adhesion/Enabled=true",
                      "Contact/Adhesion/Surface energy=0.01",
                      "Contact/Adhesion/Tabor number=1"}));
}

TEST(Scene, TheoryTellsWhatItLeavesOut)
{
  const auto n_warnings = [](const Overrides &overrides) {
    return scene_of("", overrides + Overrides{"Theory/Enabled=true"}).warnings().size();
  };
  EXPECT_EQ(n_warnings({}), 0U);
  EXPECT_EQ(n_warnings({"Fluid/Wall feedback/Enabled=true"}), 1U);
  EXPECT_EQ(n_warnings({"Contact/Adhesion/Enabled=true",
                        "Contact/Adhesion/Surface energy=0.01",
                        "Contact/Adhesion/Tabor number=1"}),
            1U);
  expect_in("a vacuum outside",
            scene_of("", {"Fluid/State=gas", "Fluid/Wall feedback/Enabled=true"})
              .warnings()
              .back());
}

TEST(Scene, Theory)
{
  const Overrides on    = {"Theory/Enabled=true"};
  const auto error_with = [&](const std::string &first, const std::string &second = "") {
    Overrides all = on;
    all.push_back(first);
    if (!second.empty())
      all.push_back(second);
    return error_of("", all);
  };
  EXPECT_TRUE(scene_of("", on).theory.enabled);
  const char *alone =
    "subsection Contact\n set Enabled = false\nend\n"
    "subsection Fluid\n set Enabled = false\nend\n";
  EXPECT_TRUE(scene_of(alone, on).theory.enabled);
  expect_in("nothing to compute", error_of(alone));
  expect_in("at which the theory has no contact",
            error_of(alone, {"Theory/Enabled=true", "Load programme/Pressures=0"}));
  expect_in("a model spectrum alone",
            error_of(alone, {"Theory/Enabled=true", "Realisations/Seeds=1, 2"}));
  expect_in("needs a simulation",
            error_of(alone,
                     {"Theory/Enabled=true", "Theory/Gap distribution=simulated"}));
  expect_in("needs Surface/Kind = self-affine", error_with("Surface/Kind=square saddle"));
  expect_in("Find threshold = true",
            error_with("Theory/Dimension parameter=from threshold"));
  expect_in("there is none; take simulated", error_with("Contact/Enabled=false"));
  expect_in("above 0 and below 1", error_with("Theory/Critical contact fraction=1"));
  expect_in("above 0 and at most 1", error_with("Theory/Gamma=0"));
}
