// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/scene.h>
#include <strait/base/scene_text.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace strait
{
  namespace
  {
    const Choices<FieldOutput> field_outputs = {{FieldOutput::none, "none"},
                                                {FieldOutput::last, "last"},
                                                {FieldOutput::all, "all"}};

    const Choices<LoadPath> load_paths = {{LoadPath::loading, "loading"},
                                          {LoadPath::unloading, "unloading"}};

    const Choices<Orientation> orientation_names = {{Orientation::as_is, "as is"},
                                                    {Orientation::inverted, "inverted"},
                                                    {Orientation::rotated, "rotated"},
                                                    {Orientation::inverted_and_rotated,
                                                     "inverted and rotated"}};

    std::vector<double>
    parse_list(const std::string &text)
    {
      std::vector<double> values;
      for (const std::string &value : split(text, ','))
        if (!value.empty())
          values.push_back(std::stod(value));
      return values;
    }

    const auto in_order = dealii::ParameterHandler::ShortText |
                          dealii::ParameterHandler::KeepDeclarationOrder;

    std::string
    read_file(const std::string &path)
    {
      if (std::filesystem::is_directory(path))
        throw InputError("The scene '" + path + "' is a folder; give a .prm file.");
      std::ifstream in(path);
      if (!in)
        throw InputError("Cannot read the scene file '" + path +
                         "'; check the path and its permissions.");
      std::ostringstream text;
      text << in.rdbuf();
      return text.str();
    }

    /** A path in a scene counts from the scene's folder, not from where we are. */
    void
    anchor_path(SceneEntry &entry)
    {
      const bool is_path = entry.section == std::vector<std::string>{"Surface"} &&
                           entry.name == "File" && !entry.value.empty();
      if (is_path)
        entry.value =
          (std::filesystem::path(entry.folder) / entry.value).lexically_normal().string();
    }
  } // namespace

  void
  ProgrammeParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Load programme");
    prm.declare_entry(
      "Pressures",
      "0.05, 0.1",
      List(Double()),
      "One step each, in this order: nominal pressures [pressure], or mean "
      "gaps [length] if Contact/Control = mean gap.");
    prm.declare_entry(
      "Find threshold",
      "false",
      Bool(),
      "Find the critical load L_c, the largest at which an open channel connects "
      "inlet and outlet, before the steps; the table then has the column "
      "reduced_load.");
    prm.declare_entry("Threshold tolerance",
                      "1e-4",
                      Double(),
                      "Relative width of the bracket of L_c, between 1e-9 and 0.1 [1].");
    prm.declare_entry(
      "Reduced loads",
      "",
      List(Double()),
      "Further steps at these values of 1 - L/L_c, once L_c is known [1].");
    prm.declare_entry(
      "Largest reduced load of fits",
      "0.02",
      Double(),
      "Exponents are fitted to the steps up to this value of 1 - L/L_c [1].");
    prm.declare_entry(
      "Path",
      load_paths.name(LoadPath::loading),
      Selection(load_paths.pattern()),
      "From which side the threshold is approached, and the order of the steps at "
      "Reduced loads: loading (towards larger loads) or unloading.");
    prm.leave_subsection();
  }

  void
  ProgrammeParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Load programme");
    pressures           = parse_list(prm.get("Pressures"));
    find_threshold      = prm.get_bool("Find threshold");
    threshold_tolerance = prm.get_double("Threshold tolerance");
    reduced_loads       = parse_list(prm.get("Reduced loads"));
    largest_fitted      = prm.get_double("Largest reduced load of fits");
    path                = load_paths.value(prm.get("Path"));
    prm.leave_subsection();
  }

  void
  ProgrammeParameters::check() const
  {
    if (pressures.empty() && !find_threshold)
      throw InputError("Load programme/Pressures is empty; list at least one value.");
    if (!(threshold_tolerance >= 1e-9 && threshold_tolerance <= 0.1))
      throw InputError("Load programme/Threshold tolerance is " +
                       to_text(threshold_tolerance) +
                       " but must lie between 1e-9 and 0.1.");
    if (!reduced_loads.empty() && !find_threshold)
      throw InputError(
        "Load programme/Reduced loads needs the critical load; set Find "
        "threshold = true.");
    for (const double value : reduced_loads)
      if (!(value > 0. && value < 1.))
        throw InputError("Load programme/Reduced loads contains " + to_text(value) +
                         " but 1 - L/L_c must lie between 0 and 1.");
  }

  std::string
  name_of(const Orientation orientation)
  {
    return orientation_names.name(orientation);
  }

  void
  RealisationParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Realisations");
    prm.declare_entry(
      "Seeds",
      "",
      List(Integer(0)),
      "Run the scene for each of these seeds instead of Surface/Seed, each "
      "with its own folder of results; compare them in ensemble.csv.");
    prm.declare_entry("Orientations",
                      orientation_names.name(Orientation::as_is),
                      List(Selection(orientation_names.pattern()), 1),
                      "Run each seed in these orientations, which replace Surface/Invert "
                      "and Surface/Rotate.");
    prm.leave_subsection();
  }

  void
  RealisationParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Realisations");
    seeds.clear();
    for (const std::string &value : split(prm.get("Seeds"), ','))
      if (!value.empty())
        seeds.push_back(std::stoull(value));
    orientations.clear();
    for (const std::string &value : split(prm.get("Orientations"), ','))
      orientations.push_back(orientation_names.value(value));
    prm.leave_subsection();
  }

  void
  RealisationParameters::check() const
  {
    const std::set<unsigned long long> different_seeds(seeds.begin(), seeds.end());
    const std::set<Orientation> different(orientations.begin(), orientations.end());
    if (different_seeds.size() != seeds.size() || different.size() != orientations.size())
      throw InputError(
        "Realisations lists a seed or an orientation twice; the copies would "
        "falsify the scatter, remove them.");
  }

  void
  OutputParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Output");
    prm.declare_entry("Directory",
                      "output",
                      Anything(),
                      "Folder of the results, made if it does not exist; a relative path "
                      "starts at the current folder.");
    prm.declare_entry(
      "Fields",
      field_outputs.name(FieldOutput::none),
      Selection(field_outputs.pattern()),
      "Steps whose fields are written: gap, pressure and labels on the grid "
      "(HDF5), the flow on its mesh (VTU).");
    prm.declare_entry(
      "Pictures",
      "true",
      Bool(),
      "Draw a picture of each step and of the leak rate against the load.");
    prm.leave_subsection();
  }

  void
  OutputParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    directory = prm.get("Directory");
    fields    = field_outputs.value(prm.get("Fields"));
    pictures  = prm.get_bool("Pictures");
    prm.leave_subsection();
  }

  void
  OutputParameters::check() const
  {
    if (directory.empty())
      throw InputError("Output/Directory is empty; name a folder for the results.");
  }

  void
  Scene::declare(dealii::ParameterHandler &prm)
  {
    SurfaceParameters::declare(prm);
    ContactParameters::declare(prm);
    FluidParameters::declare(prm);
    ProgrammeParameters::declare(prm);
    RealisationParameters::declare(prm);
    OutputParameters::declare(prm);
  }

  void
  Scene::parse(dealii::ParameterHandler &prm)
  {
    surface.parse(prm);
    contact.parse(prm);
    fluid.parse(prm);
    programme.parse(prm);
    realisations.parse(prm);
    output.parse(prm);
    std::ostringstream text;
    prm.print_parameters(text, in_order);
    resolved = text.str();
  }

  void
  Scene::check() const
  {
    surface.check();
    contact.check();
    fluid.check();
    programme.check();
    realisations.check();
    output.check();

    if (contact.enabled)
      for (const double value : programme.pressures)
        if (!(value > 0.))
          throw InputError(
            "Load programme/Pressures contains " + to_text(value) +
            (contact.control == ContactControl::load
               ? ", a load that never makes contact; give positive nominal "
                 "pressures."
               : "; give positive mean gaps (Contact/Control = mean gap)."));
    if (programme.find_threshold &&
        (!contact.enabled || !fluid.enabled || contact.control != ContactControl::load))
      throw InputError(
        "Load programme/Find threshold looks for a critical load; it needs "
        "Contact/Enabled, Fluid/Enabled and Contact/Control = load.");
    if (!contact.enabled && !fluid.enabled)
      throw InputError(
        "Contact/Enabled and Fluid/Enabled are both false, so there is "
        "nothing to compute.");
  }

  std::vector<std::string>
  Scene::warnings() const
  {
    const double shorter_side = std::min(surface.size[0], surface.size[1]);
    if (surface.kind == SurfaceKind::self_affine &&
        surface.roll_off_wavelength > shorter_side)
      return {
        "Surface/Roll-off wavelength exceeds the shorter side of the box, so the "
        "surface is not isotropic."};
    return {};
  }

  Scene
  read_scene(const std::string &path, const Overrides &overrides)
  {
    // Files and the current folder are rank 0's; from the broadcast on, every
    // rank does the same with the same text and meets the same errors.
    namespace fs = std::filesystem;
    std::string text, folder, here;
    run_on_root(MPI_COMM_WORLD, [&]() {
      text   = read_file(path);
      here   = fs::current_path().string();
      folder = fs::absolute(path).parent_path().string();
    });
    text   = broadcast(MPI_COMM_WORLD, text);
    folder = broadcast(MPI_COMM_WORLD, folder);
    here   = broadcast(MPI_COMM_WORLD, here);

    std::vector<SceneEntry> entries = lex_scene(text, path, folder);
    for (const std::string &override_text : overrides)
      entries.push_back(lex_override(override_text, here));

    dealii::ParameterHandler prm;
    Scene::declare(prm);
    const ParameterTable table(prm);
    for (SceneEntry &entry : entries)
      {
        anchor_path(entry);
        table.assign(prm, entry);
      }
    Scene scene;
    scene.parse(prm);
    scene.check();
    return scene;
  }

  void
  print_parameters(std::ostream &out, const std::string &format)
  {
    dealii::ParameterHandler prm;
    Scene::declare(prm);
    if (format == "md")
      print_markdown(out, ParameterTable(prm));
    else if (format == "prm")
      prm.print_parameters(out,
                           dealii::ParameterHandler::Text |
                             dealii::ParameterHandler::KeepDeclarationOrder);
    else
      throw InputError("--parameters " + format + ": the formats are prm and md.");
  }
} // namespace strait
