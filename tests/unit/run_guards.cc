// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/log.h>
#include <strait/base/text.h>
#include <strait/run/guards.h>
#include <strait/run/output_directory.h>
#include <strait/run/simulation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>
#include <vector>

#include "scene_text.h"

namespace
{
  using namespace strait;
  using test::error_of, test::expect_in, test::scene_of, test::operator+;

  const Overrides steel = {"Units/Length=mm",
                           "Units/Pressure=GPa",
                           "Units/Time=s",
                           "Surface/Kind=flat",
                           "Surface/Size=0.1",
                           "Contact/Effective modulus=100",
                           "Fluid/Viscosity=1e-12",
                           "Fluid/Inlet pressure=1e-3",
                           "Load programme/Pressures=0.1"};

  /** The only warning of check_numbers() for a scene, or its error; else "none". */
  std::string
  finding(const Overrides &more)
  {
    const Scene scene = scene_of("", steel + more);
    try
      {
        Log log(MPI_COMM_WORLD, true);
        check_numbers(scene, log);
        EXPECT_LE(log.warnings().size(), 1U);
        return log.warnings().empty() ? "none" : log.warnings().front();
      }
    catch (const InputError &error)
      {
        return std::string("error: ") + error.what();
      }
  }

  TEST(Guards, NumbersOffByPowersOfTen)
  {
    EXPECT_EQ(finding({}), "none");
    expect_in("the effective modulus is 1e+14 Pa",
              finding({"Contact/Effective modulus=1e5"}));
    expect_in("Fluid/Viscosity is 1e+09 Pa s", finding({"Fluid/Viscosity=1"}));
    expect_in("Surface/Size is 1 m", finding({"Surface/Size=1000, 50"}));
    expect_in("Surface/Size is 1e-09 m", finding({"Surface/Size=1e-6, 50"}));
    // A modulus of 8 GPa is written as 8, although the unit is Pa.
    expect_in("error: The nominal pressure of 1e+06 Pa is more than",
              finding({"Units/Pressure=Pa",
                       "Contact/Effective modulus=8",
                       "Fluid/Viscosity=1e-3",
                       "Load programme/Pressures=1e6"}));
    Log log(MPI_COMM_WORLD, true);
    check_numbers(scene_of("", {"Contact/Effective modulus=1e25"}), log);
    EXPECT_TRUE(log.warnings().empty()) << "without units nothing is known";
  }

  TEST(Guards, FluidThatWouldLiftTheWalls)
  {
    EXPECT_EQ(finding({"Fluid/Inlet pressure=0.099"}), "none");
    expect_in("error: The fluid's pressure of 0.101 GPa exceeds the nominal pressure",
              finding({"Fluid/Inlet pressure=0.101"}));
    EXPECT_EQ(finding({"Fluid/Inlet pressure=0.101", "Fluid/Wall feedback/Enabled=true"}),
              "none");
    // The pressures of a gas are absolute: only their difference lifts the walls.
    EXPECT_EQ(finding({"Fluid/State=gas",
                       "Fluid/Inlet pressure=0.15",
                       "Fluid/Outlet pressure=0.1"}),
              "none");
  }

  TEST(Guards, SizeIsNeverGuessed)
  {
    expect_in("set Surface/Size", error_of("", {"Units/Length=m"}));
    EXPECT_EQ(error_of("", {"Units/Length=mm", "Surface/Size=1"}), "none");
  }

  TEST(Guards, ExtremeNumbers)
  {
    const test::SceneFile file("");
    const Overrides       small = {"Contact/Grid points=32",
                                   "Load programme/Pressures=0.05",
                                   "Surface/Short cut-off wavelength=0.125"};
    const std::regex      takes_numbers("\\b(number|integer)s?\\b");
    const std::regex      no_number("\\b(inf|nan)\\b");
    std::stringstream     reference;
    print_parameters(reference, "md");
    std::string section;
    int         n_tried = 0;
    for (std::string line; std::getline(reference, line);)
      {
        if (line.compare(0, 3, "## ") == 0)
          section = join(split(line.substr(3), '/'), "/");
        const std::vector<std::string> cells = split(line, '|'); // the first is empty
        if (cells.size() < 4 || !std::regex_search(cells[3], takes_numbers))
          continue;
        ++n_tried;
        for (const char *value : {"1e308", "-1e300", "1e30", "1e-30", "1e-300"})
          {
            const std::string  set = section + "/" + cells[1] + "=" + value;
            std::ostringstream said;
            try
              {
                const Scene scene = read_scene(file.path, small + Overrides{set});
                Log         log(MPI_COMM_WORLD, said, Log::Screen::plain);
                describe(scene, log);
              }
            catch (const InputError &error)
              {
                said << error.what();
                EXPECT_GT(said.str().size(), 10U) << set;
              }
            EXPECT_FALSE(std::regex_search(said.str(), no_number)) << set << said.str();
          }
      }
    EXPECT_GT(n_tried, 40);
  }

  TEST(Guards, Slopes)
  {
    const Scene scene = scene_of("", steel);
    Log         log(MPI_COMM_WORLD, true);
    check_slope(scene, 1., log);
    check_slope(scene_of(""), 5548., log); // reduced units
    EXPECT_TRUE(log.warnings().empty());
    check_slope(scene, 1.1, log);
    ASSERT_EQ(log.warnings().size(), 1U);
    expect_in("rms slope of 1.1", log.warnings().front());
    EXPECT_THROW(check_slope(scene, 5548., log), InputError);
  }

