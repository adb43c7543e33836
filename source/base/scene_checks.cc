// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/scene.h>
#include <strait/base/text.h>

#include <algorithm>

namespace strait
{
  namespace
  {
    void
    check_programme(const Scene &scene)
    {
      const bool by_load = scene.contact.is_load_controlled();
      require(!scene.programme.find_threshold ||
                (scene.contact.enabled && scene.fluid.enabled && by_load &&
                 scene.surface.kind != SurfaceKind::flat),
              "Load programme/Find threshold looks for a critical load; it needs a "
              "surface that is not flat, Contact/Enabled, Fluid/Enabled and "
              "Contact/Control = load.");
      require(!scene.programme.find_blow_out || (scene.fluid.feedback.enabled && by_load),
              "Load programme/Find blow-out raises the inlet pressure until the "
              "fluid opens the seal; it needs Fluid/Wall feedback/Enabled and "
              "Contact/Control = load.");
    }

    void
    check_pressures(const Scene &scene)
    {
      const ContactParameters &contact = scene.contact;
      const bool               by_load = contact.is_load_controlled();
      for (const double value : scene.programme.pressures)
        {
          const auto require_here = [value](const bool         condition,
                                            const std::string &why) {
            require(condition,
                    "Load programme/Pressures contains " + to_text(value) + why);
          };
          require_here(
            value > 0. || !contact.enabled || (contact.adhesion.enabled && by_load),
            by_load
              ? ", a load that never makes contact; give positive nominal pressures."
              : "; give positive mean gaps (Contact/Control = mean gap).");
          require_here(value > 0. || !scene.is_theory_only(),
                       ", at which the theory has no contact; give positive nominal "
                       "pressures.");
          require_here(value > 0. || !scene.programme.find_blow_out,
                       ", but Find blow-out needs loads that press the seal shut; give "
                       "positive ones.");
          require_here(value < contact.hardness || contact.hardness == 0. ||
                         !contact.yields,
                       ", which Contact/Hardness = " + to_text(contact.hardness) +
                         " cannot bear even where all of the area is in contact; give "
                         "nominal pressures below it.");
        }
    }

    void
    check_leak_rate_units(const Scene &scene)
    {
      require(!has_repetitions(scene.output.leak_rate_units),
              "Output/Leak rate units names a unit twice; remove one of them.");
      for (const std::string &name : scene.output.leak_rate_units)
        {
          require(scene.units.are_complete(),
                  "Output/Leak rate units = " + name +
                    " needs to know the scene's units; set Units/Length, Pressure "
                    "and Time.");
          require(scene.fluid.is_gas || !find_row(leak_rate_units, name)->is_throughput,
                  "Output/Leak rate units = " + name +
                    " is a throughput of gas; set Fluid/State = gas, or choose a "
                    "volume per time.");
        }
    }

    void
    check_theory(const Scene &scene)
    {
      const TheoryParameters &theory = scene.theory;
      if (!theory.enabled)
        return;
      const bool simulates = scene.contact.enabled || scene.fluid.enabled;
      require(theory.spectrum_of_surface ||
                scene.surface.kind == SurfaceKind::self_affine,
              "Theory/Spectrum = model needs Surface/Kind = self-affine; set "
              "Theory/Spectrum = surface for other kinds.");
      require(!theory.simulated_gaps || simulates,
              "Theory/Gap distribution = simulated needs a simulation; enable "
              "Contact or Fluid, or take persson.");
      require(theory.simulated_gaps || scene.contact.enabled || !simulates,
              "Theory/Gap distribution = persson needs a load, and with "
              "Contact/Enabled = false there is none; take simulated.");
      require(theory.dimension != TheoryDimension::from_threshold ||
                scene.programme.find_threshold,
              "Theory/Dimension parameter = from threshold needs the critical "
              "load; set Load programme/Find threshold = true.");
      require(theory.dimension != TheoryDimension::from_threshold ||
                !theory.simulated_gaps || !scene.fluid.has_slip(),
              "Theory/Dimension parameter = from threshold knows the simulated "
              "contact fraction at the threshold, not what a slip length "
              "blocks; take Gap distribution = persson or no slip length.");
      require(simulates || scene.contact.is_load_controlled(),
              "Theory/Enabled without Contact and Fluid takes Load programme/"
              "Pressures as loads; set Contact/Control = load.");
    }

