// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_contact_parameters_h
#define strait_base_contact_parameters_h

#include <strait/base/adhesion_parameters.h>

#include <array>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
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

  /** The section Contact of a scene: elastic half-space against the substrate. */
  struct ContactParameters
  {
    bool                enabled           = true;
    std::array<int, 2>  grid_points       = {{512, 512}}; // nx, ny
    double              effective_modulus = 1.; // follows from the next two, if given
    std::vector<double> young_moduli;           // of one or two bodies
    std::vector<double> poisson_ratios;
    ContactControl      control            = ContactControl::load;
    ContactMethod       method             = ContactMethod::dual_cg;
    double              tolerance          = 1e-8; // residual in units of h_rms
    int                 maximum_iterations = 1000;
    AdhesionParameters  adhesion;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };
} // namespace strait

#endif
