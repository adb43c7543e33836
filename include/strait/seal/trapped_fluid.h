// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/fluid_parameters.h>

#include <vector>

namespace strait
{
  /** A region of fluid that no reservoir reaches. Its mass is given by a volume and the
   *  pressure at which it fills that. */
  struct TrappedRegion
  {
    double volume     = 0.;    // [length³]
    double pressure   = 0.;    // at which it fills that
    double compliance = 0.;    // estimate of dV/dp of the walls around it
    bool   is_guess   = false; // it was there before the path began, its mass unknown
  };

  /** The fluid that a path has cut off from its reservoirs so far. */
  struct TrappedFluid
  {
    /** In place of a region's number: contact, and fluid that is not trapped. */
    static constexpr int no_fluid = -1, reservoirs = -2;

    std::vector<float> owner; // of each local grid point: a region's number, or these
    std::vector<TrappedRegion> regions;

    double area         = 0.; // of the open points of all regions over the nominal area
    double guessed_area = 0.; // of those whose mass was unknown, likewise
    double pressure     = 0.; // mean over this area

    /** By how much the mean pressure on the walls may be off, as it is not known when,
     *  within the last step, fluid was cut off. */
    double uncertainty = 0.;
  };

  /** The volume that the fluid of @p region fills at @p pressure without a cavity. */
  double volume_at(const FeedbackParameters &parameters,
                   const TrappedRegion      &region,
                   double                    pressure);

  /**
   * Return the pressure at which @p region holds its fluid, if its volume is @p volume
   * under @p pressure and grows by its compliance per unit of pressure; no less than that
   * of vapour, or than 0 for a gas.
   */
  double pressure_to_hold(const FeedbackParameters &parameters,
                          const TrappedRegion      &region,
                          double                    volume,
                          double                    pressure);
} // namespace strait
