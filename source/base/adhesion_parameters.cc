// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/adhesion_parameters.h>
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<AdhesionShape> shapes = {{AdhesionShape::exponential, "exponential"},
                                           {AdhesionShape::van_der_waals,
                                            "van der Waals"}};

    const Choices<AdhesionMethod> methods = {{AdhesionMethod::nonlinear_cg,
                                              "nonlinear CG"},
                                             {AdhesionMethod::newton_cg, "newton CG"},
                                             {AdhesionMethod::gfmd, "GFMD"}};
  } // namespace

  void
  AdhesionParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const AdhesionParameters standard;
    prm.enter_subsection("Contact");
    prm.enter_subsection("Adhesion");
    prm.declare_entry("Enabled",
                      "false",
                      Bool(),
                      "Let the surfaces attract each other, in addition to the hard "
                      "wall. States then depend on the path of the load.");
    prm.declare_entry("Law",
                      shapes.name(standard.shape),
                      Selection(shapes.pattern()),
                      "Energy per area at the gap g: exponential: -gamma0 exp(-g/z0); "
                      "van der Waals: -gamma0/(1 + g/z0)^2, of longer reach.");
    prm.declare_entry("Surface energy",
                      to_text(standard.surface_energy),
                      Double(0.),
                      "gamma0: energy gained per area in contact [energy/area].");
    prm.declare_entry("Range",
                      to_text(standard.range),
                      Double(0.),
                      "z0: range of the attraction [length]; or give the Tabor number.");
    prm.declare_entry(
      "Tabor number",
      to_text(standard.tabor_number),
      Double(0.),
      "Sets the range: z0 = Rc^(1/3) (gamma0/E*)^(2/3) over this number, with "
      "1/Rc^2 = 1/2 sum (qx^4 + qy^4) |h(q)|^2. Small: long range; large: short "
      "[1].");
    prm.declare_entry(
      "Match area at pressure",
      to_text(standard.matched_pressure),
      Double(0.),
      "If not 0, choose gamma0 such that adhesion doubles the contact area at this "
      "nominal pressure, loading; takes the place of Surface energy [pressure].");
    prm.declare_entry(
      "Solver",
      methods.name(standard.method),
      Selection(methods.pattern()),
      "nonlinear CG: preconditioned conjugate gradients on the gap; newton CG: "
      "truncated Newton, slower, for verification; GFMD: damped, mass-weighted "
      "Green's-function molecular dynamics, slower still. Contact/Tolerance is the "
      "largest traction that is not balanced, over E* times the rms slope over 2.");
    prm.declare_entry(
      "Accept unresolved range",
      "false",
      Bool(),
      "Compute although E*/(k a) < 0.8 with the grid spacing a and the slope k of the "
      "attraction in contact, gamma0/z0^2 (van der Waals: 6 gamma0/z0^2); loads of jumps "
      "then depend on the grid.");
    prm.declare_entry("Trajectory",
                      "false",
                      Bool(),
                      "Write energy, residual and step of every iteration of step N to "
                      "relaxation-N.csv.");
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void
  AdhesionParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    prm.enter_subsection("Adhesion");
    enabled           = prm.get_bool("Enabled");
    shape             = shapes.value(prm.get("Law"));
    surface_energy    = prm.get_double("Surface energy");
    range             = prm.get_double("Range");
    tabor_number      = prm.get_double("Tabor number");
    matched_pressure  = prm.get_double("Match area at pressure");
    method            = methods.value(prm.get("Solver"));
    accept_unresolved = prm.get_bool("Accept unresolved range");
    write_relaxation  = prm.get_bool("Trajectory");
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void
  AdhesionParameters::check() const
  {
    if (!enabled)
      return;
    if ((surface_energy > 0.) == (matched_pressure > 0.))
      throw InputError(
        "Contact/Adhesion needs either Surface energy or Match area at pressure, one of "
        "them positive and the other 0.");
    if ((range > 0.) == (tabor_number > 0.))
      throw InputError(
        "Contact/Adhesion needs either Range or Tabor number, one of them positive and "
        "the other 0.");
  }
} // namespace strait
