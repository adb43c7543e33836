// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_coarser_seals_h
#define strait_run_coarser_seals_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/seal/seal_search.h>

#include <memory>
#include <optional>
#include <vector>

namespace strait
{
  /** With how many coarser grids each step of @p scene is compared. */
  int n_compared_grids(const Scene &scene);

  /**
   * The dry seal of a scene on every second point of its contact grid, on every fourth,
   * and so on. Two things are cheap there: a first idea of the critical load, which that
   * of the grid itself is close to, and what the grid changes of a leak rate.
   */
  class CoarserSeals
  {
  public:
    /** None where there is no fluid, or where the past of a contact, or a fluid on its
     *  walls, matters: these are not those of a coarser grid at the same load. @p heights
     * on the grid of the contact, which @p contact describes. @p scene and @p log must
     * outlive this object. Collective. */
    CoarserSeals(const Scene             &scene,
                 const ContactParameters &contact,
                 const SlabField         &heights,
                 Log                     &log);

    int
    size() const
    {
      return static_cast<int>(seals.size());
    }

    /** Find the critical loads of all of them, of the coarsest from @p first on. Returns
     *  where that of the grid itself is sought. Collective. */
    SearchStart find_critical_loads(SearchStart first);

    /**
     * The gap on every 2^halvings-th point [length] at @p control or, with
     * @p reduced_load, which is 1 − L/L_c, as far from the critical load of those points.
     * Collective.
     */
    SlabField
    gap(int halvings, Control control, const std::optional<double> &reduced_load);

    /** Keep only those that steps are compared with. */
    void end_searches();

    /** What is known of them, critical loads and last states. Collective. */
    void transfer(StateArchive &archive);

  private:
    struct CoarserSeal
    {
      SlabLayoutPtr            layout;
      SealModel                model;
      std::vector<Transition>  thresholds; // once they were sought
      std::optional<SealState> state;      // that the next is reached from
    };

    const Scene             &scene;
    Log                     &log;
    Log                      silent;
    std::vector<CoarserSeal> seals; // every second point first
  };
} // namespace strait

#endif
