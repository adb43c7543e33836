// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>
#include <strait/interface/moment_set.h>
#include <strait/run/guards.h>

#include <deal.II/base/utilities.h>

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace strait
{
  namespace
  {
    constexpr double unlimited = std::numeric_limits<double>::infinity();

    /** Read the limit from a file, which holds a word instead if there is none. */
    double
    limit_in(const char *path)
    {
      std::ifstream file(path);
      double        limit = 0.;
      return file >> limit ? limit : unlimited;
    }

    /** Memory that the kernel can give to new processes without swapping [bytes]. */
    double
    available_memory()
    {
      std::ifstream file("/proc/meminfo");
      std::string   name, unit;
      double        kilobytes = 0.;
      while (file >> name >> kilobytes && std::getline(file, unit))
        if (name == "MemAvailable:")
          return 1024. * kilobytes;
      return unlimited;
    }
  } // namespace

  double
  memory_of_grid(const Scene &scene)
  {
    // Bytes per grid point: fields of the contact while it is solved, and those it keeps
    // during the flow, which takes two moment pyramids, the gap and the path search. One
    // load of prm/paper/fig1_full.prm takes 64 on 4096² points; the estimate is 68.
    const double gap      = 8.;
    const double of_metal = scene.contact.yields ? 24. : 0.;
    const double solved   = scene.contact.adhesion.enabled ? 113. : 44. + of_metal;
    const double kept     = scene.contact.adhesion.enabled ? 113. : 28. + of_metal;
    const double flow =
      2 * 8. / 12 * MomentSet(scene.fluid.element_degree).size() + 8. + 25.;
    const double of_flow =
      scene.fluid.enabled ? flow * (scene.has_two_boxes() ? 3. : 1.) : 0.;
    // The pressures of the last rounds and the harmonic extension, in addition to contact
    // and flow. Two loads of prm/pressurised_seal.prm take 240 on 1024² points, and 58
    // without feedback.
    const double of_feedback = scene.fluid.feedback.enabled ? 190. : 0.;
    // Windows near the critical load, and the coarser seal for their error: 193 in all on
    // the 4096² points of prm/paper/fig2a.prm with 8 roll-off wavelengths.
    const double of_windows = scene.contact.zoom.enabled ? 125. : 0.;
    // The seals on every second and every fourth point: 23 to 36 on 1024² to 4096²
    // points.
    const double of_coarser = scene.output.error_budget ? 36. : 0.;
    return static_cast<double>(scene.contact.grid_points[0]) *
           scene.contact.grid_points[1] *
           (scene.contact.enabled
              ? std::max(solved, kept + of_flow) + of_feedback + of_windows + of_coarser
              : gap + of_flow);
  }

  double
  free_memory()
  {
    rlimit       limit{};
    const double of_process =
      getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
        ? static_cast<double>(limit.rlim_cur)
        : unlimited;
    // The whole limit of a container, by either version of control groups. What it has
    // already taken is mostly cached files, which make room.
    return std::min({available_memory(),
                     limit_in("/sys/fs/cgroup/memory.max"),
                     limit_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"),
                     of_process});
  }

  double
  peak_memory(MPI_Comm comm)
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    return sum(comm, 1024. * static_cast<double>(stats.VmHWM));
  }

  void
  require_memory(const Scene &scene, MPI_Comm comm, const int n_grids)
  {
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    const int    n_here = n_ranks_in(machine), n_ranks = n_ranks_in(comm);
    const double available = minimum(machine, free_memory());
    MPI_Comm_free(&machine);
    const double      needed = n_grids * memory_of_grid(scene) * n_here / n_ranks;
    const std::string error =
      needed <= available
        ? ""
        : format(
            "%s of %d x %d points %s about %.3g GB of memory on this machine, and "
            "%.3g GB are free; reduce Contact/Grid points, or run on more machines.",
            n_grids == 1 ? "A grid" : format("%d grids", n_grids).c_str(),
            scene.contact.grid_points[0],
            scene.contact.grid_points[1],
            n_grids == 1 ? "takes" : "take",
            1e-9 * needed,
            1e-9 * available);
    throw_if_any(comm, error);
  }

  void
  require_bearable(const Scene &scene, const double load, const FluidParameters &fluid)
  {
    if (scene.units.pressure.empty() || !scene.contact.enabled ||
        !scene.contact.is_load_controlled())
      return;
    const char *unit = scene.units.pressure.c_str();
    if (load > scene.contact.effective_modulus)
      throw InputError(
        format("The nominal pressure of %.6g %s is more than the effective "
               "modulus of %.6g %s, and no solid bears that elastically; "
               "check the units of both.",
               load,
               unit,
               scene.contact.effective_modulus,
               unit));
    if (fluid.enabled && !fluid.feedback.enabled && !scene.contact.adhesion.enabled &&
        fluid.excess_pressure() > load)
      throw InputError(
        format("The fluid's pressure of %.6g %s exceeds the nominal pressure of "
               "%.6g %s and would lift the walls off, so that a leak rate without "
               "that means nothing; set Fluid/Wall feedback/Enabled = true, or "
               "raise the load.",
               fluid.excess_pressure(),
               unit,
               load,
               unit));
  }

  void
  check_numbers(const Scene &scene, Log &log)
  {
    for (const double load : scene.programme.pressures)
      require_bearable(scene, load, scene.fluid);
    // All in SI units; the limits are the smallest and the largest value of any seal.
    const auto check = [&log](const char  *name,
                              const double value,
                              const double smallest,
                              const double largest,
                              const char  *unit) {
      if (value < smallest || value > largest)
        log.warn(
          format("%s is %.4g %s, which is outside of what seals have, %.3g to %.3g %s; "
                 "check the section Units and the powers of ten.",
                 name,
                 value,
                 unit,
                 smallest,
                 largest,
                 unit));
    };
    if (!scene.units.length.empty())
      for (const double side : scene.surface.size)
        check("Surface/Size",
              side * metres_in(scene.units.length).value_or(1.),
              1e-8, // a few waves, each some atoms long
              .1,   // waves of micrometres are no longer resolved
              "m");
    if (scene.units.pressure.empty())
      return;
    const double pascals = *pascals_in(scene.units.pressure);
    if (scene.contact.enabled)
      check("the effective modulus",
            scene.contact.effective_modulus * pascals,
            1e3,  // gels
            2e12, // diamond on diamond
            "Pa");
    if (scene.fluid.enabled && !scene.units.time.empty())
      check("Fluid/Viscosity",
            scene.fluid.viscosity * pascals * *seconds_in(scene.units.time),
            1e-6, // hydrogen, cold: 5e-6
            1e5,  // pitch is above, and takes years to flow
            "Pa s");
  }

  void
  check_slope(const Scene &scene, const double rms_slope, Log &log)
  {
    // An rms slope of 1 is an angle of 45°. No surface onto which a solid can be pressed
    // has one of 10, or 84°: its heights and lengths are in different units.
    constexpr double steep = 1., impossible = 10.;
    if (!scene.has_physical_modulus() || !(rms_slope > steep))
      return;
    const std::string finding = format("The surface has a rms slope of %.4g", rms_slope);
    if (rms_slope > impossible && !scene.units.length.empty())
      throw InputError(finding +
                       ", which no surface has: its heights and Surface/Size are not in "
                       "the same unit.");
    log.warn(finding +
             ", where neither the elasticity nor the flow of small slopes holds; "
             "check the units of its heights and of Surface/Size.");
  }
} // namespace strait
