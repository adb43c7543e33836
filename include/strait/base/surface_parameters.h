// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_surface_parameters_h
#define strait_base_surface_parameters_h

#include <strait/base/map_parameters.h>

#include <array>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
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

  /** Amplitudes of the waves of a self-affine surface. */
  enum class Amplitudes
  {
    gaussian,
    fixed
  };

  /** What the given rms value is of. */
  enum class Normalisation
  {
    rms_slope,
    rms_height
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
    Normalisation         normalisation            = Normalisation::rms_slope;
    double                rms_value                = 1.;
    double                amplitude                = 1.; // sphere: its radius
    std::string           expression;
    MapParameters         map;
    bool                  invert = false;
    bool                  rotate = false;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    /** Throws InputError where the values contradict each other. */
    void check() const;
  };
} // namespace strait

#endif
