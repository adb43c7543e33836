// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/contact/contact_state.h>
#include <strait/seal/trapped_fluid.h>

#include <functional>
#include <optional>

namespace strait
{
  /** What is prescribed from outside. */
  struct Control
  {
    double target         = 0.; // nominal pressure, or mean gap under gap control
    double inlet_pressure = 0.;
    double slip_length    = 0.; // negative: an immobile layer of fluid on each wall
  };

  /** A fluid that presses on the walls. */
  struct FluidState
  {
    SlabField pressure;  // on the grid, continued under the contact [pressure]
    double    load = 0.; // its mean over the nominal area

    std::optional<TrappedFluid> trapped; // none where it is drained

    // Relative error of the leak rate: its change by the last mesh, or its difference
    // between either side of a gap that stays ajar.
    double mesh_error = 0.;

    bool percolates = false;
    bool converged  = false;
    bool lifted_off = false; // the fluid carries the load, or adhesive walls parted
  };

  /** How the path to a state ran in its last step. */
  struct PathTrend
  {
    bool   is_known      = false; // not at the first state of a path
    double slope         = 0.;    // derivative of the energy's slope by the target
    double largest_slope = 0.;    // of the energy, on the path so far
  };

  /** What was spent on a state, summed up over the steps on the way to it. */
  struct Costs
  {
    int    iterations      = 0; // of the contact, on the grid itself
    long   fft_pairs       = 0; // likewise
    int    rounds          = 0; // of contact and flow, until they agreed
    double contact_seconds = 0.;

    Costs &
    operator+=(const Costs &other)
    {
      iterations += other.iterations;
      fft_pairs += other.fft_pairs;
      rounds += other.rounds;
      contact_seconds += other.contact_seconds;
      return *this;
    }
  };

  /** The state of a seal, and all that its past leaves behind. */
  struct SealState
  {
    Control                     control;
    std::optional<ContactState> contact;   // none where the surface is the gap itself
    SlabField                   given_gap; // that gap; below zero where closed [length]
    double                      mean_gap = 0.; // closed points count as zero
    std::optional<FluidState>   fluid;         // only where it presses on the walls
    PathTrend                   trend;
    Costs                       costs;

    /** The gap as the contact leaves it [length]; at most 0 where closed. */
    const SlabField &
    gap() const
    {
      return contact ? contact->gap : given_gap;
    }

    /** Whether contact, and contact with fluid, reached what was asked of them. */
    bool
    converged() const
    {
      return (!contact || contact->converged) && (!fluid || fluid->converged);
    }
  };

  /** What a state is wanted for. */
  enum class Aim
  {
    throats,  // where its throats are, to place windows there
    verdict,  // whether a channel percolates
    seal,     // the same; if one does, the sealed state is lost: no need to be exact
    leak_rate // how much leaks, to the accuracy that the scene asks for
  };

  /**
   * Computes the state of a seal under @p control, reached from the state @p from, or
   * without a past if that is null. The seal may be a surface that is the gap itself, a
   * contact, a contact with adhesion, or one that a fluid presses apart. A model
   * remembers nothing, and may do more than the aim needs. Collective. Throws InputError
   * if there is no such state.
   */
  using SealModel =
    std::function<SealState(const Control &control, const SealState *from, Aim aim)>;

  /** Whether @p state is also the state under @p control. The fluid matters only where it
   *  presses on the walls or windows lie around its throats; nothing changes a surface
   *  that is the gap itself. */
  bool holds_under(const Control &control, const SealState &state);

  /** Whether a fluid that presses on the walls has opened or closed a channel between
   *  these states. */
  bool changes_verdict(const SealState &from, const SealState &state);

  /** The gap of a contact [length]; minus pressure times @p softness where it touches. */
  SlabField signed_gap(const SealState &state, double softness);

  /** Put @p state in an archive, or take it out; a given gap is left out. Collective. */
  void transfer(StateArchive &archive, SealState &state, const SlabLayoutPtr &layout);
} // namespace strait
