// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_rarefaction_h
#define strait_run_rarefaction_h

#include <strait/base/scene.h>
#include <strait/percolation/flow_path.h>

namespace strait
{
  /** The mean free path of a gas times its pressure, η √(πRT/2M), in the units of the
   *  scene, [length pressure]; it depends on the temperature only. */
  double mean_free_path_times_pressure(const Scene &scene);

  /** Knudsen numbers, mean free path over gap. */
  struct KnudsenNumbers
  {
    double at_throat = 0.; // where the gap is smallest
    double mean      = 0.; // along the path, weighted with the fall of the pressure
  };

  /** Of a gas in viscous flow along @p path, where its squared pressure falls in
   *  proportion to ∫ ds/gap³. */
  KnudsenNumbers knudsen_numbers(const FlowPath &path, const Scene &scene);
} // namespace strait

#endif
