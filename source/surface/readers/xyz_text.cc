// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/formats.h>
#include <strait/surface/readers/text_header.h>
#include <strait/surface/readers/text_row.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>

namespace strait
{
  namespace
  {
    constexpr std::size_t longest_header_line = 1000;

    /** A regular axis through coordinates in any order. */
    struct Axis
    {
      double origin  = 0.;
      double spacing = 0.;
      int    n       = 0;

      /** The index of a coordinate; −1 if it is not on the axis. */
      int
      index(const double coordinate) const
      {
        constexpr double tolerance = 0.05;
        const double     position  = (coordinate - origin) / spacing;
        const double     nearest   = std::round(position);
        return std::abs(position - nearest) > tolerance ? -1 : static_cast<int>(nearest);
      }
    };

    Axis
    find_axis(std::vector<double> coordinates, const char *name, const std::string &file)
    {
      std::sort(coordinates.begin(), coordinates.end());
      const double range = coordinates.back() - coordinates.front();
      // Neighbours on an axis are further apart than rounding ever is.
      constexpr double    same = 1e-6;
      std::vector<double> distinct(1, coordinates.front());
      for (const double coordinate : coordinates)
        if (coordinate - distinct.back() > same * range)
          distinct.push_back(coordinate);
      if (distinct.size() < 2)
        reject_height_map(file,
                          std::string("has one ") + name +
                            " only, and lines of x, y, z must span a grid: check what "
                            "was exported.");
      std::vector<double> gaps;
      for (std::size_t i = 1; i < distinct.size(); ++i)
        gaps.push_back(distinct[i] - distinct[i - 1]);
      std::nth_element(gaps.begin(),
                       gaps.begin() + static_cast<long>(gaps.size() / 2),
                       gaps.end());
      const double spacing = gaps[gaps.size() / 2];
      // Counted from neighbour to neighbour, so that rounding does not add up.
      double n = 1;
      for (std::size_t i = 1; i < distinct.size(); ++i)
        n += std::max(1., std::round((distinct[i] - distinct[i - 1]) / spacing));
      if (n > 65535)
        reject_height_map(file,
                          std::string("has points that lie on no regular grid in ") +
                            name + ": interpolate them to one.");
      return {distinct.front(), range / (n - 1), static_cast<int>(n)};
    }

    struct Points
    {
      std::vector<double> x, y, z;
    };

    /** Whether the third word and all after it are not a number: "No Data". */
    bool
    ends_in_words(const std::string &line, std::string &first_two)
    {
      std::size_t position = 0;
      for (int word = 0; word < 2; ++word)
        {
          position = line.find_first_not_of(" \t;,", position);
          position = position == std::string::npos ? position
                                                   : line.find_first_of(" \t;", position);
          if (position == std::string::npos)
            return false;
        }
      const std::size_t third = line.find_first_not_of(" \t;,", position);
      if (third == std::string::npos ||
          std::isalpha(static_cast<unsigned char>(line[third])) == 0)
        return false;
      first_two = line.substr(0, position);
      return true;
    }

    void
    append_point(TextRow           &row,
                 Points            &points,
                 const std::string &line,
                 const long         line_number,
                 const std::string &file)
    {
      std::vector<double> values;
      std::string         first_two;
      if (ends_in_words(line, first_two))
        {
          row.append(first_two, line_number, values);
          values.push_back(std::numeric_limits<double>::quiet_NaN());
        }
      else
        row.append(line, line_number, values);
      if (values.size() != 3 || !std::isfinite(values[0]) || !std::isfinite(values[1]))
        reject_height_map(file,
                          "has something other than x, y, z in line " +
                            std::to_string(line_number) +
                            ": export it again, or set Surface/Format = text for a "
                            "matrix.");
      points.x.push_back(values[0]);
      points.y.push_back(values[1]);
      points.z.push_back(values[2]);
    }

    void
    fill_grid(HeightMap         &map,
              const Points      &points,
              const Axis        &along_x,
              const Axis        &along_y,
              const std::string &file)
    {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      map.values.assign(static_cast<std::size_t>(map.nx) * map.ny, none);
      std::vector<bool> seen(map.values.size());
      for (std::size_t i = 0; i < points.z.size(); ++i)
        {
          const int ix = along_x.index(points.x[i]);
          const int iy = along_y.index(points.y[i]);
          if (ix < 0 || iy < 0)
            reject_height_map(file,
                              "has points that lie on no regular grid, such as number " +
                                std::to_string(i + 1) + ": interpolate them to one.");
          const std::size_t k = static_cast<std::size_t>(iy) * map.nx + ix;
          if (seen[k])
            reject_height_map(file,
                              "names one point of its grid twice, with number " +
                                std::to_string(i + 1) + ": mend or export it again.");
          seen[k]       = true;
          map.values[k] = points.z[i];
        }
    }
  } // namespace

  HeightMap
  read_xyz_text(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    TextHeader    header(file);
    TextRow       row(file);
    Points        points;
    std::string   line;
    for (long line_number = 1; std::getline(stream, line); ++line_number)
      {
        const bool is_blank = line.find_first_not_of(" \t\r") == std::string::npos;
        if (!is_blank && line[0] != '#' && (!points.z.empty() || row.is_data(line)))
          append_point(row, points, line, line_number, file);
        else if (points.z.empty() && line.size() <= longest_header_line)
          header.parse_line(line);
      }
    if (points.z.empty())
      reject_height_map(file, "holds no numbers: check Surface/File.");

    const Axis along_x = find_axis(points.x, "x", file);
    const Axis along_y = find_axis(points.y, "y", file);
    // A grid with far more points than lines is a wrong guess of its spacing.
    constexpr std::uint64_t most_missing = 16;
    check_claim(file, along_x.n, along_y.n, 1, most_missing * points.z.size());
    HeightMap map;
    map.nx = along_x.n;
    map.ny = along_y.n;
    fill_grid(map, points, along_x, along_y, file);
    header.complete(map);
    map.size         = {{along_x.spacing * map.nx, along_y.spacing * map.ny}};
    map.lateral_unit = header.lateral_unit();
    return map;
  }
} // namespace strait