    /** Refuse what a contact that yields cannot be combined with, and say why. */
    void
    check_yielding(const Scene &scene)
    {
      const ContactParameters &contact = scene.contact;
      if (!contact.yields || !(contact.enabled || scene.is_theory_only()))
        return;
      const auto require_here = [](const bool condition, const std::string &reason) {
        require(condition, "Contact/Yielding = cut-off " + reason);
      };
      require_here(contact.hardness > 0.,
                   "needs to know at which pressure; set Contact/Hardness.");
      require_here(
        !contact.adhesion.enabled,
        "bounds the pressure, and a contact with adhesion is solved for the gap, by "
        "each of its solvers; switch Contact/Adhesion off.");
      require_here(
        contact.method == ContactMethod::dual_cg,
        "needs a solver that knows such a bound; set Contact/Solver = dual CG.");
      require_here(contact.is_load_controlled(),
                   "changes the surface that a mean gap is counted from; set "
                   "Contact/Control = load.");
      require_here(
        !contact.zoom.enabled,
        "leaves indentations that are known on the points where they were made only, "
        "and windows of finer points come and go; switch Contact/Zoom off.");
      require_here(
        !scene.fluid.feedback.enabled,
        "would indent the surface by pressures of contact and fluid that do not agree "
        "yet; switch Fluid/Wall feedback off.");
      const std::vector<double> &pressures = scene.programme.pressures;
      require_here(
        !scene.programme.find_threshold || scene.programme.path != LoadPath::unloading ||
          (!pressures.empty() &&
           pressures.front() == *std::max_element(pressures.begin(), pressures.end())),
        "opens the later the larger the load was before: where Load programme/Path = "
        "unloading, a search for the threshold begins with the first of "
        "Load programme/Pressures, which must be the largest.");
    }

    /** Check that each seed gives another surface; those of a measured map are windows of
     *  it. */
    void
    check_windows(const Scene &scene)
    {
      const MapParameters                   &map   = scene.surface.map;
      const std::vector<unsigned long long> &seeds = scene.realisations.seeds;
      if (scene.surface.kind != SurfaceKind::file)
        {
          const bool has_heights =
            scene.surface.kind == SurfaceKind::self_affine &&
            (!scene.is_theory_only() || scene.theory.spectrum_of_surface);
          require(
            seeds.size() <= 1 || has_heights,
            "Realisations/Seeds are of random surfaces and windows of maps; others, or "
            "the theory of a model spectrum alone, would be copies that falsify the "
            "scatter, give one seed.");
          return;
        }
      if (seeds.empty())
        map.check_window(scene.surface.seed);
      for (const unsigned long long seed : seeds)
        map.check_window(seed);
      require(
        seeds.size() <= 1 || map.windows != std::array<int, 2>{{1, 1}},
        "Realisations/Seeds of a measured map are windows of it; set Surface/Windows, "
        "or they would be copies.");
    }

    /** Check that only one of the sections Surface and Realisations turns the surface. */
    void
    check_orientations(const Scene &scene)
    {
      const int turned = (scene.surface.invert ? 1 : 0) + (scene.surface.rotate ? 2 : 0);
      require(!scene.realisations.enabled() || turned == 0,
              "Surface/Invert and Rotate are of one run, and Realisations are several; "
              "remove them and name what turns these in Realisations/Orientations, as "
              "they would: " +
                name_of(turned) + ".");
    }

