// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_adhesion_parameters_h
#define strait_base_adhesion_parameters_h

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
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

  /**
   * The section Contact/Adhesion of a scene: an energy −γ0 f(g/z0) per area, in addition
   * to the hard wall.
   */
  struct AdhesionParameters
  {
    bool           enabled           = false;
    AdhesionShape  shape             = AdhesionShape::exponential; // f
    double         surface_energy    = 0.;                         // γ0
    double         range             = 0.;                         // z0; or
    double         tabor_number      = 0.;                         // sets z0
    double         matched_pressure  = 0.;                         // sets γ0; 0: off
    AdhesionMethod method            = AdhesionMethod::nonlinear_cg;
    bool           accept_unresolved = false;
    bool           write_relaxation  = false;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };
} // namespace strait

#endif
