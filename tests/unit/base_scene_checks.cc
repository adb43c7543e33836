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
  EXPECT_EQ(error_of("set Surface/Seed = 5\n"),
            "a.prm:1: unknown parameter 'Surface/Seed' outside every subsection; did you "
            "mean 'set Seed' in 'subsection Surface'?");
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
  EXPECT_EQ(warnings_of({"Seal/Contact width=2", "Seal/Wanted leak rate=1"}),
            std::vector<std::string>{"without Seal/Enabled = true these have no effect: "
                                     "Contact width, Wanted leak rate"});
  EXPECT_EQ(warnings_of({"Surface/Detrend=tilt"}).size(), 1U);
  EXPECT_EQ(warnings_of({"Surface/Kind=flat", "Surface/RMS value=1e-3"}),
            std::vector<std::string>{
              "without Surface/Kind = self-affine these have no effect: RMS value"});
  EXPECT_TRUE(
    warnings_of({"Contact/Zoom/Enabled=true", "Contact/Zoom/Maximum levels=2"}).empty());
  const std::string loose = "Load programme/Threshold tolerance=1e-3";
  EXPECT_EQ(warnings_of({loose}),
            std::vector<std::string>{
              "without Load programme/Find threshold = true or Load programme/Find "
              "blow-out = true these have no effect: Threshold tolerance"});
  EXPECT_TRUE(warnings_of({loose, "Load programme/Find threshold=true"}).empty());
  EXPECT_TRUE(
    warnings_of(
      {loose, "Load programme/Find blow-out=true", "Fluid/Wall feedback/Enabled=true"})
      .empty());
  for (const auto &[given, needed] :
       {std::pair{"Load programme/Jump tolerance=.1", "Contact/Adhesion/Enabled = true"},
        std::pair{"Fluid/Wall feedback/Bulk modulus=2",
                  "Fluid/Wall feedback/Enabled = true"},
        std::pair{"Surface/Window width=.2", "Surface/Kind = file"},
        std::pair{"Realisations/Ranks each=2",
                  "Realisations/Seeds or Realisations/Orientations"}})
    EXPECT_EQ(warnings_of({given}).at(0).find(std::string("without ") + needed), 0U);
  // The scene file that a run writes states every default, which causes no warnings.
  const Overrides dry = {"Fluid/Enabled=false", "Fluid/Viscosity=2"};
  EXPECT_EQ(warnings_of(dry),
            std::vector<std::string>{
              "without Fluid/Enabled = true or Theory/Enabled = true these have no "
              "effect: Viscosity"});
  EXPECT_TRUE(scene_of(scene_of("", {dry[0]}).resolved, {}).warnings().empty());
  EXPECT_TRUE(
    warnings_of({dry[0], dry[1], "Contact/Enabled=false", "Theory/Enabled=true"})
      .empty());
  EXPECT_EQ(
    warnings_of({dry[0],
                 "Contact/Enabled=false",
                 "Theory/Enabled=true",
                 "Fluid/Bounds=rigorous",
                 "Surface/Seed=7"}),
    (std::vector<std::string>{
      "without Contact/Enabled = true or Fluid/Enabled = true or Theory/Spectrum = "
      "surface these have no effect: Seed",
      "without Fluid/Enabled = true these have no effect: Bounds"}));
  // A given gap has no elastic body, whose modulus would tell physical units.
  const Overrides given = {"Contact/Enabled=false", "Contact/Effective modulus=3"};
  EXPECT_EQ(warnings_of(given),
            std::vector<std::string>{
              "without Contact/Enabled = true or Theory/Enabled = true these have no "
              "effect: Effective modulus"});
  EXPECT_FALSE(scene_of("", given).has_physical_modulus());
  EXPECT_TRUE(scene_of("", {given[1]}).has_physical_modulus());
  expect_in("Surface/Kind is no file", error_of("", {"Surface/File=/a/map.nc"}));
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
  expect_in("remove the copy",
            error_of(text, {"Load programme/Reduced loads=0.1, 0.05, 0.1"}));
  expect_in("needs the critical load",
            error_of(text,
                     {"Load programme/Find threshold=false",
                      "Load programme/Pressures=1"}));
  expect_in("Contact/Control = load", error_of(text, {"Contact/Control=mean gap"}));
  expect_in("a surface that is not flat", error_of(text, {"Surface/Kind=flat"}));
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
                            "Fluid/Viscosity=1e-400",
                            "Load programme/Pressures=0.1; 0.2"})
    expect_in("is no value for", error_of("", {wrong}));
  expect_in("an integer from 0 to 2147483647", error_of("", {"Surface/Seed=4294967296"}));
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
                            "Output/Leak rate units=ml/h, ml/h",
                            "Realisations/Orientations=",
                            "Load programme/Largest reduced load of fits=2",
                            "Load programme/Pressures=",
                            "Load programme/Pressures=0.1, -0.1",
                            "Output/Directory="})
    {
      const std::string error = error_of("", {wrong});
      EXPECT_NE(error, "none") << wrong;
      // The message is one sentence that names the parameter.
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
  // Other kinds of surface ignore the parameters of the spectrum.
  EXPECT_EQ(error_of("", {"Surface/Kind=flat", "Surface/Roll-off wavelength=9"}), "none");
  // A pure flow problem ignores the loads.
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

TEST(Scene, TheTheoryAloneHasNoSurfaceToWrite)
{
  const Overrides alone = {"Theory/Enabled=true",
                           "Contact/Enabled=false",
                           "Fluid/Enabled=false"};
  EXPECT_TRUE(scene_of("", alone).warnings().empty());
  for (const char *output : {"Output/Surface map=true", "Output/Surface spectrum=true"})
    {
      Overrides wanted = alone;
      wanted.emplace_back(output);
      const auto warnings = scene_of("", wanted).warnings();
      ASSERT_EQ(warnings.size(), 1u) << output;
      expect_in("the theory alone writes neither", warnings[0]);
    }
}

TEST(Scene, TheTheoryAloneIsOfViscousFlow)
{
  const auto warnings = scene_of("",
                                 {"Theory/Enabled=true",
                                  "Contact/Enabled=false",
                                  "Fluid/Enabled=false",
                                  "Fluid/State=gas",
                                  "Fluid/Molar mass=0.004",
                                  "Fluid/Rarefaction=slip",
                                  "Fluid/Viscosity=2e-5",
                                  "Fluid/Inlet pressure=2e5",
                                  "Contact/Effective modulus=1e7",
                                  "Units/Length=mm",
                                  "Units/Pressure=Pa",
                                  "Units/Time=s",
                                  "Surface/Size=1"})
                          .warnings();
  ASSERT_EQ(warnings.size(), 1u);
  expect_in("the theory knows nothing of Fluid/Rarefaction", warnings[0]);
}

TEST(Scene, TheTheoryAloneTakesNumbersInUnits)
{
  const Overrides units = {"Theory/Enabled=true",
                           "Contact/Enabled=false",
                           "Fluid/Enabled=false",
                           "Units/Length=mm",
                           "Units/Pressure=MPa",
                           "Units/Time=s",
                           "Surface/Size=1"};
  EXPECT_EQ(scene_of("", units).warnings().size(), 3u);
  const auto warnings =
    scene_of("", units + Overrides{"Contact/Effective modulus=2", "Fluid/Viscosity=1"})
      .warnings();
  ASSERT_EQ(warnings.size(), 1u);
  expect_in("Fluid/Inlet pressure is not given", warnings[0]);
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
