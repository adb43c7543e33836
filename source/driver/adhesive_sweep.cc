// SPDX-License-Identifier: GPL-2.0-or-later
// What a sweep does where the contact remembers its past.
#include <strait/base/text.h>
#include <strait/contact/adhesion_of_scene.h>
#include <strait/contact/adhesive_contact_solver.h>
#include <strait/driver/load_sweep.h>

#include <algorithm>
#include <cmath>

namespace strait
{
  void
  LoadSweep::make_adhesive_contact(const ContactParameters &parameters, SlabField heights)
  {
    const AdhesionScale scale(parameters, heights);
    const AdhesionLaw   law = adhesion_of_scene(parameters, heights);
    log.line(
      format("adhesion: surface energy %.5g, range %.5g, Tabor number %.4g, E* "
             "z0²/(γ0 a) = %.3g",
             law.surface_energy,
             law.range,
             scale.tabor_number(law),
             scale.resolution(law)));
    if (scale.resolution(law) < resolved_adhesion)
      log.warn(
        format("the range of the adhesion is short for the grid: E* z0^2/(gamma0 "
               "a) is %.3g and should be at least %g, or loads of jumps depend on "
               "the grid",
               scale.resolution(law),
               resolved_adhesion));
    double largest = 0;
    for (const double target : scene.programme.pressures)
      largest = std::max(largest, std::abs(target));
    const AdhesiveStart start = scene.programme.path == LoadPath::unloading
                                  ? AdhesiveStart::full_contact
                                  : AdhesiveStart::without_adhesion;
    contact =
      std::make_unique<AdhesiveContactSolver>(parameters, law, start, std::move(heights));
    path = std::make_unique<BranchFollower>(*contact,
                                            parameters.control,
                                            scene.programme.jump_tolerance * largest,
                                            log);
  }

  /**
   * A state on the branch by which the scene approaches the threshold: started from
   * the nearest one on this side of it, so that no trial beyond it leaves a trace.
   */
  ContactState
  LoadSweep::state_for_search(const double load)
  {
    const bool loading = scene.programme.path != LoadPath::unloading;
    const bool usable =
      !search_start.gap.empty() &&
      (loading ? search_start.target <= load : search_start.target >= load);
    if (usable)
      contact->recall(search_start);
    else
      contact->forget();
    ContactState state   = contact->solve(load);
    const bool   is_open = find_bottleneck(state.gap, scene.fluid.direction).value > 0;
    if (is_open == loading && state.converged && !state.adhesion->detached)
      search_start = contact->memory();
    return state;
  }

  void
  LoadSweep::add_cycle(std::vector<Stop> &stops) const
  {
    // All slip lengths of a load stay together; the last load is not repeated.
    const std::size_t n_slips = scene.fluid.enabled ? scene.fluid.slip_lengths.size() : 1;
    std::vector<Stop> all     = stops;
    for (std::size_t k = stops.size(); k > n_slips; k -= n_slips)
      for (std::size_t slip = 0; slip < n_slips; ++slip)
        all.push_back(stops[k - 2 * n_slips + slip]);
    stops = std::move(all);
  }

  std::string
  LoadSweep::branch_of(const std::vector<Stop> &stops, std::size_t k) const
  {
    bool loading = scene.programme.path != LoadPath::unloading;
    if (!path && scene.programme.path != LoadPath::cycle)
      return loading ? "loading" : "unloading";
    // The direction of the last change; mean gaps fall while the load grows.
    for (; k > 0 && !stops[k].begins_anew; --k)
      if (stops[k].target != stops[k - 1].target)
        {
          loading = (stops[k].target > stops[k - 1].target) ==
                    (scene.contact.control == ContactControl::load);
          break;
        }
    return loading ? "loading" : "unloading";
  }

  const std::vector<Jump> &
  LoadSweep::jumps() const
  {
    static const std::vector<Jump> none;
    return path ? path->jumps() : none;
  }
} // namespace strait
