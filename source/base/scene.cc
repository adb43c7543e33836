// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/scene.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>

namespace strait
{
  namespace
  {
    std::string
    read_file(const std::string &path)
    {
      std::error_code none; // ignored: the file cannot be opened then either
      if (std::filesystem::is_directory(path, none))
        throw InputError("The scene '" + path + "' is a folder; give a .prm file.");
      std::ifstream in(path);
      if (!in)
        throw InputError("Cannot read the scene file '" + path +
                         "'; check the path and its permissions.");
      return std::string(std::istreambuf_iterator<char>(in), {});
    }

    /** Note the numbers that a scene with units does not give. Their defaults are meant
     *  for scenes without units. */
    template <typename IsGiven>
    void
    warn_of_forgotten_numbers(Scene &scene, const IsGiven &is_given)
    {
      if (scene.units.pressure.empty())
        return;
      const bool has_contact = scene.contact.enabled || scene.is_theory_only();
      const bool has_flow    = scene.fluid.enabled || scene.is_theory_only();
      for (const auto &[counts, name] :
           {std::pair{has_contact && !is_given("Contact/Young's moduli"),
                      "Contact/Effective modulus"},
            std::pair{has_flow, "Fluid/Inlet pressure"},
            std::pair{has_flow && scene.fluid.gas.empty() && !scene.units.time.empty(),
                      "Fluid/Viscosity"}})
        if (counts && !is_given(name))
          scene.oversights.push_back(std::string(name) +
                                     " is not given and counts as 1 in the scene's "
                                     "units, which are stated; set it");
    }
  } // namespace

  void
  Scene::bind(ParameterTable &table)
  {
    units.bind({table, "Units"});
    surface.bind({table, "Surface"});
    contact.bind({table, "Contact"});
    fluid.bind({table, "Fluid"});
    programme.bind({table, "Load programme"});
    realisations.bind({table, "Realisations"});
    seal.bind({table, "Seal"});
    theory.bind({table, "Theory"});
    output.bind({table, "Output"});
  }

  Scene
  parse_scene(const std::vector<SceneEntry> &entries)
  {
    Scene          scene;
    ParameterTable table;
    scene.bind(table);
    for (const SceneEntry &entry : entries)
      table.assign(entry);
    scene.entries                      = entries;
    scene.resolved                     = table.scene(false);
    scene.oversights                   = table.without_effect();
    scene.surface.map.length_in_metres = metres_in(scene.units.length);
    return scene;
  }

  Scene
  make_scene(const std::vector<SceneEntry> &entries)
  {
    Scene scene = parse_scene(entries);
    scene.contact.take_elastic_constants();
    if (scene.surface.kind == SurfaceKind::sphere)
      scene.contact.adhesion.sphere_radius = scene.surface.amplitude;
    scene.fluid.take_gas(scene.units);
    scene.check();
    const auto is_given = [&entries](const std::string &name) {
      return std::any_of(entries.begin(), entries.end(), [&](const SceneEntry &entry) {
        return entry.path() == name;
      });
    };
    warn_of_forgotten_numbers(scene, is_given);
    if (!is_given("Surface/Size") && !scene.units.length.empty() &&
        scene.surface.kind != SurfaceKind::file)
      throw InputError("Units/Length = " + scene.units.length +
                       " is stated, but not how large the surface is; set Surface/Size "
                       "in this unit.");
    return scene;
  }

  std::vector<SceneEntry>
  read_entries(const std::string &path, const Overrides &overrides)
  {
    // Only rank 0 reads the file and the current folder. After the broadcast every rank
    // does the same with the same text, and finds the same errors.
    namespace fs = std::filesystem;
    std::string text, folder, here;
    run_on_root(MPI_COMM_WORLD, [&]() {
      text   = read_file(path);
      here   = fs::current_path().string();
      folder = fs::absolute(path).parent_path().string();
    });
    text   = broadcast(MPI_COMM_WORLD, text);
    folder = broadcast(MPI_COMM_WORLD, folder);
    here   = broadcast(MPI_COMM_WORLD, here);

    std::vector<SceneEntry> entries = lex_scene(text, path, folder);
    for (const std::string &override_text : overrides)
      entries.push_back(lex_override(override_text, here));
    return entries;
  }

  void
  print_parameters(std::ostream &out, const std::string &format)
  {
    Scene          scene;
    ParameterTable table;
    scene.bind(table);
    if (format == "md")
      out << table.markdown();
    else if (format == "prm")
      out << table.scene(true);
    else
      throw InputError("--parameters " + format + ": the formats are prm and md.");
  }
} // namespace strait
