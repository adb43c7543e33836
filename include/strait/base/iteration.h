// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait
{
  /**
   * The fraction of the accuracy asked for by which the way to a result may change it. It
   * sets how closely contact and flow agree while the mesh is adapted and for a verdict
   * (open or sealed), how closely the contact alone is solved for a verdict, how closely
   * the weights of a rarefied gas converge, and how much of the load may depend on when
   * within a step fluid was cut off. Half of it takes more rounds on meshes that are
   * discarded, and halves more load steps. With double of it the residual of the rounds
   * is taken for an error of the mesh, and what trapped fluid carries depends on the
   * steps about twice as much.
   */
  inline constexpr double intermediate_tolerance_factor = .1;

  /** The number of iterations after which one that stalls or would never end is given up.
   *  With half of it, systems are taken for unsolvable on which the preconditioner is
   *  merely slow; with double of it, such failures are only reported later. */
  inline constexpr int iteration_limit = 500;
} // namespace strait
