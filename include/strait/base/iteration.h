// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace strait
{
  /**
   * How much the way to a result may decide of it, of the accuracy that is asked for: how
   * closely contact and flow agree while the mesh is being found and for a verdict, and
   * the weights of a rarefied gas, as the contact does by itself; and how much of the
   * load may hang on when in a step fluid was cut off. Half of it takes more rounds on
   * meshes that are left again and halves more steps; with double of it what the rounds
   * leave over is taken for an error of the mesh, and the step decides about as much more
   * of what trapped fluid carries.
   */
  inline constexpr double looseness = .1;

  /** Ends an iteration that gains nothing any more or would go on for ever. With half of
   *  it systems pass for unsolvable on which the preconditioner is merely slow, with
   *  double of it such a failure is only told later. */
  inline constexpr int iteration_limit = 500;
} // namespace strait
