// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_map_parameters_h
#define strait_base_map_parameters_h

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
  /** The format of a file of heights. */
  enum class MapFormat
  {
    by_content,
    npy,
    text,
    xyz,
    netcdf,
    hdf5,
    x3p,
    sdf
  };

  /** What is subtracted from a measured map, by least squares. */
  enum class Detrend
  {
    none,
    mean,
    tilt,
    curvature
  };

  /** How a measured map becomes one period. */
  enum class MakePeriodic
  {
    no,
    window,
    mirror
  };

  /**
   * The part of the section Surface that says how a measured map becomes a
   * surface (Kind = file).
   */
  struct MapParameters
  {
    std::string  file;
    std::string  second_file;
    MapFormat    format = MapFormat::by_content;
    std::string  dataset;
    std::string  height_unit;  // settles or overrides what the file states
    std::string  lateral_unit; // likewise
    double       largest_missing_share = 0.;
    Detrend      detrend               = Detrend::none;
    MakePeriodic make_periodic         = MakePeriodic::no;
    double       window_width          = 0.1; // share of each side
    bool         resample              = false;
    double       shortest_wavelength   = 0.; // 0: no filter
    double       longest_wavelength    = 0.; // 0: no filter

    /** The scene's unit of length, from the section Units. */
    double length_in_metres = 1.;

    /** These three expect the section Surface to be entered. */
    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };
} // namespace strait

#endif
