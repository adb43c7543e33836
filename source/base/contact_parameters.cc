// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/contact_parameters.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

namespace strait
{
  namespace
  {
    const Choices<ContactControl> controls = {{ContactControl::load, "load"},
                                              {ContactControl::mean_gap, "mean gap"}};

    const Choices<ContactMethod> methods = {{ContactMethod::dual_cg, "dual CG"},
                                            {ContactMethod::polonsky_keer,
                                             "polonsky-keer"}};

    /** 1/E* = Σ (1 − ν²)/E. */
    double
    contact_modulus(const std::vector<double> &young, const std::vector<double> &poisson)
    {
      double compliance = 0;
      for (std::size_t i = 0; i < young.size(); ++i)
        compliance += (1 - poisson[i] * poisson[i]) / young[i];
      return 1 / compliance;
    }

    /** Before the modulus that follows from them is known: Effective modulus is as set.
     */
    void
    check_elastic_constants(const ContactParameters &contact)
    {
      const auto &young   = contact.young_moduli;
      const auto &poisson = contact.poisson_ratios;
      if (young.empty() && poisson.empty())
        return;
      if (young.size() != poisson.size() || young.size() > 2)
        throw InputError("Contact/Young's moduli and Poisson ratios have " +
                         std::to_string(young.size()) + " and " +
                         std::to_string(poisson.size()) +
                         " entries; give one of each for each elastic body, one or two.");
      if (contact.effective_modulus != ContactParameters().effective_modulus)
        throw InputError(
          "Contact/Effective modulus and Young's moduli are both given; remove one.");
      for (std::size_t i = 0; i < young.size(); ++i)
        if (!(young[i] > 0.) || !(poisson[i] > -1. && poisson[i] <= 0.5))
          throw InputError("Contact/Young's moduli and Poisson ratios contain " +
                           to_text(young[i]) + " with " + to_text(poisson[i]) +
                           "; a modulus must be positive, a ratio above -1 and at most "
                           "0.5.");
    }
  } // namespace

  void
  ContactParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const ContactParameters standard;
    prm.enter_subsection("Contact");
    prm.declare_entry(
      "Enabled",
      "true",
      Bool(),
      "Press an elastic half-space onto the surface. false: the surface is "
      "the gap itself, closed where it is not positive; a pure flow problem, "
      "for which Control and Load programme/Pressures are ignored.");
    prm.declare_entry(
      "Grid points",
      "512",
      List(Integer(), 1, 2),
      "Nx, Ny: grid points of the periodic box in x and y [1]; one number: "
      "both. Products of small primes are fastest.");
    prm.declare_entry(
      "Effective modulus",
      to_text(standard.effective_modulus),
      Double(),
      "E*: contact modulus, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [pressure].");
    prm.declare_entry("Young's moduli",
                      "",
                      List(Double(), 0),
                      "E1, E2 of the two bodies, or E1 if the other one is rigid, in "
                      "place of Effective modulus [pressure].");
    prm.declare_entry("Poisson ratios",
                      "",
                      List(Double(), 0),
                      "nu1, nu2 of the same bodies [1].");
    prm.declare_entry(
      "Control",
      controls.name(standard.control),
      Selection(controls.pattern()),
      "What Load programme/Pressures lists: nominal pressures (load) or mean "
      "gaps (mean gap).");
    prm.declare_entry("Solver",
                      methods.name(standard.method),
                      Selection(methods.pattern()),
                      "dual CG: preconditioned conjugate gradients on the pressure; "
                      "polonsky-keer: the textbook method, slower, for reference.");
    prm.declare_entry("Tolerance",
                      to_text(standard.tolerance),
                      Double(),
                      "Largest gap under pressure and largest penetration elsewhere, in "
                      "units of the rms height [1].");
    prm.declare_entry("Maximum iterations",
                      std::to_string(standard.maximum_iterations),
                      Integer(),
                      "Iterations on the fine grid after which a step counts as not "
                      "converged [1].");
    prm.leave_subsection();
    AdhesionParameters::declare(prm);
  }

  void
  ContactParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    enabled                          = prm.get_bool("Enabled");
    const std::array<double, 2> grid = parse_pair(prm.get("Grid points"));
    grid_points       = {{static_cast<int>(grid[0]), static_cast<int>(grid[1])}};
    effective_modulus = prm.get_double("Effective modulus");
    young_moduli      = parse_numbers(prm.get("Young's moduli"));
    poisson_ratios    = parse_numbers(prm.get("Poisson ratios"));
    check_elastic_constants(*this);
    if (!young_moduli.empty())
      effective_modulus = contact_modulus(young_moduli, poisson_ratios);
    control            = controls.value(prm.get("Control"));
    method             = methods.value(prm.get("Solver"));
    tolerance          = prm.get_double("Tolerance");
    maximum_iterations = static_cast<int>(prm.get_integer("Maximum iterations"));
    prm.leave_subsection();
    adhesion.parse(prm);
  }

  void
  ContactParameters::check() const
  {
    // 65535: the product must fit into the 32-bit indices of deal.II's vectors.
    for (const int n : grid_points)
      if (n < 4 || n > 65535)
        throw InputError("Contact/Grid points is " + std::to_string(grid_points[0]) +
                         ", " + std::to_string(grid_points[1]) +
                         " but both must lie between 4 and 65535.");
    if (!(effective_modulus > 0.))
      throw InputError("Contact/Effective modulus is " + to_text(effective_modulus) +
                       " but must be positive.");
    if (!(tolerance > 0. && tolerance < 1.))
      throw InputError("Contact/Tolerance is " + to_text(tolerance) +
                       " but must lie between 0 and 1.");
    if (maximum_iterations < 1)
      throw InputError("Contact/Maximum iterations is " +
                       std::to_string(maximum_iterations) + " but must be at least 1.");
    adhesion.check();
  }
} // namespace strait
