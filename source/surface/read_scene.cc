// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/read_scene.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    bool
    is_entry(const SceneEntry &entry, const std::string &section, const std::string &name)
    {
      return entry.section == std::vector<std::string>{section} && entry.name == name;
    }

    /** Whether a scene leaves a parameter to the map: it is not there, or empty at last.
     */
    bool
    is_left_open(const std::vector<SceneEntry> &entries,
                 const std::string             &section,
                 const std::string             &name)
    {
      const auto last =
        std::find_if(entries.rbegin(), entries.rend(), [&](const auto &entry) {
          return is_entry(entry, section, name);
        });
      return last == entries.rend() || last->value.empty();
    }

    std::vector<SceneEntry>
    without(std::vector<SceneEntry> entries,
            const std::string      &section,
            const std::string      &name)
    {
      const auto is_named = [&](const SceneEntry &entry) {
        return is_entry(entry, section, name);
      };
      entries.erase(std::remove_if(entries.begin(), entries.end(), is_named),
                    entries.end());
      return entries;
    }

    /** What a scene may leave to its map, as the values of parameters. */
    struct Frame
    {
      std::string size, grid_points, unit; // empty: the map does not say
    };

    Frame
    frame_of_map(const SurfaceParameters &surface)
    {
      Frame frame;
      run_on_root(MPI_COMM_WORLD, [&]() {
        HeightMap map = read_height_map(surface.map.file);
        cut_window(map, surface, surface.map.file);
        convert_to_scene_units(map, surface.map, surface.map.file);
        // Nothing else that is done to a map changes its frame.
        const int n       = surface.map.make_periodic == MakePeriodic::mirror ? 2 : 1;
        frame.grid_points = scene_pair(surface, n * map.nx, n * map.ny);
        if (map.size)
          frame.size = scene_pair(surface, n * (*map.size)[0], n * (*map.size)[1]);
        // Lengths of a map with units are converted to metres.
        if (map.lateral_unit.metres && surface.map.lateral_unit.empty())
          frame.unit = "m";
      });
      return {broadcast(MPI_COMM_WORLD, frame.size),
              broadcast(MPI_COMM_WORLD, frame.grid_points),
              broadcast(MPI_COMM_WORLD, frame.unit)};
    }
  } // namespace

  Scene
  read_scene(const std::string &path, const Overrides &overrides)
  {
    const std::vector<SceneEntry> entries = read_entries(path, overrides);
    struct Open
    {
      const char *section, *name;
      std::string Frame::*of_map;
    };
    std::vector<Open>       open;
    std::vector<SceneEntry> completed = entries;
    for (const Open &one : {Open{"Surface", "Size", &Frame::size},
                            Open{"Contact", "Grid points", &Frame::grid_points},
                            Open{"Units", "Length", &Frame::unit}})
      if (is_left_open(entries, one.section, one.name))
        {
          open.push_back(one);
          completed = without(completed, one.section, one.name);
        }
    const SurfaceParameters surface = parse_scene(completed).surface;
    if (open.empty() || surface.kind != SurfaceKind::file || surface.map.file.empty())
      return make_scene(entries);

    const Frame frame = frame_of_map(surface);
    for (const Open &one : open)
      if (!(frame.*one.of_map).empty())
        completed.push_back(
          {{one.section}, one.name, frame.*one.of_map, surface.map.file, ""});
      else if (one.of_map == &Frame::size)
        reject_height_map(surface.map.file, "states no size: set Surface/Size.");
    return make_scene(completed);
  }
} // namespace strait