    /** Check that a whole seal has leak rates of boxes under loads, and at least two
     *  patches along the flow. */
    void
    check_whole_seal(const Scene &scene)
    {
      if (!scene.seal.enabled)
        return;
      require(scene.contact.enabled && scene.fluid.enabled &&
                scene.contact.is_load_controlled() &&
                !scene.programme.pressures.empty() && scene.fluid.mesh_file.empty(),
              "Seal/Enabled needs leak rates of boxes under loads: Contact/Enabled, "
              "Fluid/Enabled, Contact/Control = load, Load programme/Pressures, and no "
              "Fluid/Mesh.");
      const auto &orientations = scene.realisations.orientations;
      const auto  n_along =
        scene.seal.isotropic
           ? orientations.size()
           : orientations.size() -
              std::count_if(orientations.begin(), orientations.end(), is_rotated);
      require(
        std::max<std::size_t>(scene.realisations.seeds.size(), 1) * n_along > 1,
        "Seal/Enabled needs at least two patches along the flow to tell how they "
        "scatter; set Realisations/Seeds, which of a measured map are its Surface/Windows, or "
        "Orientations.");
    }

    /** Refuse what windows of finer points cannot be combined with, and say why. */
    void
    check_zoom(const Scene &scene)
    {
      if (!scene.contact.zoom.enabled)
        return;
      const auto require_here = [](const bool condition, const std::string &reason) {
        require(condition, "Contact/Zoom " + reason);
      };
      require_here(
        scene.contact.enabled && scene.fluid.enabled &&
          scene.contact.is_load_controlled(),
        "resolves the throats of a contact that a fluid flows through; it needs "
        "Contact/Enabled, Fluid/Enabled and Contact/Control = load.");
      require_here(
        !scene.contact.adhesion.enabled,
        "solves for the pressure, which does not determine the state of a contact "
        "with adhesion; switch Contact/Adhesion off.");
      require_here(
        !scene.fluid.feedback.keeps_trapped_fluid(),
        "has windows that come and go, and regions of trapped fluid are known on the points "
        "where they formed; set Fluid/Wall feedback/Trapped fluid = drained.");
      require_here(
        scene.fluid.mesh_file.empty(),
        "follows the flow through the box and not through Fluid/Mesh; remove one "
        "of them.");
      // A window fits into a grid that is as wide as its margins, see ZoomWindow::margin.
      require_here(std::min(scene.contact.grid_points[0], scene.contact.grid_points[1]) >=
                     8,
                   "needs Contact/Grid points of 8 or more.");
    }
  } // namespace

  void
  Scene::check() const
  {
    surface.check();
    contact.adhesion.check();
    fluid.check();
    programme.check();
    realisations.check();
    seal.check();
    check_windows(*this);
    check_orientations(*this);
    check_whole_seal(*this);
    require(
      !seal.two_in_a_row || can_flow_in_a_row(),
      "Seal/Two in a row needs a flow along x that is linear in the pressure and leaves "
      "the gap as it is: no Fluid/Mesh, Rarefaction or Wall feedback, no Contact/Zoom.");
    check_programme(*this);
    check_theory(*this);
    check_yielding(*this);
    check_pressures(*this);
    check_zoom(*this);
    check_leak_rate_units(*this);

    require(!fluid.feedback.enabled || (contact.enabled && fluid.enabled),
            "Fluid/Wall feedback lets a fluid press on an elastic wall; it "
            "needs Contact/Enabled and Fluid/Enabled.");
    require(
      !fluid.feedback.enabled || fluid.slip_lengths.size() <= 1,
      "Fluid/Wall feedback follows one path of states, which is another one for each "
      "Slip length; give one, and run the others by themselves.");
    const bool has_mesh = fluid.enabled && !fluid.mesh_file.empty();
    require(
      !has_mesh || !output.error_budget,
      "Output/Error budget repeats the flow on coarser grids, which Fluid/Mesh does not "
      "support; switch one of them off.");
    require(
      fluid.mesh_file.empty() || !theory.enabled,
      "Theory/Enabled predicts the leak rate of the whole box and not of Fluid/Mesh; "
      "switch one of them off.");
    require(
      contact.enabled || is_theory_only() ||
        !(contact.adhesion.enabled || contact.yields),
      "Contact/Adhesion and Yielding are of a contact, and Contact/Enabled = false; "
      "switch either off, or the contact on.");
    require(contact.enabled || fluid.enabled || theory.enabled,
            "Contact/Enabled and Fluid/Enabled are both false, so there is "
            "nothing to compute.");
  }
} // namespace strait
