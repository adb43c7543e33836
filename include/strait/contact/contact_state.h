// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>
#include <strait/spectral/state_archive.h>

#include <limits>
#include <optional>
#include <vector>

namespace strait
{
  /**
   * Where a state was come to from: the field of the state before it (the pressure, or
   * with adhesion the gap). The line through both foretells a third state.
   */
  class Approach
  {
  public:
    Approach() = default;

    /** To a first state, at the load (or mean gap) @p target. */
    explicit Approach(const double target)
      : at(target)
    {
    }

    /** To a state at @p target from @p before, that of the state at @p target_before.
     *  Collective. */
    Approach(double target, const SlabField &before, double target_before);

    /** The load (or mean gap) of the state that was come to. */
    double
    target() const
    {
      return at;
    }

    /** How many times further than from the state before to this one @p next is from
     *  this one; negative on the way back, infinite where no state before is known. */
    double steps_to(double next) const;

    /**
     * The field at @p next on the line through @p here, that of this state, and the one
     * before. What is 0 here stays 0, and nothing falls below 0.
     */
    SlabField extrapolated(const SlabField &here, double next) const;

    /** In either direction. Collective. */
    void transfer(StateArchive &archive, const SlabLayout &layout);

  private:
    double at        = 0;
    double came_from = 0;
    // Single precision, in units of `scale`, is enough to extrapolate.
    std::vector<float> earlier;
    double             scale = 0; // 0: no state before is known
  };

  /** How the search for a solution ended. */
  struct ContactSolution
  {
    double residual   = 0; // of the conditions of a solution, in the solver's own units
    int    iterations = 0; // of the last solve, on the grid itself
    bool   converged  = false;
  };

  /** One iteration on the way to a state of least energy. */
  struct RelaxationStep
  {
    long   iteration;
    double energy;   // per area
    double residual; // as in ContactSolution
    double step;     // length of the step along its direction; GFMD: of time
  };

  /** What adhesion adds to a contact state. */
  struct AdhesiveState
  {
    double adhesive_energy = 0; // mean of γ(g), <= 0 [energy/area]
    double attraction      = 0; // γ'(0), of the points in contact [pressure]
    /** ½⟨w, Kw⟩ + ⟨γ⟩ + p0 ⟨g⟩, the last term under load control only. */
    double total_energy = 0;

    /** Smallest eigenvalue of the preconditioned curvature on the open points: the
     *  state is a minimum of the energy if it is positive. */
    double smallest_curvature = 0;

    /** The tension is more than any contact bears: the state is not an equilibrium,
     *  and the mean gap was still growing when this was noticed. */
    bool detached = false;

    /** The direction of the smallest curvature, from which the next state seeks its own.
     */
    std::vector<double> softest_direction;

    std::vector<RelaxationStep> relaxation; // if the scene asks for it
  };

  /** What yielding adds to a contact state. */
  struct PlasticState
  {
    /** By how much the surface was indented so far [length]: heights have become h minus
     *  this. */
    SlabField indentation;
    double    mean_indentation = 0; // over the nominal area
    double    area             = 0; // fraction of points where p is almost the hardness
  };

  /**
   * What a contact of this @p pressure and @p gap leaves behind of a surface that had
   * the indentation @p before, or none if that is null: it gives way where the pressure
   * is @p hardness and the gap negative, if @p is_solution says that both solve the
   * contact problem. Collective.
   */
  PlasticState indent(const SlabField *before,
                      const SlabField &pressure,
                      const SlabField &gap,
                      double           hardness,
                      bool             is_solution);

  /**
   * The solution of one contact problem, in the scene's units.
   *
   * gap is 0 exactly where pressure > 0, and >= 0 everywhere: a point is open
   * where its gap is positive. pressure is >= 0 everywhere. With adhesion it is the
   * reaction of the wall; the attraction γ'(g) comes on top, so that its mean is the
   * nominal pressure plus that of γ'(g). Where a fluid presses as well, pressure is what
   * the solid bears beyond the fluid, and nominal_pressure includes the fluid's mean.
   */
  struct ContactState : ContactSolution
  {
    ContactState() = default;

    /** Of these fields, with the mean gap and the contact areas that follow from them. No
     *  pressure exceeds @p limit. Collective. */
    ContactState(SlabField pressure,
                 SlabField gap,
                 double    limit = std::numeric_limits<double>::infinity());

    SlabField pressure;
    SlabField gap;
    double    nominal_pressure = 0; // the load; mean of pressure without adhesion
    double    mean_gap         = 0; // mean of gap
    double    contact_area     = 0; // fraction of the area with pressure > 0

    /**
     * The fraction that a continuum would have, A − 0.118 S a: a grid counts too much
     * along the contact line, which has the length S on the lattice, the sides that
     * points in contact share with others, over the area; a is the spacing, √(dx dy),
     * (π − 1 + ln 2)/24 = 0.118 (Yastrebov, Anciaux, Molinari 2017). Where the contact
     * yields up to its edge the pressure does not vanish there, and nothing is counted.
     */
    double contact_area_corrected = 0;

    long     fft_pairs = 0; // of the last solve, on the grid itself
    Approach approach;      // where it was come to from

    std::optional<AdhesiveState> adhesion;
    std::optional<PlasticState>  plasticity;

    /** Whether the load has pulled adhesive walls apart. */
    bool
    has_detached() const
    {
      return adhesion && adhesion->detached;
    }
  };

  /** Put @p state in an archive, or take it out. Collective. */
  void transfer(StateArchive &archive, ContactState &state, const SlabLayoutPtr &layout);
} // namespace strait
