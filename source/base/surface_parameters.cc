// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/surface_parameters.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    const Choices<SurfaceKind> kinds = {{SurfaceKind::self_affine, "self-affine"},
                                        {SurfaceKind::square_saddle, "square saddle"},
                                        {SurfaceKind::triangular_peaks,
                                         "triangular peaks"},
                                        {SurfaceKind::honeycomb_peaks, "honeycomb peaks"},
                                        {SurfaceKind::sphere, "sphere"},
                                        {SurfaceKind::sine, "sine"},
                                        {SurfaceKind::flat, "flat"},
                                        {SurfaceKind::expression, "expression"},
                                        {SurfaceKind::file, "file"}};

    const Choices<Amplitudes> amplitude_laws = {{Amplitudes::gaussian, "gaussian"},
                                                {Amplitudes::fixed, "fixed"}};

    const Choices<Normalisation> normalisations = {
      {Normalisation::rms_slope, "rms slope"},
      {Normalisation::rms_height, "rms height"}};

    /** The wavelengths and the exponent of a self-affine surface. */
    void
    check_spectrum(const SurfaceParameters &surface)
    {
      if (!(surface.hurst_exponent > 0. && surface.hurst_exponent <= 1.))
        throw InputError("Surface/Hurst exponent is " + to_text(surface.hurst_exponent) +
                         " but must lie above 0 and not above 1.");
      if (!(surface.short_cut_off_wavelength > 0.))
        throw InputError("Surface/Short cut-off wavelength is " +
                         to_text(surface.short_cut_off_wavelength) +
                         " but must be positive.");
      if (!(surface.short_cut_off_wavelength < surface.roll_off_wavelength))
        throw InputError("Surface/Short cut-off wavelength (" +
                         to_text(surface.short_cut_off_wavelength) +
                         ") must be shorter than the Roll-off wavelength (" +
                         to_text(surface.roll_off_wavelength) + ").");
      const double longest = std::max(surface.size[0], surface.size[1]);
      if (surface.roll_off_wavelength > longest)
        throw InputError(
          "Surface/Roll-off wavelength (" + to_text(surface.roll_off_wavelength) +
          ") does not fit into a box of Size " + to_text(surface.size[0]) + ", " +
          to_text(surface.size[1]) + "; shorten it or enlarge the box.");
      if (!(surface.rms_value > 0.))
        throw InputError("Surface/RMS value is " + to_text(surface.rms_value) +
                         " but must be positive; choose Kind = flat for no roughness.");
    }
  } // namespace

  void
  SurfaceParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const SurfaceParameters standard;
    prm.enter_subsection("Surface");
    prm.declare_entry("Kind",
                      kinds.name(standard.kind),
                      Selection(kinds.pattern()),
                      "The height profile h(x, y) of the rigid substrate.");
    prm.declare_entry(
      "Size",
      "1, 1",
      List(Double(), 1, 2),
      "Lx, Ly: sides of the periodic box [length]; one number: a square.");
    prm.declare_entry(
      "Seed",
      "1",
      Integer(0),
      "Kind = self-affine: number of the realisation. The same seed gives "
      "the same surface on every grid and number of ranks.");
    prm.declare_entry(
      "Hurst exponent",
      to_text(standard.hurst_exponent),
      Double(),
      "Kind = self-affine: H, above 0 and at most 1; the spectrum falls as "
      "q^(-2(1+H)) [1].");
    prm.declare_entry(
      "Roll-off wavelength",
      to_text(standard.roll_off_wavelength),
      Double(),
      "Kind = self-affine: longest wavelength of the self-affine range; the "
      "spectrum is constant above it [length].");
    prm.declare_entry("Short cut-off wavelength",
                      to_text(standard.short_cut_off_wavelength),
                      Double(),
                      "Kind = self-affine: no roughness below this wavelength [length].");
    prm.declare_entry("Amplitudes",
                      amplitude_laws.name(standard.amplitudes),
                      Selection(amplitude_laws.pattern()),
                      "Kind = self-affine: amplitudes of the waves drawn at random "
                      "(gaussian), or equal to the spectrum with random phases only "
                      "(fixed).");
    prm.declare_entry("Normalisation",
                      normalisations.name(standard.normalisation),
                      Selection(normalisations.pattern()),
                      "Kind = self-affine: what RMS value prescribes.");
    prm.declare_entry("RMS value",
                      to_text(standard.rms_value),
                      Double(),
                      "Kind = self-affine: rms slope [1] or rms height [length].");
    prm.declare_entry(
      "Amplitude",
      to_text(standard.amplitude),
      Double(),
      "Kind = square saddle, triangular peaks, honeycomb peaks, sine: the "
      "amplitude Delta [length]; sphere: its radius [length].");
    prm.declare_entry(
      "Expression",
      "",
      Anything(),
      "Kind = expression: h [length] as a formula of x and y [length], in "
      "muParser's syntax; pi is known.");
    MapParameters::declare(prm);
    prm.declare_entry("Invert", "false", Bool(), "Use -h instead of h.");
    prm.declare_entry("Rotate", "false", Bool(), "Rotate the surface by 90 degrees.");
    prm.leave_subsection();
  }

  void
  SurfaceParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Surface");
    kind                     = kinds.value(prm.get("Kind"));
    size                     = parse_pair(prm.get("Size"));
    seed                     = static_cast<unsigned long long>(prm.get_integer("Seed"));
    hurst_exponent           = prm.get_double("Hurst exponent");
    roll_off_wavelength      = prm.get_double("Roll-off wavelength");
    short_cut_off_wavelength = prm.get_double("Short cut-off wavelength");
    amplitudes               = amplitude_laws.value(prm.get("Amplitudes"));
    normalisation            = normalisations.value(prm.get("Normalisation"));
    rms_value                = prm.get_double("RMS value");
    amplitude                = prm.get_double("Amplitude");
    expression               = prm.get("Expression");
    map.parse(prm);
    invert = prm.get_bool("Invert");
    rotate = prm.get_bool("Rotate");
    prm.leave_subsection();
  }

  void
  SurfaceParameters::check() const
  {
    if (!(size[0] > 0. && size[1] > 0.))
      throw InputError("Surface/Size is " + to_text(size[0]) + ", " + to_text(size[1]) +
                       " but both sides must be positive.");
    switch (kind)
      {
        case SurfaceKind::self_affine:
          check_spectrum(*this);
          break;
        case SurfaceKind::square_saddle:
        case SurfaceKind::triangular_peaks:
        case SurfaceKind::honeycomb_peaks:
        case SurfaceKind::sphere:
        case SurfaceKind::sine:
          if (!(amplitude > 0.))
            throw InputError("Surface/Amplitude is " + to_text(amplitude) +
                             " but must be positive for Kind = " + kinds.name(kind) +
                             "; choose Kind = flat for no roughness.");
          break;
        case SurfaceKind::expression:
          if (expression.empty())
            throw InputError(
              "Surface/Kind = expression needs a formula; set "
              "Surface/Expression.");
          break;
        case SurfaceKind::file:
          map.check();
          break;
        case SurfaceKind::flat:
          break;
      }
  }
} // namespace strait
