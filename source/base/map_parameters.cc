// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/map_parameters.h>
#include <strait/base/text.h>
#include <strait/base/units.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<MapFormat> formats = {{MapFormat::by_content, "auto"},
                                        {MapFormat::npy, "npy"},
                                        {MapFormat::text, "text"},
                                        {MapFormat::xyz, "xyz"},
                                        {MapFormat::netcdf, "netcdf"},
                                        {MapFormat::hdf5, "hdf5"},
                                        {MapFormat::x3p, "x3p"},
                                        {MapFormat::sdf, "sdf"}};

    const Choices<Detrend> detrends = {{Detrend::none, "none"},
                                       {Detrend::mean, "mean"},
                                       {Detrend::tilt, "tilt"},
                                       {Detrend::curvature, "curvature"}};

    const Choices<MakePeriodic> periodic_ways = {{MakePeriodic::no, "no"},
                                                 {MakePeriodic::window, "window"},
                                                 {MakePeriodic::mirror, "mirror"}};

    void
    declare_reading(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      const MapParameters standard;
      prm.declare_entry(
        "File",
        "",
        Anything(),
        "Kind = file: a measured map (.npy, text, XYZ, NetCDF, HDF5, X3P, SDF); a "
        "relative path starts at the folder of the scene file (with --set: at the "
        "current folder).");
      prm.declare_entry(
        "Second file",
        "",
        Anything(),
        "Kind = file: the map of the other body, if that is rough as well; turned over "
        "(x to -x) and added.");
      prm.declare_entry("Format",
                        formats.name(standard.format),
                        Selection(formats.pattern()),
                        "Kind = file: format of the file; auto: by its content, XYZ by "
                        "its extension.");
      prm.declare_entry("Dataset",
                        "",
                        Anything(),
                        "Kind = file: path of the data set of an HDF5 file or variable "
                        "of a NetCDF file; empty: the only one with two dimensions.");
      prm.declare_entry(
        "Height unit",
        "",
        Anything(),
        "Kind = file: what 1 in the file is high, such as nm, 63.1 nm or scene (the "
        "scene's unit of length); empty: what the file states, or the scene's if it "
        "states no unit at all.");
      prm.declare_entry("Lateral unit",
                        "",
                        Anything(),
                        "Kind = file: the same of the size that the file states.");
      prm.declare_entry("Largest missing share",
                        to_text(standard.largest_missing_share),
                        Double(0., 1.),
                        "Kind = file: missing points are filled by harmonic "
                        "interpolation if they are not more than this share of all [1].");
    }

    void
    declare_processing(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      const MapParameters standard;
      prm.declare_entry("Detrend",
                        detrends.name(standard.detrend),
                        Selection(detrends.pattern()),
                        "Kind = file: subtract the mean, the plane (tilt) or the "
                        "paraboloid (curvature) of least squares.");
      prm.declare_entry(
        "Make periodic",
        periodic_ways.name(standard.make_periodic),
        Selection(periodic_ways.pattern()),
        "Kind = file: no: the map is one period as it is; window: heights fade to their "
        "mean at the edges; mirror: the map and its mirror images, twice as long and "
        "wide.");
      prm.declare_entry("Window width",
                        to_text(standard.window_width),
                        Double(),
                        "Make periodic = window: share of the sides over which heights "
                        "fade, at each edge, at most 0.5 [1].");
      prm.declare_entry("Resample",
                        "false",
                        Bool(),
                        "Kind = file: bring the map to Contact/Grid points by Fourier "
                        "interpolation; false: the grid must be the map's.");
      prm.declare_entry("Shortest wavelength",
                        to_text(standard.shortest_wavelength),
                        Double(0.),
                        "Kind = file: waves shorter than this are removed; 0: none "
                        "[length].");
      prm.declare_entry("Longest wavelength",
                        to_text(standard.longest_wavelength),
                        Double(0.),
                        "Kind = file: waves longer than this are removed; 0: none "
                        "[length].");
    }

    void
    check_unit(const std::string &name, const std::string &value)
    {
      if (!value.empty() && value != "scene" && !parse_length_unit(value).metres)
        throw InputError("Surface/" + name + " is '" + value +
                         "', which is no length; give one of " + length_units +
                         ", a multiple such as 63.1 nm, or scene.");
    }
  } // namespace

  void
  MapParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_reading(prm);
    declare_processing(prm);
  }

  void
  MapParameters::parse(dealii::ParameterHandler &prm)
  {
    file                  = prm.get("File");
    second_file           = prm.get("Second file");
    format                = formats.value(prm.get("Format"));
    dataset               = prm.get("Dataset");
    height_unit           = prm.get("Height unit");
    lateral_unit          = prm.get("Lateral unit");
    largest_missing_share = prm.get_double("Largest missing share");
    detrend               = detrends.value(prm.get("Detrend"));
    make_periodic         = periodic_ways.value(prm.get("Make periodic"));
    window_width          = prm.get_double("Window width");
    resample              = prm.get_bool("Resample");
    shortest_wavelength   = prm.get_double("Shortest wavelength");
    longest_wavelength    = prm.get_double("Longest wavelength");
  }

  void
  MapParameters::check() const
  {
    if (file.empty())
      throw InputError("Surface/Kind = file needs a height map; set Surface/File.");
    check_unit("Height unit", height_unit);
    check_unit("Lateral unit", lateral_unit);
    if (!(window_width > 0. && window_width <= 0.5))
      throw InputError("Surface/Window width is " + to_text(window_width) +
                       " but must lie above 0 and not above 0.5.");
    if (longest_wavelength > 0. && longest_wavelength <= shortest_wavelength)
      throw InputError("Surface/Longest wavelength (" + to_text(longest_wavelength) +
                       ") must exceed the Shortest wavelength (" +
                       to_text(shortest_wavelength) + "), or nothing is left.");
  }
} // namespace strait
