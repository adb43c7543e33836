// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_flow_mesh_file_h
#define strait_flow_mesh_file_h

#include <array>
#include <string>
#include <vector>

namespace strait
{
  /** What strait takes from a Gmsh file: quadrilaterals and lines between points. */
  struct MeshFile
  {
    /** A line element and where it comes from. */
    struct Line
    {
      std::array<unsigned int, 2> points;
      int                         curve = 0;  // of the geometry
      int boundary_id                   = -1; // number of its physical curve, or −1
    };

    std::vector<std::array<double, 2>> points;
    std::vector<std::array<unsigned int, 4>>
                      quadrilaterals; // corners one after the other
    std::vector<Line> lines;
  };

  /**
   * Take the @p text of a Gmsh file in ASCII format 4.1 apart; @p name stands for it in
   * messages. Points are numbered anew from 0, those of no element left out. Throws
   * InputError for another format, other elements (single points aside), points off the
   * plane z = 0 and whatever does not make sense.
   */
  MeshFile parse_mesh_file(const std::string &text, const std::string &name);
} // namespace strait

#endif
