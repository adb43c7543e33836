// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace strait
{
  struct ParameterSection;

  /** Along a side of the grid. */
  constexpr int least_grid_points = 4;

  /** Likewise: the product of two must fit into the 32-bit indices of deal.II's vectors.
   */
  constexpr int most_grid_points = 65535;

  /** How the energy with adhesion is minimised. */
  enum class AdhesionMethod
  {
    nonlinear_cg,
    newton_cg,
    gfmd
  };

  /** How the energy of adhesion falls with the gap; see AdhesionLaw. */
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
    double         range             = 0.;                         // z0; or
    double         tabor_number      = 0.;                         // sets z0
    double         sphere_radius     = 0.;                         // 0: not of a sphere
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

  /** The section Contact of a scene: elastic half-space against the substrate. */
  struct ContactParameters
  {
    bool                enabled           = true;
    std::array<int, 2>  grid_points       = {{512, 512}}; // nx, ny
    double              effective_modulus = 1.; // follows from the next two, if given
    std::vector<double> young_moduli;           // of one or two bodies
    std::vector<double> poisson_ratios;
    double              hardness           = 0.;    // 0: not known
    bool                yields             = false; // at the hardness, or never
    ContactControl      control            = ContactControl::load;
    ContactMethod       method             = ContactMethod::dual_cg;
    double              tolerance          = 1e-8; // residual in units of h_rms
    int                 maximum_iterations = 1000;
    AdhesionParameters  adhesion;
    ZoomParameters      zoom;

    void bind(ParameterSection section);

    /** Whether loads are prescribed, rather than mean gaps. */
    bool
    loads() const
    {
      return control == ContactControl::load;
    }

    /** No pressure of the contact exceeds it. */
    double
    largest_pressure() const
    {
      return yields ? hardness : std::numeric_limits<double>::infinity();
    }

    /** What the critical load of a surface of this rms slope is a fraction of: the
     * modulus times the slope or, where the contact yields, no more than twice the
     * hardness, for it touches on more than load over hardness. */
    double
    pressure_scale(const double rms_slope) const
    {
      const double elastic = effective_modulus * rms_slope;
      return yields ? std::min(elastic, 2. * hardness) : elastic;
    }

    /** Where Young's moduli are given, take the effective modulus that follows from them.
     *  Throws InputError where they contradict the other values. */
    void take_elastic_constants();
  };
} // namespace strait
