// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/scene.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "temporary_folder.h"

using namespace strait;

namespace
{
  /** A scene file that exists on all ranks as long as this object does. */
  class SceneFile
  {
  public:
    explicit SceneFile(const std::string &text)
      : folder(temporary.path())
      , path(folder + "/a.prm")
    {
      run_on_root(MPI_COMM_WORLD, [&]() { std::ofstream(path) << text; });
    }

  private:
    const test::TemporaryFolder temporary;

  public:
    const std::string folder, path;
  };

  Scene
  scene_of(const std::string &text, const Overrides &overrides = {})
  {
    const SceneFile file(text);
    return read_scene(file.path, overrides);
  }

  /** The message of the error, without the folder of the file. */
  std::string
  error_of(const std::string &text, const Overrides &overrides = {})
  {
    const SceneFile file(text);
    try
      {
        read_scene(file.path, overrides);
      }
    catch (const InputError &error)
      {
        std::string message = error.what();
        if (message.compare(0, file.folder.size(), file.folder) == 0)
          message.erase(0, file.folder.size() + 1);
        return message;
      }
    return "none";
  }

  void
  expect_in(const std::string &part, const std::string &text)
  {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' not in: " << text;
  }
} // namespace

TEST(Scene, DefaultsOfAnEmptyFileAreThoseOfTheStructs)
{
  const Scene scene = scene_of("");
  const Scene standard;
  EXPECT_EQ(scene.surface.kind, standard.surface.kind);
  EXPECT_EQ(scene.surface.size, standard.surface.size);
  EXPECT_EQ(scene.surface.seed, standard.surface.seed);
  EXPECT_EQ(scene.surface.hurst_exponent, standard.surface.hurst_exponent);
  EXPECT_EQ(scene.surface.roll_off_wavelength, standard.surface.roll_off_wavelength);
  EXPECT_EQ(scene.surface.short_cut_off_wavelength,
            standard.surface.short_cut_off_wavelength);
  EXPECT_EQ(scene.surface.rms_value, standard.surface.rms_value);
  EXPECT_EQ(scene.surface.amplitude, standard.surface.amplitude);
  EXPECT_EQ(scene.contact.enabled, standard.contact.enabled);
  EXPECT_EQ(scene.contact.grid_points, standard.contact.grid_points);
  EXPECT_EQ(scene.contact.effective_modulus, standard.contact.effective_modulus);
  EXPECT_EQ(scene.contact.method, standard.contact.method);
  EXPECT_EQ(scene.contact.tolerance, standard.contact.tolerance);
  EXPECT_EQ(scene.contact.maximum_iterations, standard.contact.maximum_iterations);
  EXPECT_EQ(scene.fluid.enabled, standard.fluid.enabled);
  EXPECT_EQ(scene.fluid.viscosity, standard.fluid.viscosity);
  EXPECT_EQ(scene.fluid.inlet_pressure, standard.fluid.inlet_pressure);
  EXPECT_EQ(scene.fluid.outlet_pressure, standard.fluid.outlet_pressure);
  EXPECT_EQ(scene.fluid.slip_lengths, standard.fluid.slip_lengths);
  EXPECT_EQ(scene.fluid.element_degree, standard.fluid.element_degree);
  EXPECT_EQ(scene.fluid.target_accuracy, standard.fluid.target_accuracy);
  EXPECT_EQ(scene.fluid.maximum_unknowns, standard.fluid.maximum_unknowns);
  EXPECT_EQ(scene.programme.pressures, standard.programme.pressures);
  EXPECT_EQ(scene.output.directory, standard.output.directory);
  EXPECT_EQ(scene.output.fields, standard.output.fields);
  EXPECT_EQ(scene.output.pictures, standard.output.pictures);
}

