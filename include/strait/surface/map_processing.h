// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_surface_map_processing_h
#define strait_surface_map_processing_h

#include <strait/base/surface_parameters.h>
#include <strait/surface/readers/height_map.h>

#include <string>
#include <vector>

namespace strait
{
  /** What is to be said of a map: one sentence each. */
  struct Remarks
  {
    std::vector<std::string> notes;
    std::vector<std::string> warnings;
  };

  /**
   * Give heights and size in the scene's unit of length. What the scene says of
   * the file's units prevails over what the file says; a file without any unit is
   * in the scene's. Throws InputError, naming the parameter that settles it, if a
   * unit is no length, or one of heights and size has a unit and the other none.
   */
  void convert_to_scene_units(HeightMap           &map,
                              const MapParameters &parameters,
                              const std::string   &file);

  /** Subtract mean, plane or paraboloid of least squares over the valid points. */
  void detrend(HeightMap &map, Detrend what);

  /**
   * Fill missing points with the harmonic function of the points around them.
   * Throws InputError if they are more than @p largest_share of all.
   */
  void fill_missing_points(HeightMap         &map,
                           double             largest_share,
                           const std::string &file,
                           Remarks           &remarks);

  /**
   * Make one period of @p map as the scene says, and warn of what that does to
   * rms height and slope; with MakePeriodic::no warn of a step at the seam.
   */
  void make_periodic(HeightMap           &map,
                     const MapParameters &parameters,
                     const std::string   &file,
                     Remarks             &remarks);

  /**
   * Keep of @p map the window of @p parameters, with the points that it has in the file.
   * Rows and columns that are left over where the windows do not divide the map belong to
   * none. Throws InputError if there is no such window, or no point in it.
   */
  void cut_window(HeightMap               &map,
                  const SurfaceParameters &parameters,
                  const std::string       &file);

  /** All but the last, in this order. */
  void process_map(HeightMap           &map,
                   const MapParameters &parameters,
                   const std::string   &file,
                   Remarks             &remarks);
} // namespace strait

#endif
