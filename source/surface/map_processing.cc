// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/contact_parameters.h>
#include <strait/base/rounding.h>
#include <strait/base/text.h>
#include <strait/surface/map_processing.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** The file's unit over the scene's; nothing if neither file nor scene states it. */
    std::optional<double>
    factor_of(const std::string   &override_text,
              const LengthUnit    &stated,
              const MapParameters &parameters,
              const std::string   &what,
              const std::string   &file)
    {
      if (override_text == "scene")
        return 1.;
      const LengthUnit unit =
        override_text.empty() ? stated : parse_length_unit(override_text);
      if (unit.name.empty())
        return {};
      if (!unit.metres)
        reject_height_map(file,
                          "states the " + what + " unit '" + unit.name +
                            "', which is no length: set Surface/" +
                            (what == "height" ? "Height" : "Lateral") +
                            " unit to what 1 in the file means, such as 63.1 nm.");
      return *unit.metres / parameters.length_in_metres.value_or(1.);
    }

    struct Roughness
    {
      double height = 0.; // rms about the mean
      double slope  = 0.; // rms, of differences between neighbours
      // Rms step between opposite edges over that between neighbours; the larger ratio of
      // those along x and along y.
      double seam = 0.;
    };

    Roughness
    roughness(const HeightMap &map)
    {
      const int  nx = map.nx, ny = map.ny;
      const auto at = [&map](const int ix, const int iy) {
        return map.values[static_cast<std::size_t>(iy) * map.nx + ix];
      };
      const double origin = at(0, 0); // heights far from 0 would cancel
      double sum = 0, squares = 0, steps[2] = {}, seam[2] = {}; // along x and along y
      for (int iy = 0; iy < ny; ++iy)
        for (int ix = 0; ix < nx; ++ix)
          {
            const double here = at(ix, iy);
            sum += here - origin;
            squares += std::pow(here - origin, 2);
            (ix > 0 ? steps : seam)[0] += std::pow(here - at((ix + nx - 1) % nx, iy), 2);
            (iy > 0 ? steps : seam)[1] += std::pow(here - at(ix, (iy + ny - 1) % ny), 2);
          }
      const double n = static_cast<double>(nx) * ny, n_x = n - ny, n_y = n - nx;
      const double dx = (*map.size)[0] / nx, dy = (*map.size)[1] / ny;
      Roughness    result;
      result.height = std::sqrt(std::max(squares / n - std::pow(sum / n, 2), 0.));
      if (nx < 2 || ny < 2)
        return result;
      result.slope = std::sqrt(steps[0] / n_x / (dx * dx) + steps[1] / n_y / (dy * dy));
      const auto ratio = [](const double of_seam, const double of_neighbours) {
        return of_neighbours > 0 ? std::sqrt(of_seam / of_neighbours) : 0.;
      };
      result.seam = std::max(ratio(seam[0] / ny, steps[0] / n_x),
                             ratio(seam[1] / nx, steps[1] / n_y));
      return result;
    }

    /** One at the centre, and zero at the edges, to which it falls as half a period of a
     *  cosine over the share @p width of the side. */
    double
    window(const int i, const int n, const double width)
    {
      const double position = (i + 0.5) / n;
      const double distance = std::min(position, 1 - position) / width;
      return distance >= 1 ? 1. : 0.5 * (1 - std::cos(M_PI * distance));
    }

    void
    apply_window(HeightMap &map, const double width)
    {
      double mean = 0;
      for (const double value : map.values)
        mean += value / static_cast<double>(map.values.size());
      for (int iy = 0; iy < map.ny; ++iy)
        for (int ix = 0; ix < map.nx; ++ix)
          {
            double &value = map.values[static_cast<std::size_t>(iy) * map.nx + ix];
            value         = mean + (value - mean) * window(ix, map.nx, width) *
                             window(iy, map.ny, width);
          }
    }

    void
    mirror(HeightMap &map)
    {
      const int           nx = map.nx, ny = map.ny;
      std::vector<double> values(4 * map.values.size());
      for (int iy = 0; iy < 2 * ny; ++iy)
        for (int ix = 0; ix < 2 * nx; ++ix)
          values[static_cast<std::size_t>(iy) * 2 * nx + ix] =
            map.values[static_cast<std::size_t>(std::min(iy, 2 * ny - 1 - iy)) * nx +
                       std::min(ix, 2 * nx - 1 - ix)];
      map.values = std::move(values);
      map.nx     = 2 * nx;
      map.ny     = 2 * ny;
      map.size   = {{2 * (*map.size)[0], 2 * (*map.size)[1]}};
    }
  } // namespace

  bool
  convert_to_scene_units(HeightMap &map, const MapParameters &parameters)
  {
    const auto height =
      factor_of(parameters.height_unit, map.height_unit, parameters, "height", map.file);
    const auto lateral = map.size ? factor_of(parameters.lateral_unit,
                                              map.lateral_unit,
                                              parameters,
                                              "lateral",
                                              map.file)
                                  : std::nullopt;
    if (!map.size && !parameters.lateral_unit.empty() && parameters.second_file.empty())
      reject_height_map(map.file,
                        "states no size that Surface/Lateral unit could be of: remove "
                        "that, Surface/Size is in the unit of the scene.");
    if (map.size && height && !lateral)
      reject_height_map(map.file,
                        "states a size without a unit, but has heights with one: set "
                        "Surface/Lateral unit.");
    if (map.size && lateral && !height)
      reject_height_map(map.file,
                        "states a size with a unit, but no unit of its heights: set "
                        "Surface/Height unit.");
    const bool has_height_unit = height && parameters.height_unit != "scene";
    const bool has_size_unit   = lateral && parameters.lateral_unit != "scene";
    if (has_height_unit && !has_size_unit && !parameters.length_in_metres)
      reject_height_map(map.file,
                        "has heights in a unit of length, but nothing says in which one "
                        "its size is: set Units/Length to the unit of Surface/Size.");
    for (double &value : map.values)
      value *= height.value_or(1.);
    if (map.size)
      for (double &side : *map.size)
        side *= lateral.value_or(1.);
    return height.has_value();
  }

  void
  detrend(HeightMap &map, const Detrend what)
  {
    if (what == Detrend::none)
      return;
    // The first terms of 1, x, y, x², xy, y², in coordinates from −1 to 1.
    const int  n_terms  = what == Detrend::mean ? 1 : what == Detrend::tilt ? 3 : 6;
    const auto terms_at = [&map](const std::size_t k) {
      const double x = (2. * static_cast<double>(k % map.nx) + 1) / map.nx - 1;
      const double y = (2. * static_cast<double>(k / map.nx) + 1) / map.ny - 1;
      return std::array<double, 6>{{1., x, y, x * x, x * y, y * y}};
    };
    std::array<std::array<double, 7>, 6> rows{}; // matrix and right-hand side
    for (std::size_t k = 0; k < map.values.size(); ++k)
      if (!std::isnan(map.values[k]))
        {
          const auto terms = terms_at(k);
          for (int i = 0; i < n_terms; ++i)
            {
              for (int j = 0; j < n_terms; ++j)
                rows[i][j] += terms[i] * terms[j];
              rows[i][n_terms] += terms[i] * map.values[k];
            }
        }
    // Gauss–Jordan elimination, which needs no pivoting for normal equations. A
    // coefficient that the points do not determine is zero.
    std::array<double, 6> coefficients{};
    for (int i = 0; i < n_terms; ++i)
      if (rows[i][i] > rounding * rows[0][0])
        for (int row = 0; row < n_terms; ++row)
          {
            const double factor = row == i ? 0. : rows[row][i] / rows[i][i];
            for (int j = 0; j <= n_terms; ++j)
              rows[row][j] -= factor * rows[i][j];
          }
      else
        rows[i] = {};
    for (int i = 0; i < n_terms; ++i)
      if (rows[i][i] > 0)
        coefficients[i] = rows[i][n_terms] / rows[i][i];
    for (std::size_t k = 0; k < map.values.size(); ++k)
      {
        const auto terms = terms_at(k);
        for (int i = 0; i < n_terms; ++i)
          map.values[k] -= coefficients[i] * terms[i];
      }
  }

  void
  make_periodic(HeightMap &map, const MapParameters &parameters, Remarks &remarks)
  {
    const Roughness before = roughness(map);
    if (parameters.make_periodic == MakePeriodic::no)
      {
        // Rms step at the seam over that between neighbours; about 1 for one period of a
        // rough surface. Half of it would warn of chance; double of it would let seams
        // pass that act as walls.
        constexpr double largest_step = 3.;
        if (!map.is_periodic && before.seam > largest_step)
          remarks.warnings.push_back(format(
            "the map '%s' is taken as one period, but steps at its seams are %.3g times "
            "those between neighbours; set Surface/Make periodic or Detrend",
            map.file.c_str(),
            before.seam));
        return;
      }
    const bool is_window = parameters.make_periodic == MakePeriodic::window;
    if (is_window)
      apply_window(map, parameters.window_width);
    else
      mirror(map);
    const Roughness after  = roughness(map);
    const auto      change = [](const double now, const double was) {
      const std::string number = format("%.4g", now), earlier = format("%.4g", was);
      return number == earlier ? number + " as before"
                                    : number + " instead of " + earlier;
    };
    std::string text = std::string("Surface/Make periodic = ") +
                       (is_window ? "window" : "mirror") +
                       " changes the statistics of the map: rms height " +
                       change(after.height, before.height) + ", rms slope " +
                       change(after.slope, before.slope);
    if (is_window)
      text += "; its edges are a flat rim, which may seal where the surface would leak";
    else
      text +=
        "; only a quarter of it is independent, and the creases at its seams close "
        "at a load that is higher the finer the points are";
    remarks.warnings.push_back(text);
  }

  void
  cut_window(HeightMap &map, const SurfaceParameters &parameters)
  {
    const auto [n_x, n_y] = parameters.map.windows;
    if (n_x == 1 && n_y == 1)
      return;
    parameters.map.check_window(parameters.seed);
    const int nx = map.nx / n_x, ny = map.ny / n_y;
    if (std::min(nx, ny) < least_grid_points)
      reject_height_map(map.file,
                        "has only " + std::to_string(nx) + " x " + std::to_string(ny) +
                          " points for each of Surface/Windows: give fewer of them.");
    const auto          number  = static_cast<int>(parameters.seed - 1);
    const int           first_x = number % n_x * nx, first_y = number / n_x * ny;
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(nx) * ny);
    for (int iy = first_y; iy < first_y + ny; ++iy)
      {
        const auto begin =
          map.values.begin() + static_cast<std::ptrdiff_t>(iy) * map.nx + first_x;
        values.insert(values.end(), begin, begin + nx);
      }
    if (map.size)
      map.size = {{(*map.size)[0] * nx / map.nx, (*map.size)[1] * ny / map.ny}};
    map.values      = std::move(values);
    map.nx          = nx;
    map.ny          = ny;
    map.is_periodic = false;
  }
} // namespace strait
