// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene_text.h"

using namespace strait;
using test::error_of, test::expect_in, test::scene_of, test::operator+;

TEST(Scene, UnknownNamesSuggestTheNearest)
{
  EXPECT_EQ(error_of("\nsubsection Surface\n set Hurst exponnent = 1\nend\n"),
            "a.prm:3: unknown parameter 'Hurst exponnent' in subsection 'Surface'; did "
            "you mean 'Hurst exponent'?");
  EXPECT_EQ(error_of("subsection Surfcae\nend\n"),
            "a.prm:1: unknown subsection 'Surfcae'; did you mean 'Surface'?");
  EXPECT_EQ(
    error_of("subsection Contact\n set Viscosity = 1\nend\n"),
    "a.prm:2: unknown parameter 'Viscosity' in subsection 'Contact'; did you mean "
    "'Fluid/Viscosity'?");
  EXPECT_EQ(
    error_of("set Viscosity = 1\n"),
    "a.prm:1: unknown parameter 'Viscosity' outside every subsection; did you mean "
    "'Fluid/Viscosity'?");
  expect_in("strait --parameters",
            error_of("subsection Fluid\n set Colour of the car = 1\nend\n"));
  expect_in("--set \"Fluid/Viscosty=1\": unknown parameter 'Viscosty'",
            error_of("", {"Fluid/Viscosty=1"}));
}

TEST(Scene, EffectsThatAreNotThereAreUnknown)
{
  for (const char *name : {"Contact/Friction/Enabled=true", "Fluid/Turbulence=true"})
    expect_in("unknown", error_of("", {name}));
}

TEST(Scene, ParametersWithoutEffectAreNamed)
{
  const auto warnings_of = [](const Overrides &overrides) {
    return scene_of("", overrides).warnings();
  };
  EXPECT_TRUE(warnings_of({}).empty());
  EXPECT_EQ(warnings_of({"Contact/Adhesion/Tabor number=1",
                         "Contact/Adhesion/Surface energy=2",
                         "Surface/Amplitude=1"}),
            std::vector<std::string>{"without Contact/Adhesion/Enabled = true these have "
                                     "no effect: Surface energy, Tabor number"});
  EXPECT_EQ(warnings_of({"Surface/Detrend=tilt"}).size(), 1U);
  EXPECT_EQ(warnings_of({"Surface/Kind=flat", "Surface/RMS value=1e-3"}),
            std::vector<std::string>{
              "without Surface/Kind = self-affine these have no effect: RMS value"});
  EXPECT_TRUE(
    warnings_of({"Contact/Zoom/Enabled=true", "Contact/Zoom/Maximum levels=2"}).empty());
  expect_in("Surface/Kind is no file", error_of("", {"Surface/File=/a/map.nc"}));
}

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
  expect_in("Pool pressure is negative",
            error_of("", is_gas + Overrides{feedback + "Pool pressure=-1"}));

  const Overrides liquid = enabled + Overrides{feedback + "Trapped fluid=compressible"};
  expect_in("needs Bulk modulus", error_of("", liquid));
  const Overrides stiff =
    liquid + Overrides{feedback + "Bulk modulus=2", feedback + "Bulk modulus slope=7"};
  EXPECT_EQ(scene_of("", stiff).fluid.feedback.bulk_modulus, 2.);
  for (const std::string pressure : {"Fluid/Wall feedback/Vapour pressure=-1",
                                     "Fluid/Wall feedback/Pool pressure=-1",
                                     "Fluid/Outlet pressure=-1"})
    expect_in("Bulk modulus is not positive", error_of("", stiff + Overrides{pressure}));
  // The law decides which parameters count.
  EXPECT_EQ(scene_of("", enabled + Overrides{feedback + "Bulk modulus=2"}).warnings(),
            std::vector<std::string>{"without Fluid/Wall feedback/Trapped fluid = "
                                     "compressible these have no effect: Bulk modulus"});
}