  TEST(Guards, MostMemoryIsThatOfTheLargestFields)
  {
    const double              before = peak_memory(MPI_COMM_SELF);
    const double              bytes  = before + 1e8; // more than the peak so far
    const std::vector<double> field(static_cast<std::size_t>(bytes / 8), 1.);
    EXPECT_NEAR(field.back(), 1., 0.);
    EXPECT_GT(peak_memory(MPI_COMM_SELF), bytes);
    EXPECT_LT(peak_memory(MPI_COMM_SELF), before + bytes + 2e7);
  }

  TEST(Guards, Memory)
  {
    Scene scene = scene_of("", {"Contact/Grid points=1024, 512"});
    // Measured: 64 B per point.
    EXPECT_NEAR(memory_of_grid(scene) / (1024 * 512), 64., 8.);
    // 92 to 100 B with the seals on every second and every fourth point.
    const Scene compared =
      scene_of("", {"Contact/Grid points=1024, 512", "Output/Error budget=true"});
    EXPECT_NEAR(memory_of_grid(compared) / (1024 * 512), 96., 8.);
    // 240 B with the pressures of a fluid that presses on the walls.
    const Scene pressed = scene_of("",
                                   {"Contact/Grid points=1024, 512",
                                    "Fluid/Wall feedback/Enabled=true",
                                    "Fluid/Inlet pressure=0.02"});
    EXPECT_NEAR(memory_of_grid(pressed) / (1024 * 512), 250., 20.);
    // A seal with several patches in a row needs the flow through two boxes as well.
    const Scene seal = scene_of("",
                                {"Contact/Grid points=1024, 512",
                                 "Seal/Enabled=true",
                                 "Seal/Circumference=30",
                                 "Seal/Contact width=4",
                                 "Realisations/Seeds=1, 2"});
    EXPECT_GT(memory_of_grid(seal), 1.9 * memory_of_grid(scene));
    EXPECT_GT(free_memory(), 1e6);
    ASSERT_LT(free_memory(), 4e11) << "this machine could do what follows";
    EXPECT_NO_THROW(require_memory(scene, MPI_COMM_WORLD));
    scene.contact.grid_points = {{65535, 65535}};
    try
      {
        require_memory(scene, MPI_COMM_WORLD);
        ADD_FAILURE() << "accepted";
      }
    catch (const InputError &error)
      {
        expect_in("65535 x 65535", error.what());
      }
    // One such grid fits into memory; 100000 of them at the same time do not.
    scene.contact.grid_points = {{1024, 512}};
    try
      {
        require_memory(scene, MPI_COMM_WORLD, 100000);
        ADD_FAILURE() << "accepted";
      }
    catch (const InputError &error)
      {
        expect_in("100000 grids of 1024 x 512 points take", error.what());
      }
  }

  class EarlierResults : public testing::Test
  {
  protected:
    Scene
    scene(const Overrides &more) const
    {
      return scene_of("", Overrides{"Output/Directory=" + folder.path()} + more);
    }

    void
    write(const std::string &name, const std::string &text) const
    {
      run_on_root(MPI_COMM_WORLD,
                  [&]() { std::ofstream(folder.path() + "/" + name) << text; });
    }

    std::string
    refusal(const Overrides &more = {}) const
    {
      try
        {
          refuse_results_of_another_scene(scene(more), MPI_COMM_WORLD);
          return "none";
        }
      catch (const InputError &error)
        {
          return error.what();
        }
    }

    const test::TemporaryFolder folder;
  };

  TEST_F(EarlierResults, OfTheSameSceneMayGo)
  {
    EXPECT_EQ(refusal(), "none");
    write("notes.txt", "mine");
    write("log.txt", "");
    EXPECT_EQ(refusal(), "none");
    write("leakage.csv", "step\n1\n");
    write("parameters.prm", scene({}).resolved);
    EXPECT_EQ(refusal(), "none");
    EXPECT_EQ(refusal({"Output/Fields=all"}), "none");
    // The file of an earlier version, which had fewer parameters.
    write("parameters.prm", "subsection Surface\n set Seed = 1\nend\n");
    EXPECT_EQ(refusal(), "none");
  }

  TEST_F(EarlierResults, OfAnotherSceneMayNot)
  {
    write("leakage.csv", "step\n1\n");
    expect_in("parameters.prm is missing", refusal());
    write("parameters.prm", scene({"Surface/Seed=2"}).resolved);
    expect_in("which had Surface/Seed = 2 where the scene now has 1", refusal());
    expect_in("--force", refusal());
    write("parameters.prm", "subsection Surface\n set Colour = red\nend\n");
    expect_in("cannot read", refusal());
  }

  TEST(EarlierScenes, Difference)
  {
    const std::string now = scene_of("").resolved;
    EXPECT_EQ(difference_of_scenes(now, now), "");
    expect_in("Fluid/Colour = red, which this version",
              difference_of_scenes(now + "subsection Fluid\n set Colour = red\nend\n",
                                   now));
  }
} // namespace
