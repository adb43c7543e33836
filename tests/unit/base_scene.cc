// SPDX-License-Identifier: GPL-2.0-or-later
#include <filesystem>
#include <sstream>

#include "scene_text.h"

using namespace strait;
using test::error_of, test::expect_in, test::scene_of, test::SceneFile;

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
  EXPECT_TRUE(scene.surface.rms_is_of_height);
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
  EXPECT_TRUE(scene.fluid.uniform_refinement);
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
  const auto map_file = [&](const Overrides &overrides) {
    return parse_scene(read_entries(file.path, overrides)).surface.map.file;
  };
  EXPECT_EQ(map_file({}), file.folder + "/d/m.txt");
  EXPECT_EQ(map_file({"Surface/File=m.npy"}),
            (std::filesystem::current_path() / "m.npy").string());
  EXPECT_EQ(map_file({"Surface/File=/m.npy"}), "/m.npy");
}

// The scene that a run leaves behind must repeat it.
TEST(Scene, NoValueIsTakenThatASceneFileCannotState)
{
  for (const char *path : {"/maps/a#2.npy", "/maps/a\\"})
    expect_in("which a scene file cannot state",
              error_of("", {"Surface/Kind=file", std::string("Surface/File=") + path}));
  expect_in("Output/Directory = ", error_of("", {"Output/Directory=/results#1"}));
}

// The printed parameters are allowed values and read back as the default scene.
TEST(Scene, PrintedParametersAreAScene)
{
  std::ostringstream prm;
  print_parameters(prm, "prm");
  const Scene scene = scene_of(prm.str());
  EXPECT_EQ(scene.resolved, scene_of("").resolved);
  EXPECT_EQ(scene.contact.grid_points, Scene().contact.grid_points);
  EXPECT_EQ(scene.contact.tolerance, Scene().contact.tolerance);
  EXPECT_EQ(scene.fluid.maximum_unknowns, Scene().fluid.maximum_unknowns);
  EXPECT_EQ(scene.programme.pressures, Scene().programme.pressures);
}

TEST(Scene, MarkdownListsEveryParameterWithItsMeaning)
{
  std::ostringstream md;
  print_parameters(md, "md");
  expect_in("## Load programme\n", md.str());
  expect_in("| Viscosity | `1` | a number above 0 | eta: dynamic viscosity", md.str());
  expect_in("| Direction | `x` | one of: x, y |", md.str());
  expect_in("| Grid points | `512` | one or two integers from 4 to 65535, separated by",
            md.str());
  // The meaning of every number states its unit in brackets.
  std::istringstream lines(md.str());
  int                numbers = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.find("| a number") != std::string::npos)
      {
        ++numbers;
        EXPECT_NE(line.find('['), std::string::npos) << line;
      }
  EXPECT_GT(numbers, 10);
  EXPECT_THROW(print_parameters(md, "xml"), InputError);
}
