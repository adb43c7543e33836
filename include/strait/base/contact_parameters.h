// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace strait
{
  struct ParameterSection;

  /** The fewest grid points along a side. */
  constexpr int least_grid_points = 4;

  /** The most grid points along a side: the product of two such numbers must fit into the
   *  32-bit indices of deal.II's vectors. */
  constexpr int most_grid_points = 65535;

  /** How the energy with adhesion is minimised. */
  enum class AdhesionMethod
  {
    nonlinear_cg,
    newton_cg,
    gfmd
  };

  /** How the energy of adhesion decays with the gap; see AdhesionLaw. */
  enum class AdhesionShape
  {
    exponential,
    van_der_waals
  };

  /** The section Contact/Adhesion of a scene: an energy −γ0 f(g/z0) per area, in addition
   *  to the hard wall. */
  struct AdhesionParameters
  {
    bool           enabled           = false;
    AdhesionShape  shape             = AdhesionShape::exponential; // f
    double         surface_energy    = 0.;                         // γ0
    double         range             = 0.;                         // z0; 0: from the next
    double         tabor_number      = 0.;                         // sets z0; 0: off
    double         sphere_radius     = 0.;                         // 0: not a sphere
    double         matched_pressure  = 0.;                         // sets γ0; 0: off
    AdhesionMethod method            = AdhesionMethod::nonlinear_cg;
    bool           accept_unresolved = false;
    bool           write_relaxation  = false;

    void bind(ParameterSection section);
    void check() const;
  };

  /** What is prescribed at each step. */
  enum class ContactControl
  {
    load,
    mean_gap
  };

  /** How the contact without adhesion is solved. */
  enum class ContactMethod
  {
    dual_cg,
    polonsky_keer
  };

  /** The section Contact/Zoom of a scene: windows of finer points around throats. */
  struct ZoomParameters
  {
    bool   enabled             = false;
    double points_along_throat = 12.;
    int    maximum_levels      = 8;

    void bind(ParameterSection section);
  };

  /** The section Contact of a scene: an elastic half-space against the substrate. */
  struct ContactParameters
  {
    bool                enabled           = true;
    std::array<int, 2>  grid_points       = {{512, 512}}; // nx, ny
    double              effective_modulus = 1.; // from the next two, if they are given
    std::vector<double> young_moduli;           // of one or two bodies
    std::vector<double> poisson_ratios;
    double              hardness           = 0.;    // 0: not known
    bool                yields             = false; // at the hardness; false: never
    ContactControl      control            = ContactControl::load;
    ContactMethod       method             = ContactMethod::dual_cg;
    double              tolerance          = 1e-8; // residual in units of h_rms
    int                 maximum_iterations = 1000;
    AdhesionParameters  adhesion;
    ZoomParameters      zoom;

    void bind(ParameterSection section);

    /** Whether loads are prescribed, rather than mean gaps. */
    bool
    is_load_controlled() const
    {
      return control == ContactControl::load;
    }

    /** The upper bound of the contact pressure: the hardness if the contact yields, else
     *  infinity. */
    double
    largest_pressure() const
    {
      return yields ? hardness : std::numeric_limits<double>::infinity();
    }

    /** The pressure by which critical loads of surfaces of this rms slope are scaled: the
     *  contact modulus times the slope. If the contact yields, it is at most twice the
     *  hardness, because the contact fraction is more than load over hardness. */
    double
    pressure_scale(const double rms_slope) const
    {
      const double elastic = effective_modulus * rms_slope;
      return yields ? std::min(elastic, 2. * hardness) : elastic;
    }

    /** If Young's moduli are given, compute the effective modulus from them. Throws
     *  InputError if they contradict the other values. */
    void take_elastic_constants();
  };
} // namespace strait
