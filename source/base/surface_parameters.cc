// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/surface_parameters.h>
#include <strait/base/units.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    /** Check the wavelengths and the rms value of a self-affine surface. */
    void
    check_spectrum(const SurfaceParameters &surface)
    {
      require(surface.short_cut_off_wavelength < surface.roll_off_wavelength,
              "Surface/Short cut-off wavelength (" +
                to_text(surface.short_cut_off_wavelength) +
                ") must be shorter than the Roll-off wavelength (" +
                to_text(surface.roll_off_wavelength) + ").");
      const double longest = std::max(surface.size[0], surface.size[1]);
      require(!(surface.roll_off_wavelength > longest),
              "Surface/Roll-off wavelength (" + to_text(surface.roll_off_wavelength) +
                ") does not fit into a box of Size " + to_text(surface.size[0]) + ", " +
                to_text(surface.size[1]) + "; shorten it or enlarge the box.");
      require(surface.rms_value != 0.,
              "Surface/RMS value is 0; choose Kind = flat for no roughness.");
    }
  } // namespace

  void
  MapParameters::bind(ParameterSection section)
  {
    const Text unit = {std::string("a length such as nm or 63.1 nm (known are ") +
                         length_units + "), scene, or empty",
                       [](const std::string &text) {
                         return text.empty() || text == "scene" ||
                                parse_length_unit(text).metres;
                       }};
    section.add_path("File", file).meaning =
      "measured map: a NetCDF file that tools/strait_import made from an instrument's "
      "file, an .npy file, or a matrix of numbers below a header of units. A relative "
      "path starts at the folder of the scene file (with --set: at the current folder).";
    section.add_path("Second file", second_file).meaning =
      "map of the other body, if that is rough as well; it is turned over (x to -x) and "
      "added.";
    section.add("Height unit", height_unit, unit).meaning =
      "height that 1 in the file stands for; scene: the scene's unit of length; empty: "
      "what the file states, or the scene's if it states no unit at all.";
    section.add("Lateral unit", lateral_unit, unit).meaning =
      "length that 1 in the file's size stands for, likewise.";
    section.add("Largest missing share", largest_missing_share, not_negative.at_most(1.))
      .meaning =
      "largest fraction of missing points that is accepted [1]; they are filled by "
      "harmonic interpolation.";
    section.add("Windows", windows, any_number.at_least(1).at_most(1000)).meaning =
      "numbers of equal windows along x and y into which the map is cut [1]; one number: "
      "both. Seed is the number of the window that is used, counted along x from 1.";
    section.add("Detrend", detrend, Names{"none", "mean", "tilt", "curvature"}).meaning =
      "least-squares fit that is subtracted from the heights: mean, plane (tilt) or "
      "paraboloid (curvature).";
    section.add("Make periodic", make_periodic, Names{"no", "window", "mirror"}).meaning =
      "no: the map is one period as it is; window: heights fade to their "
      "mean at the edges; mirror: the map and its mirror images, twice as long and wide.";
    section.when("Make periodic = window")
      .add("Window width", window_width, positive.at_most(0.5))
      .meaning =
      "width of the rim in which heights fade at each edge, as a fraction of the side "
      "[1].";
    section.add("Resample", resample).meaning =
      "true: bring the map to Contact/Grid points by Fourier interpolation; false: the "
      "grid must be the map's.";
    section.add("Shortest wavelength", shortest_wavelength, not_negative).meaning =
      "waves shorter than this are removed [length]; 0: none.";
    section.add("Longest wavelength", longest_wavelength, not_negative).meaning =
      "waves longer than this are removed [length]; 0: none.";
  }

  void
  MapParameters::check() const
  {
    require(!file.empty(), "Surface/Kind = file needs a height map; set Surface/File.");
    require(!(longest_wavelength > 0. && longest_wavelength <= shortest_wavelength),
            "Surface/Longest wavelength (" + to_text(longest_wavelength) +
              ") must exceed the Shortest wavelength (" + to_text(shortest_wavelength) +
              "), or nothing is left.");
  }

  void
  MapParameters::check_window(const unsigned long long seed) const
  {
    const auto n = static_cast<unsigned long long>(windows[0]) * windows[1];
    require(n <= 1 || (seed >= 1 && seed <= n),
            "The seed " + std::to_string(seed) +
              " is none of the windows that Surface/Windows = " +
              std::to_string(windows[0]) + ", " + std::to_string(windows[1]) +
              " cuts the map into; they are numbered from 1 to " + std::to_string(n) +
              ".");
  }

  void
  SurfaceParameters::bind(ParameterSection section)
  {
    section
      .add("Kind",
           kind,
           Names{"self-affine",
                 "square saddle",
                 "triangular peaks",
                 "honeycomb peaks",
                 "sphere",
                 "sine",
                 "flat",
                 "expression",
                 "file"})
      .meaning = "The height profile h(x, y) of the rigid substrate.";
    section.add("Size", size, positive).meaning =
      "Lx, Ly: sides of the periodic box [length]; one number: a square. Kind = file, if "
      "empty: the size of the map.";
    // The theory alone needs heights only if their spectrum is asked for.
    ParameterSection heights = section.when(
      "Contact/Enabled = true | Fluid/Enabled = true | Theory/Spectrum = surface");
    heights.when("Kind = self-affine, file")
      .add("Seed", seed, not_negative.at_most(largest_seed))
      .meaning =
      "number of the random surface, which is the same on every grid and number of "
      "ranks, or of the window of a map.";
    ParameterSection of_law = section.when("Kind = self-affine");
    of_law.add("Hurst exponent", hurst_exponent, positive.at_most(1.)).meaning =
      "H [1]; the spectrum falls as q^(-2(1+H)).";
    of_law.add("Roll-off wavelength", roll_off_wavelength, positive).meaning =
      "longest wavelength of the self-affine range [length]; the spectrum is constant "
      "above it.";
    of_law.add("Short cut-off wavelength", short_cut_off_wavelength, positive).meaning =
      "shortest wavelength of the roughness [length].";
    heights.when("Kind = self-affine")
      .add("Amplitudes", amplitudes, Names{"gaussian", "fixed"})
      .meaning =
      "amplitudes of the waves drawn at random (gaussian), or equal "
      "to the spectrum with random phases only (fixed).";
    of_law.add("Normalisation", rms_is_of_height, Names{"rms slope", "rms height"})
      .meaning = "quantity that RMS value prescribes.";
    of_law.add("RMS value", rms_value, not_negative).meaning =
      "rms slope [1] or rms height [length]. With gaussian amplitudes it is the root of "
      "the mean square over all seeds, around which single surfaces scatter.";
    section.when("Kind = square saddle, triangular peaks, honeycomb peaks, sine, sphere")
      .add("Amplitude", amplitude, not_negative)
      .meaning = "amplitude Delta [length]; for a sphere its radius [length].";
    section.when("Kind = expression")
      .add("Expression",
           expression,
           Text{"text", [](const std::string &) { return true; }})
      .meaning =
      "height h [length] as a formula of x and y [length], in muParser's syntax, that "
      "should repeat with the box; pi and the sides lx and ly are known.";
    map.bind(section.when("Kind = file"));
    heights.add("Invert", invert).meaning = "Use -h instead of h.";
    heights.add("Rotate", rotate).meaning = "Rotate the surface by 90 degrees.";
  }

  void
  SurfaceParameters::check() const
  {
    if (kind == SurfaceKind::self_affine)
      check_spectrum(*this);
    else if (kind == SurfaceKind::file)
      map.check();
    else if (kind == SurfaceKind::expression)
      require(!expression.empty(),
              "Surface/Kind = expression needs a formula; set Surface/Expression.");
    else if (kind != SurfaceKind::flat)
      require(amplitude != 0.,
              "Surface/Amplitude is 0; choose Kind = flat for no roughness.");
    require(kind == SurfaceKind::file || map.file.empty(),
            "Surface/File is a map, but Surface/Kind is no file; set Kind = "
            "file, or remove File.");
  }

  bool
  SurfaceParameters::has_crease_near(const std::array<double, 2> &place,
                                     const double                 distance) const
  {
    const bool is_mirrored =
      kind == SurfaceKind::file && map.make_periodic == MakePeriodic::mirror;
    if (kind != SurfaceKind::sphere && !is_mirrored)
      return false;
    const auto is_near = [&](const int axis) {
      const double period = size[axis] / (is_mirrored ? 2 : 1);
      return std::abs(std::remainder(place[axis], period)) <= distance;
    };
    return is_near(0) || is_near(1);
  }

  std::string
  scene_number(const double value)
  {
    return format("%.9g", value);
  }

  std::string
  scene_pair(const SurfaceParameters &parameters, double along_x, double along_y)
  {
    if (parameters.rotate)
      std::swap(along_x, along_y);
    return scene_number(along_x) + ", " + scene_number(along_y);
  }
} // namespace strait
