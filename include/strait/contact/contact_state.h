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
   * From where a state was reached: the field of the state before it (the pressure or,
   * with adhesion, the gap). The line through both fields extrapolates to a third state.
   */
  class Approach
  {
  public:
    Approach() = default;

    /** Of a first state, at the load (or mean gap) @p target. */
    explicit Approach(const double target)
      : at(target)
    {
    }

    /** Of a state at @p target, reached from the state at @p target_before with the field
     *  @p before. Collective. */
    Approach(double target, const SlabField &before, double target_before);

    /** The load (or mean gap) of the state that was reached. */
    double
    target() const
    {
      return at;
    }

    /** The distance from this state to the target @p next, in steps from the state before
     *  to this one; negative on the way back, infinite if there is no line. */
    double steps_to(double next) const;

    /**
     * Return the field at @p next on the line through the field before and @p here, that
     * of this state. Zeros of @p here stay 0, and no value falls below 0.
     */
    SlabField extrapolated(const SlabField &here, double next) const;

    /** Write to or read from @p archive. Collective. */
    void transfer(StateArchive &archive, const SlabLayout &layout);

  private:
    double at        = 0;
    double came_from = 0;
    // Single precision, in units of `scale`, is enough to extrapolate.
    std::vector<float> earlier;
    double             scale = 0; // 0: there is no line
  };

  /** How the search for a solution ended. */
  struct ContactSolution
  {
    double residual   = 0; // violation of the conditions, in units of ContactTolerance
    int    iterations = 0; // of the last solve, on the grid itself
    bool   converged  = false;
  };

  /** One iteration of the minimisation of the energy. */
  struct RelaxationStep
  {
    long   iteration;
    double energy;   // per area
    double residual; // as in ContactSolution
    double step;     // length of the step along its direction; GFMD: time step
  };

  /** What adhesion adds to a contact state. */
  struct AdhesiveState
  {
    double adhesive_energy = 0; // mean of γ(g), <= 0 [energy/area]
    double attraction      = 0; // γ'(0), at the points in contact [pressure]
    /** ½⟨w, Kw⟩ + ⟨γ⟩ + p0 ⟨g⟩, the last term under load control only. */
    double total_energy = 0;

    /** Smallest eigenvalue of the preconditioned curvature on the open points: the state
     *  is a minimum of the energy if it is positive. NaN if it was not sought. */
    double smallest_curvature = 0;

    /** The tension exceeds what any contact bears. The state is not an equilibrium: the
     *  mean gap was still growing when the search was ended. */
    bool detached = false;

    /** The direction of the smallest curvature, where the next state's search starts. */
    std::vector<double> softest_direction;

    std::vector<RelaxationStep> relaxation; // if the scene asks for it
  };

  /** What yielding adds to a contact state. */
  struct PlasticState
  {
    /** Total indentation of the surface so far [length], to be subtracted from h. */
    SlabField indentation;
    double    mean_indentation = 0; // over the nominal area
    double    area             = 0; // fraction of the area with p almost at the hardness
  };

  /**
   * Return the plastic state after a contact with this @p pressure and @p gap, on a
   * surface that had the indentation @p before (none if null). Where the pressure is
   * @p hardness, a negative gap adds to the indentation, provided that @p is_solution
   * says that both fields solve the contact problem. Collective.
   */
  PlasticState indent(const SlabField *before,
                      const SlabField &pressure,
                      const SlabField &gap,
                      double           hardness,
                      bool             is_solution);

  /**
   * The solution of one contact problem, in the scene's units.
   *
   * Both pressure and gap are >= 0, and gap is exactly 0 where pressure > 0. A point is
   * open where its gap is positive. With adhesion, pressure is the reaction of the wall,
   * which balances the attraction γ'(g) too: its mean is the nominal pressure plus the
   * mean of γ'(g). Where a fluid presses as well, pressure is what the solid bears beyond
   * the fluid, and nominal_pressure includes the fluid's mean.
   */
  struct ContactState : ContactSolution
  {
    ContactState() = default;

    /** Take these fields and compute the mean gap and the contact areas from them. No
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
     * The contact area of the continuum, A − 0.118 S a: a grid counts too much area along
     * the contact line. S is its length on the lattice, that is of the sides between
     * points in contact and others, over the nominal area; a = √(dx dy) is the spacing,
     * and (π − 1 + ln 2)/24 = 0.118 (Yastrebov, Anciaux, Molinari 2017). Where the
     * contact yields up to its edge the pressure does not vanish; such edges are left
     * out.
     */
    double contact_area_corrected = 0;

    long     fft_pairs = 0; // of the last solve, on the grid itself
    Approach approach;      // from where it was reached

    std::optional<AdhesiveState> adhesion;
    std::optional<PlasticState>  plasticity;

    /** Whether the load has pulled adhesive walls apart. */
    bool
    has_detached() const
    {
      return adhesion && adhesion->detached;
    }
  };

  /** Write @p state to @p archive, or read it from there. Collective. */
  void transfer(StateArchive &archive, ContactState &state, const SlabLayoutPtr &layout);
} // namespace strait
