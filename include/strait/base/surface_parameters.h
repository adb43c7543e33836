// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>

namespace strait
{
  struct ParameterSection;

  /** The largest seed of a scene file: the largest integer that can be read there. */
  constexpr int largest_seed = std::numeric_limits<int>::max();

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

  /** The part of the section Surface that says how a measured map becomes a surface (Kind
   *  = file). */
  struct MapParameters
  {
    std::string file;
    std::string second_file;
    std::string height_unit;  // overrides what the file states, if anything
    std::string lateral_unit; // likewise
    double      largest_missing_share = 0.;
    /** The number of windows that the map is cut into along x and y; the seed is the
     *  number of the one that is taken. */
    std::array<int, 2> windows             = {{1, 1}};
    Detrend            detrend             = Detrend::none;
    MakePeriodic       make_periodic       = MakePeriodic::no;
    double             window_width        = 0.1; // share of each side
    bool               resample            = false;
    double             shortest_wavelength = 0.; // 0: no filter
    double             longest_wavelength  = 0.; // 0: no filter

    /** The scene's unit of length, from the section Units; empty: not stated. */
    std::optional<double> length_in_metres;

    void bind(ParameterSection section);
    void check() const;
    /** Throws InputError if there is no window with the number @p seed. */
    void check_window(unsigned long long seed) const;
  };

  /** The height profiles that strait knows. */
  enum class SurfaceKind
  {
    self_affine,
    square_saddle,
    triangular_peaks,
    honeycomb_peaks,
    sphere,
    sine,
    flat,
    expression,
    file
  };

  /** How the amplitudes of the waves of a self-affine surface are chosen. */
  enum class Amplitudes
  {
    gaussian,
    fixed
  };

  /** The section Surface of a scene: the rough, rigid substrate. */
  struct SurfaceParameters
  {
    SurfaceKind           kind                     = SurfaceKind::self_affine;
    std::array<double, 2> size                     = {{1., 1.}}; // lx, ly
    unsigned long long    seed                     = 1;
    double                hurst_exponent           = 0.8;
    double                roll_off_wavelength      = 0.5;
    double                short_cut_off_wavelength = 0.0078125;
    Amplitudes            amplitudes               = Amplitudes::gaussian;
    bool                  rms_is_of_height         = false; // not of slope
    double                rms_value                = 1.;
    double                amplitude                = 1.; // of a sphere the radius
    std::string           expression;
    MapParameters         map;
    bool                  invert = false;
    bool                  rotate = false;

    void bind(ParameterSection section);
    /** Throws InputError if the values contradict each other. */
    void check() const;

    /** Whether a crease lies within @p distance of @p place [length]: at the edges of the
     *  box between the periodic images of a sphere, or between a map and its mirror
     *  images. A gap in a crease is closed only by the finite grid spacing: the finer the
     *  grid, the higher the load that closes it, without limit. */
    bool has_crease_near(const std::array<double, 2> &place, double distance) const;
  };

  /** @p value with nine significant digits, as one would write it in a scene. */
  std::string scene_number(double value);

  /** The two values that a scene must give, "x, y", if the surface has @p along_x and
   *  @p along_y before the rotation that @p parameters ask for. */
  std::string
  scene_pair(const SurfaceParameters &parameters, double along_x, double along_y);
} // namespace strait