TEST(Scene, RealisationsOfAMapAreItsWindows)
{
  // What says its frame leaves the file unread.
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
  // A keyword is no path, and a path starts at the folder of the scene.
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
  const Overrides helium = {"Fluid/State=gas", "Fluid/Gas=helium"};
  const auto      with   = [&](const std::string &kind, const std::string &other) {
    Overrides all = helium;
    all.push_back("Fluid/Rarefaction=" + kind);
    all.push_back(other);
    return all;
  };
  const FluidParameters fluid =
    scene_of("", with("slip", "Fluid/Accommodation=0.9")).fluid;
  EXPECT_EQ(fluid.rarefaction, Rarefaction::slip);
  EXPECT_NEAR(fluid.thermal_speed, 1103.6, .05);
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

TEST(Scene, ThresholdAndReducedLoads)
{
  const char *text =
    "subsection Load programme\n"
    "  set Pressures =\n"
    "  set Find threshold = true\n"
    "  set Reduced loads = 0.1, 0.01\n"
    "  set Path = unloading\n"
    "end\n";
  const Scene scene = scene_of(text);
  EXPECT_TRUE(scene.programme.find_threshold);
  EXPECT_TRUE(scene.programme.pressures.empty());
  EXPECT_EQ(scene.programme.reduced_loads, (std::vector<double>{0.1, 0.01}));
  EXPECT_EQ(scene.programme.path, LoadPath::unloading);
  expect_in("above 0 and below 1",
            error_of(text, {"Load programme/Reduced loads=0.1, 1"}));
  expect_in("needs the critical load",
            error_of(text,
                     {"Load programme/Find threshold=false",
                      "Load programme/Pressures=1"}));
  expect_in("Contact/Control = load", error_of(text, {"Contact/Control=mean gap"}));
  expect_in("a number from 1e-09 to 0.1",
            error_of(text, {"Load programme/Threshold tolerance=1"}));
}

TEST(Scene, ValuesOfTheWrongKind)
{
  EXPECT_EQ(error_of("subsection Fluid\n set Viscosity = thick\nend\n"),
            "a.prm:2: 'thick' is no value for Fluid/Viscosity; expected a number above "
            "0.");
  EXPECT_EQ(error_of("subsection Fluid\n set Direction = z\nend\n"),
            "a.prm:2: 'z' is no value for Fluid/Direction; expected one of: x, y.");
  for (const char *wrong : {"Surface/Size=1, 2, 3",
                            "Surface/Size=",
                            "Surface/Size=1 2",
                            "Surface/Seed=-1",
                            "Surface/Seed=1.5",
                            "Surface/Invert=maybe",
                            "Surface/RMS value=nan",
                            "Contact/Grid points=1e3",
                            "Load programme/Pressures=0.1; 0.2"})
    expect_in("is no value for", error_of("", {wrong}));
}

TEST(Scene, ValuesOutOfRange)
{
  for (const char *wrong : {"Surface/Size=0",
                            "Surface/Size=1, -1",
                            "Surface/Hurst exponent=0",
                            "Surface/Hurst exponent=1.1",
                            "Surface/Roll-off wavelength=1.5",
                            "Surface/Short cut-off wavelength=0.5",
                            "Surface/Short cut-off wavelength=-0.5",
                            "Surface/RMS value=0",
                            "Contact/Grid points=3",
                            "Contact/Grid points=65536, 4",
                            "Contact/Effective modulus=0",
                            "Contact/Tolerance=0",
                            "Contact/Maximum iterations=0",
                            "Fluid/Viscosity=0",
                            "Fluid/Inlet pressure=0",
                            "Fluid/Slip length=0.1",
                            "Fluid/Element degree=0",
                            "Fluid/Target accuracy=1",
                            "Fluid/Maximum unknowns=-5",
                            "Fluid/Slip length=",
                            "Fluid/Slip length=0, 0",
                            "Fluid/Wall feedback/Relaxation=0",
                            "Contact/Poisson ratios=0.6",
                            "Surface/Window width=0.6",
                            "Units/Length=furlong",
                            "Output/Leak rate units=gallons",
                            "Realisations/Orientations=",
                            "Load programme/Largest reduced load of fits=2",
                            "Load programme/Pressures=",
                            "Load programme/Pressures=0.1, -0.1",
                            "Output/Directory="})
    {
      const std::string error = error_of("", {wrong});
      EXPECT_NE(error, "none") << wrong;
      // One sentence that names the parameter.
      expect_in(std::string(wrong).substr(0, std::string(wrong).find('=')), error);
      EXPECT_EQ(error.back(), '.') << error;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST(Scene, WhatAKindNeeds)
{
  expect_in("Surface/File", error_of("", {"Surface/Kind=file"}));
  expect_in("Surface/Expression", error_of("", {"Surface/Kind=expression"}));
  expect_in("Surface/Amplitude",
            error_of("", {"Surface/Kind=sine", "Surface/Amplitude=0"}));
  // The spectrum does not matter to other kinds.
  EXPECT_EQ(error_of("", {"Surface/Kind=flat", "Surface/Roll-off wavelength=9"}), "none");
  // A pure flow problem has no loads.
  EXPECT_EQ(error_of("", {"Contact/Enabled=false", "Load programme/Pressures=-1"}),
            "none");
  expect_in("nothing to compute",
            error_of("", {"Contact/Enabled=false", "Fluid/Enabled=false"}));
  EXPECT_EQ(error_of("", {"Fluid/Enabled=false", "Fluid/Inlet pressure=0"}), "none");
}

TEST(Scene, RollOffLongerThanTheShorterSideIsAWarning)
{
  EXPECT_TRUE(scene_of("").warnings().empty());
  EXPECT_EQ(scene_of("", {"Surface/Size=1, 0.4"}).warnings().size(), 1u);
}

TEST(Scene, UnreadableFiles)
{
  EXPECT_THROW(read_scene("/no/such/scene.prm"), InputError);
  EXPECT_THROW(read_scene("/"), InputError);
  EXPECT_THROW(read_scene(std::string(5000, 'a')), InputError);
}

TEST(Scene, MarkOfTheEncodingIsPassedOver)
{
  EXPECT_EQ(scene_of("\xef\xbb\xbfsubsection Surface\n set Seed = 7\nend\n").surface.seed,
            7U);
}
