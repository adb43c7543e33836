// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/read_scene.h>

#include <algorithm>
#include <map>
#include <utility>

namespace strait
{
  namespace
  {
    /** The size, grid points and unit of length that a map gives its scene, as values of
     *  parameters by name; empty if the map does not state them. Collective. */
    std::map<std::string, std::string>
    frame_of_map(const SurfaceParameters &surface)
    {
      std::string size, grid_points, unit;
      run_on_root(MPI_COMM_WORLD, [&]() {
        HeightMap map = read_height_map(surface.map.file);
        cut_window(map, surface);
        convert_to_scene_units(map, surface.map);
        // No other processing changes the size or the number of points.
        const int n = surface.map.make_periodic == MakePeriodic::mirror ? 2 : 1;
        grid_points = scene_pair(surface, n * map.nx, n * map.ny);
        if (map.size)
          size = scene_pair(surface, n * (*map.size)[0], n * (*map.size)[1]);
        // Without Units/Length, lengths of a map with units are converted to metres.
        const std::string &lateral = surface.map.lateral_unit;
        if (map.size &&
            (lateral.empty() ? map.lateral_unit.metres.has_value() : lateral != "scene"))
          unit = "m";
      });
      return {{"Size", broadcast(MPI_COMM_WORLD, size)},
              {"Grid points", broadcast(MPI_COMM_WORLD, grid_points)},
              {"Length", broadcast(MPI_COMM_WORLD, unit)}};
    }
  } // namespace

  Scene
  read_scene(const std::string &path, const Overrides &overrides)
  {
    const std::vector<SceneEntry> entries = read_entries(path, overrides);
    // What is left to the map: entries that are missing, or empty where they come last.
    std::vector<SceneEntry> open, completed = entries;
    for (const auto &[section, name] : {std::pair{"Surface", "Size"},
                                        std::pair{"Contact", "Grid points"},
                                        std::pair{"Units", "Length"}})
      {
        const SceneEntry empty{{section}, name, "", "", ""};
        const auto       is_named = [&empty](const SceneEntry &entry) {
          return entry.section == empty.section && entry.name == empty.name;
        };
        const auto last    = std::find_if(entries.rbegin(), entries.rend(), is_named);
        const bool is_open = last == entries.rend() || last->value.empty();
        if (is_open)
          open.push_back(empty);
        const auto is_void = [&](const SceneEntry &entry) {
          return is_named(entry) && (is_open || entry.value.empty());
        };
        completed.erase(std::remove_if(completed.begin(), completed.end(), is_void),
                        completed.end());
      }
    const SurfaceParameters surface = parse_scene(completed).surface;
    if (surface.kind != SurfaceKind::file || surface.map.file.empty())
      return make_scene(entries);
    if (open.empty())
      return make_scene(completed);

    const auto frame = frame_of_map(surface);
    for (SceneEntry &entry : open)
      {
        entry.value = frame.at(entry.name);
        entry.place = surface.map.file;
        if (!entry.value.empty())
          completed.push_back(entry);
        else if (entry.name == "Size")
          reject_height_map(surface.map.file, "states no size: set Surface/Size.");
      }
    return make_scene(completed);
  }

  PeriodicGrid
  grid_of(const Scene &scene)
  {
    return {scene.contact.grid_points[0],
            scene.contact.grid_points[1],
            scene.surface.size[0],
            scene.surface.size[1]};
  }
} // namespace strait
