// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_realisation_parameters_h
#define strait_base_realisation_parameters_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
  /** How a realisation of a surface is turned. */
  enum class Orientation
  {
    as_is,
    inverted,
    rotated,
    inverted_and_rotated
  };

  /** The section Realisations: several surfaces of one kind in one run. */
  struct RealisationParameters
  {
    std::vector<unsigned long long> seeds; // empty: that of the surface
    std::vector<Orientation>        orientations = {Orientation::as_is};

    /** Whether there is more than the surface of the section Surface. */
    bool
    enabled() const
    {
      return !seeds.empty() || orientations.size() > 1;
    }

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };

  /** The name of an orientation in a scene. */
  std::string name_of(Orientation orientation);
} // namespace strait

#endif