TEST(Scene, EveryParameterArrives)
{
  const Scene scene = scene_of(R"(
subsection Surface
  set Kind = honeycomb peaks
  set Size = 3, 1.5
  set Seed = 7
  set Hurst exponent = 0.3
  set Roll-off wavelength = 0.25
  set Short cut-off wavelength = 0.125
  set Amplitudes = fixed
  set Normalisation = rms height
  set RMS value = 2
  set Amplitude = 0.5
  set Expression = sin(2*pi*x)
  set Invert = true
  set Rotate = true
end
subsection Contact
  set Grid points = 128, 64
  set Effective modulus = 4
  set Control = mean gap
  set Solver = polonsky-keer
  set Tolerance = 1e-6
  set Maximum iterations = 50
end
subsection Fluid
  set Viscosity = 0.5
  set Inlet pressure = 3
  set Outlet pressure = 2
  set Slip length = -0.1
  set Direction = y
  set Element degree = 2
  set Preconditioner = ml
  set Gap interpolation = bilinear
  set Refinement = uniform
  set Target accuracy = 0.5
  set Maximum unknowns = 1000
end
subsection Load programme
  set Pressures = 3, 2.5, 1e-1
end
subsection Output
  set Directory = somewhere
  set Fields = last
  set Pictures = false
end
)");
  EXPECT_EQ(scene.surface.kind, SurfaceKind::honeycomb_peaks);
  EXPECT_EQ(scene.surface.size, (std::array<double, 2>{{3., 1.5}}));
  EXPECT_EQ(scene.surface.seed, 7u);
  EXPECT_EQ(scene.surface.hurst_exponent, 0.3);
  EXPECT_EQ(scene.surface.roll_off_wavelength, 0.25);
  EXPECT_EQ(scene.surface.short_cut_off_wavelength, 0.125);
  EXPECT_EQ(scene.surface.amplitudes, Amplitudes::fixed);
  EXPECT_EQ(scene.surface.normalisation, Normalisation::rms_height);
  EXPECT_EQ(scene.surface.rms_value, 2.);
  EXPECT_EQ(scene.surface.amplitude, 0.5);
  EXPECT_EQ(scene.surface.expression, "sin(2*pi*x)");
  EXPECT_TRUE(scene.surface.invert);
  EXPECT_TRUE(scene.surface.rotate);
  EXPECT_EQ(scene.contact.grid_points, (std::array<int, 2>{{128, 64}}));
  EXPECT_EQ(scene.contact.effective_modulus, 4.);
  EXPECT_EQ(scene.contact.control, ContactControl::mean_gap);
  EXPECT_EQ(scene.contact.method, ContactMethod::polonsky_keer);
  EXPECT_EQ(scene.contact.tolerance, 1e-6);
  EXPECT_EQ(scene.contact.maximum_iterations, 50);
  EXPECT_EQ(scene.fluid.viscosity, 0.5);
  EXPECT_EQ(scene.fluid.inlet_pressure, 3.);
  EXPECT_EQ(scene.fluid.outlet_pressure, 2.);
  EXPECT_EQ(scene.fluid.slip_lengths, std::vector<double>{-0.1});
  EXPECT_EQ(scene.fluid.direction, FlowDirection::y);
  EXPECT_EQ(scene.fluid.element_degree, 2u);
  EXPECT_EQ(scene.fluid.preconditioner, FlowPreconditioner::ml);
  EXPECT_EQ(scene.fluid.interpolation, GapInterpolation::bilinear);
  EXPECT_EQ(scene.fluid.refinement, Refinement::uniform);
  EXPECT_EQ(scene.fluid.target_accuracy, 0.5);
  EXPECT_EQ(scene.fluid.maximum_unknowns, 1000u);
  EXPECT_EQ(scene.programme.pressures, (std::vector<double>{3., 2.5, 0.1}));
  EXPECT_EQ(scene.output.directory, "somewhere");
  EXPECT_EQ(scene.output.fields, FieldOutput::last);
  EXPECT_FALSE(scene.output.pictures);
}

TEST(Scene, OneNumberStandsForBothDirections)
{
  const Scene scene = scene_of(
    "subsection Surface\n set Size = 2\nend\n"
    "subsection Contact\n set Grid points = 96\nend\n");
  EXPECT_EQ(scene.surface.size, (std::array<double, 2>{{2., 2.}}));
  EXPECT_EQ(scene.contact.grid_points, (std::array<int, 2>{{96, 96}}));
}

