// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/base/rounding.h>
#include <strait/base/text.h>
#include <strait/run/field_output.h>
#include <strait/run/guards.h>
#include <strait/run/load_sweep.h>
#include <strait/run/result_tables.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/map_processing.h>
#include <strait/surface/map_writer.h>
#include <strait/surface/read_scene.h>
#include <strait/surface/self_affine_surface.h>
#include <strait/surface/statistics.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  namespace
  {
    void
    report_spectrum(const SlabField &heights, Log &log)
    {
      const auto fit = fit_self_affine(radial_spectrum(heights));
      if (!fit)
        {
          log.line("spectrum: too few waves for an estimate of the Hurst exponent");
          return;
        }
      log.line(
        format("spectrum: Hurst exponent %.3f ± %.3f for wavelengths from %.4g down "
               "to %.4g",
               fit->hurst_exponent,
               fit->hurst_error,
               2 * M_PI / (fit->has_roll_off ? fit->roll_off : fit->q_from),
               2 * M_PI / fit->q_to) +
        (fit->has_roll_off
           ? format(", roll-off wavelength %.4g", 2 * M_PI / fit->roll_off)
           : std::string(", no roll-off")));
    }

    void
    write_spectrum(const Scene &scene, const SlabField &heights)
    {
      std::vector<SpectrumRow> rows;
      const auto               spectrum = radial_spectrum(heights);
      const auto               fit      = fit_self_affine(spectrum);
      for (const SpectrumBin &bin : spectrum)
        {
          double law = std::nan("");
          if (fit && bin.q <= fit->q_to * (1 + rounding))
            law = fit->plateau * std::pow(std::max(bin.q / fit->roll_off, 1.),
                                          -2 * (1 + fit->hurst_exponent));
          rows.push_back({{bin}, law});
        }
      run_on_root(heights.layout().communicator(), [&]() {
        spectrum_table(scene).write_rows(scene.output.directory, rows);
      });
    }

    /** Report statistics of the heights. Throws InputError for a slope that no surface
     *  has, and for a contact with constant heights unless the kind is flat. */
    void
    report_surface(const Scene &scene, const SlabField &heights, Log &log)
    {
      const SurfaceStatistics surface = statistics(heights);
      log.line(
        format("surface: rms height %.5g, rms slope %.5g, rms curvature %.5g, "
               "heights from %.5g to %.5g",
               surface.rms_height,
               surface.rms_slope,
               surface.rms_curvature,
               surface.lowest,
               surface.highest));
      check_slope(scene, surface.rms_slope, log);
      require(!scene.contact.enabled || scene.surface.kind == SurfaceKind::flat ||
                surface.highest > surface.lowest,
              "The surface has the same height everywhere and would seal under any load; "
              "mend Surface/File, Expression or the wavelengths that are kept, or choose "
              "Kind = flat.");
      const PeriodicGrid &grid = heights.grid();
      if (scene.surface.kind == SurfaceKind::self_affine)
        log.line(
          format("resolution: λs/a = %.4g, λr/λs = %.4g, L/λr = %.4g",
                 scene.surface.short_cut_off_wavelength / std::max(grid.dx(), grid.dy()),
                 scene.surface.roll_off_wavelength /
                   scene.surface.short_cut_off_wavelength,
                 std::min(grid.lx, grid.ly) / scene.surface.roll_off_wavelength));
      if (scene.surface.kind == SurfaceKind::file || scene.output.surface_spectrum)
        report_spectrum(heights, log);
    }

    /** Warn if the grid can be halved so seldom that the coarsest mesh has many cells. */
    void
    warn_of_large_coarsest_mesh(const Scene &scene, Log &log)
    {
      // Cells with which each mesh then has to start: half of it is still solved in no
      // time, double of it is felt at every load.
      constexpr std::int64_t many       = 10000;
      const PeriodicGrid     grid       = grid_of(scene);
      const std::int64_t     n_coarsest = grid.n_points() >> (2 * grid.n_halvings());
      if (scene.fluid.enabled && n_coarsest > many)
        log.warn(
          "the coarsest mesh of this grid has " + std::to_string(n_coarsest) +
          " cells, which costs time and memory: choose numbers of grid points that "
          "can be halved several times");
    }
  } // namespace

  SlabField
  make_heights(const Scene &scene, MPI_Comm comm, Log &log)
  {
    const PeriodicGrid grid = grid_of(scene);
    for (const std::string &warning : scene.warnings())
      log.warn(warning);
    check_numbers(scene, log);
    require_memory(scene, comm);
    for (const std::string &warning : check_resolution(scene.surface, grid))
      log.warn(warning);
    warn_of_large_coarsest_mesh(scene, log);
    warn_of_unknown_grid_error(scene, grid, log);
    if (!scene.fluid.gas.empty())
      log.line(format("gas: %s, viscosity %.6g",
                      scene.fluid.gas.c_str(),
                      scene.fluid.viscosity));
    const int n_ranks = n_ranks_in(comm);
    log.line(format("grid %d × %d on a box of %.6g × %.6g, %d %s",
                    grid.nx,
                    grid.ny,
                    grid.lx,
                    grid.ly,
                    n_ranks,
                    n_ranks == 1 ? "rank" : "ranks"));
    if (!scene.contact.young_moduli.empty())
      log.line(format("contact modulus E* = %.6g", scene.contact.effective_modulus) +
               (scene.units.pressure.empty() ? "" : " " + scene.units.pressure));
    log.stage("surface");
    Remarks   remarks;
    SlabField heights = make_surface(scene.surface, make_layout(grid, comm), &remarks);
    log.stage("");
    for (const std::string &note : remarks.notes)
      log.line(note);
    for (const std::string &warning : remarks.warnings)
      log.warn(warning);
    report_surface(scene, heights, log);
    return heights;
  }

  void
  write_surface(const Scene &scene, const SlabField &heights)
  {
    const std::string &folder = scene.output.directory;
    if (scene.output.surface_map)
      write_netcdf_map(folder + "/surface.nc", heights, scene.units.length);
    if (scene.output.surface_spectrum)
      write_spectrum(scene, heights);
  }

  void
  write_indented_surface(const Scene        &scene,
                         const SlabField    &heights,
                         const ContactState &contact)
  {
    if (!scene.output.surface_map || !contact.plasticity)
      return;
    SlabField indented = heights;
    for (std::size_t i = 0; i < indented.size(); ++i)
      indented[i] -= contact.plasticity->indentation[i];
    write_netcdf_map(scene.output.directory + "/surface-indented.nc",
                     indented,
                     scene.units.length);
  }
} // namespace strait
