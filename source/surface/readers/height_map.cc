// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/surface/readers/height_map.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  std::size_t
  HeightMap::n_missing() const
  {
    return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](const double value) {
        return std::isnan(value);
      }));
  }

  void
  reject_height_map(const std::string &file, const std::string &complaint)
  {
    throw InputError("The height map '" + file + "' " + complaint);
  }

  void
  check_claim(const std::string  &file,
              const std::uint64_t n_columns,
              const std::uint64_t n_rows,
              const std::uint64_t item_size,
              const std::uint64_t n_bytes)
  {
    constexpr std::uint64_t most = 65535; // points of a side of a grid
    const std::string       claim =
      std::to_string(n_columns) + " x " + std::to_string(n_rows) + " points";
    if (n_columns == 0 || n_rows == 0 || n_columns > most || n_rows > most)
      reject_height_map(file,
                        "has " + claim + ", and both must lie between 1 and " +
                          std::to_string(most) + ": cut or thin it out.");
    if (n_columns * n_rows > n_bytes / item_size)
      reject_height_map(file,
                        "promises " + claim +
                          " and is too short for them: copy or export it again.");
  }
} // namespace strait