TEST(Scene, OverridesWinAndTheResolvedTextGivesTheSameScene)
{
  const Scene scene =
    scene_of("subsection Fluid\n set Viscosity = 2\nend\n",
             {"Fluid/Viscosity=3", "Fluid/Viscosity = 4", "Surface/Kind=flat"});
  EXPECT_EQ(scene.fluid.viscosity, 4.);
  EXPECT_EQ(scene.surface.kind, SurfaceKind::flat);
  const Scene again = scene_of(scene.resolved);
  EXPECT_EQ(again.fluid.viscosity, 4.);
  EXPECT_EQ(again.surface.kind, SurfaceKind::flat);
  EXPECT_EQ(again.resolved, scene.resolved);
}

TEST(Scene, PathOfAMapCountsFromTheSceneOrTheCurrentFolder)
{
  const SceneFile file(
    "subsection Surface\n set Kind = file\n set File = d/m.txt\nend\n");
  EXPECT_EQ(read_scene(file.path).surface.map.file, file.folder + "/d/m.txt");
  const Scene scene = read_scene(file.path, {"Surface/File=m.npy"});
  EXPECT_EQ(scene.surface.map.file, (std::filesystem::current_path() / "m.npy").string());
  EXPECT_EQ(read_scene(file.path, {"Surface/File=/m.npy"}).surface.map.file, "/m.npy");
}

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
  expect_in("needs a simulation",
            error_of(alone,
                     {"Theory/Enabled=true", "Theory/Gap distribution=simulated"}));
  expect_in("needs Surface/Kind = self-affine", error_with("Surface/Kind=square saddle"));
  expect_in("Find threshold = true",
            error_with("Theory/Dimension parameter=from threshold"));
  expect_in("there is none; take simulated", error_with("Contact/Enabled=false"));
  expect_in("must lie between 0 and 1", error_with("Theory/Critical contact fraction=1"));
  expect_in("at most 1", error_with("Theory/Gamma=0"));
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
  expect_in("must lie between 0 and 1",
            error_of(text, {"Load programme/Reduced loads=0.1, 1"}));
  expect_in("needs the critical load",
            error_of(text,
                     {"Load programme/Find threshold=false",
                      "Load programme/Pressures=1"}));
  expect_in("Contact/Control = load", error_of(text, {"Contact/Control=mean gap"}));
  expect_in("between 1e-9 and 0.1",
            error_of(text, {"Load programme/Threshold tolerance=1"}));
}

TEST(Scene, ValuesOfTheWrongKind)
{
  EXPECT_EQ(error_of("subsection Fluid\n set Viscosity = thick\nend\n"),
            "a.prm:2: 'thick' is no value for Fluid/Viscosity; expected a number.");
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
                            "Load programme/Pressures=",
                            "Load programme/Pressures=0.1, -0.1",
                            "Output/Directory="})
    {
      const std::string error = error_of("", {wrong});
      EXPECT_NE(error, "none") << wrong;
      // One sentence that names the section.
      EXPECT_EQ(error.substr(0, error.find('/')),
                std::string(wrong).substr(0, std::string(wrong).find('/')))
        << error;
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
}

TEST(Scene, PrintedParametersAreAScene)
{
  std::ostringstream prm;
  print_parameters(prm, "prm");
  EXPECT_EQ(scene_of(prm.str()).resolved, scene_of("").resolved);
}

TEST(Scene, MarkdownListsEveryParameterWithItsMeaning)
{
  std::ostringstream md;
  print_parameters(md, "md");
  expect_in("## Load programme\n", md.str());
  expect_in("| Viscosity | `1` | a number | eta: dynamic viscosity", md.str());
  expect_in("| Direction | `x` | one of: x, y |", md.str());
  // Numbers without a unit would be of no use.
  std::istringstream lines(md.str());
  int                numbers = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.find("| a number |") != std::string::npos)
      {
        ++numbers;
        EXPECT_NE(line.find('['), std::string::npos) << line;
      }
  EXPECT_GT(numbers, 10);
  EXPECT_THROW(print_parameters(md, "xml"), InputError);
}
