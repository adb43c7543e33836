// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/grid_description.h>

#include <sstream>

namespace strait
{
  // A slice of a three-dimensional grid: ParaView lays a two-dimensional one out in
  // another plane.
  std::string
  grid_description(const std::string              &file,
                   const PeriodicGrid             &grid,
                   const std::vector<GridDataset> &datasets)
  {
    const std::string shape =
      "\"1 " + std::to_string(grid.ny) + " " + std::to_string(grid.nx) + "\"";
    std::ostringstream out;
    out.precision(17);
    const char *const three_numbers =
      "<DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">";
    out << "<?xml version=\"1.0\"?>\n"
        << "<Xdmf Version=\"2.0\">\n<Domain>\n<Grid Name=\"grid\" GridType=\"Uniform\">\n"
        << "  <Topology TopologyType=\"3DCoRectMesh\" Dimensions=" << shape << "/>\n"
        << "  <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
        << "    " << three_numbers
        << "0 0 0</DataItem>\n"
        // From the slowest index to the fastest; the first one does not matter.
        << "    " << three_numbers << grid.dx() << ' ' << grid.dy() << ' ' << grid.dx()
        << "</DataItem>\n  </Geometry>\n";
    for (const GridDataset &dataset : datasets)
      out << "  <Attribute Name=\"" << dataset.name
          << "\" AttributeType=\"Scalar\" Center=\"Node\">\n    <DataItem Dimensions="
          << shape << " NumberType="
          << (dataset.is_whole ? "\"Int\" Precision=\"4\"" : "\"Float\" Precision=\"8\"")
          << " Format=\"HDF\">" << file << ":/" << dataset.name
          << "</DataItem>\n  </Attribute>\n";
    out << "</Grid>\n</Domain>\n</Xdmf>\n";
    return out.str();
  }
} // namespace strait
