// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/scene.h>
#include <strait/base/scene_text.h>
#include <strait/base/text.h>
#include <strait/base/units.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace strait
{
  namespace
  {
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
      const bool is_map = entry.section == std::vector<std::string>{"Surface"} &&
                          (entry.name == "File" || entry.name == "Second file");
      const bool is_mesh =
        entry.section == std::vector<std::string>{"Fluid"} && entry.name == "Mesh";
      if ((is_map || is_mesh) && !entry.value.empty())
        entry.value =
          (std::filesystem::path(entry.folder) / entry.value).lexically_normal().string();
    }
  } // namespace

  void
  Scene::declare(dealii::ParameterHandler &prm)
  {
    UnitParameters::declare(prm);
    SurfaceParameters::declare(prm);
    ContactParameters::declare(prm);
    FluidParameters::declare(prm);
    ProgrammeParameters::declare(prm);
    RealisationParameters::declare(prm);
    TheoryParameters::declare(prm);
    OutputParameters::declare(prm);
  }

  void
  Scene::parse(dealii::ParameterHandler &prm)
  {
    units.parse(prm);
    surface.parse(prm);
    surface.map.length_in_metres = units.length_in_metres();
    contact.parse(prm);
    fluid.parse(prm);
    programme.parse(prm);
    realisations.parse(prm);
    theory.parse(prm);
    output.parse(prm);
    std::ostringstream text;
    prm.print_parameters(text, in_order);
    resolved = text.str();
  }

  void
  Scene::check() const
  {
    units.check();
    surface.check();
    contact.check();
    fluid.check();
    programme.check();
    realisations.check();
    theory.check(*this);
    output.check();

    const bool by_load = contact.control == ContactControl::load;
    if (contact.enabled)
      for (const double value : programme.pressures)
        if (!(value > 0.) && !(contact.adhesion.enabled && by_load))
          throw InputError(
            "Load programme/Pressures contains " + to_text(value) +
            (by_load ? ", a load that never makes contact; give positive nominal "
                       "pressures."
                     : "; give positive mean gaps (Contact/Control = mean gap)."));
    if (programme.find_threshold && (!contact.enabled || !fluid.enabled || !by_load))
      throw InputError(
        "Load programme/Find threshold looks for a critical load; it needs "
        "Contact/Enabled, Fluid/Enabled and Contact/Control = load.");
    if (fluid.feedback.enabled && (!contact.enabled || !fluid.enabled))
      throw InputError(
        "Fluid/Wall feedback lets a fluid press on an elastic wall; it "
        "needs Contact/Enabled and Fluid/Enabled.");
    if (fluid.feedback.enabled && contact.adhesion.enabled)
      throw InputError(
        "Fluid/Wall feedback and Contact/Adhesion cannot be enabled "
        "together yet; switch one of them off.");
    if (programme.find_resealing && !programme.find_blow_out)
      throw InputError(
        "Load programme/Find re-sealing looks for the pressure at which a "
        "seal that has blown out closes again; it needs Find blow-out.");
    if (programme.find_blow_out &&
        (!fluid.feedback.enabled || contact.control != ContactControl::load))
      throw InputError(
        "Load programme/Find blow-out raises the inlet pressure until the "
        "fluid opens the seal; it needs Fluid/Wall feedback/Enabled and "
        "Contact/Control = load.");
    if (fluid.enabled && !fluid.mesh_file.empty() && output.error_budget)
      throw InputError(
        "Output/Error budget repeats the flow on coarser grids, which Fluid/Mesh does not "
        "support; switch one of them off.");
    if (fluid.enabled && !fluid.mesh_file.empty() && theory.enabled)
      throw InputError(
        "Theory/Enabled predicts the leak rate of the whole box and not of Fluid/Mesh; "
        "switch one of them off.");
    for (const std::string &name : output.leak_rate_units)
      {
        if (!units.are_complete())
          throw InputError("Output/Leak rate units = " + name +
                           " needs to know the scene's units; set Units/Length, Pressure "
                           "and Time.");
        if (find_leak_rate_unit(name)->is_throughput && !fluid.is_gas)
          throw InputError("Output/Leak rate units = " + name +
                           " is a throughput of gas; set Fluid/State = gas, or choose a "
                           "volume per time.");
      }
    if (!contact.enabled && !fluid.enabled && !theory.enabled)
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
