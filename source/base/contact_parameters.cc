// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/contact_parameters.h>
#include <strait/base/exceptions.h>
#include <strait/base/parameter_table.h>

namespace strait
{
  void
  AdhesionParameters::bind(ParameterSection section)
  {
    section.add("Enabled", enabled).meaning =
      "Let the surfaces attract each other, in addition to the hard wall. States then "
      "depend on the load path.";
    ParameterSection effect = section.when("Enabled = true");
    effect.add("Law", shape, Names{"exponential", "van der Waals"}).meaning =
      "Energy per area at the gap g. exponential: -gamma0 exp(-g/z0); van der Waals: "
      "-gamma0/(1 + g/z0)^2, of longer reach.";
    effect.add("Surface energy", surface_energy, not_negative).meaning =
      "gamma0: energy gained per area of contact [energy/area].";
    effect.add("Range", range, not_negative).meaning =
      "z0: range of the attraction [length]; give this or the Tabor number.";
    effect.add("Tabor number", tabor_number, not_negative).meaning =
      "Tabor number, in place of Range [1]; small: long range; large: short. z0 is "
      "Rc^(1/3) (gamma0/E*)^(2/3) over this number, with 1/Rc^2 = 1/2 sum (qx^4 + qy^4) "
      "|h(q)|^2, where creases count, as those of a mirrored map; for a sphere Rc is its "
      "radius.";
    effect.add("Match area at pressure", matched_pressure, not_negative).meaning =
      "Nominal pressure at which adhesion doubles the contact area on loading "
      "[pressure]. If it is not 0, gamma0 is chosen accordingly, in place of Surface "
      "energy.";
    effect.add("Solver", method, Names{"nonlinear CG", "newton CG", "GFMD"}).meaning =
      "nonlinear CG: preconditioned conjugate gradients on the gap; newton CG: truncated "
      "Newton, slower, for verification; GFMD: damped, mass-weighted Green's-function "
      "molecular dynamics, slower still. Here Contact/Tolerance limits the largest "
      "unbalanced traction, in units of E* times the rms slope over 2.";
    effect.add("Accept unresolved range", accept_unresolved).meaning =
      "Compute although the range is not resolved, E*/(k a) < 0.8 with the grid spacing "
      "a and the slope k of the attraction in contact, gamma0/z0^2 (van der Waals: 6 "
      "gamma0/z0^2). Loads of jumps then depend on the grid.";
    effect.add("Trajectory", write_relaxation).meaning =
      "Write energy, residual and step of every iteration at the last load of step N to "
      "relaxation-N.csv.";
  }

  void
  AdhesionParameters::check() const
  {
    if (!enabled)
      return;
    require(
      (surface_energy > 0.) != (matched_pressure > 0.),
      "Contact/Adhesion needs either Surface energy or Match area at pressure, one of "
      "them positive and the other 0.");
    require(
      (range > 0.) != (tabor_number > 0.),
      "Contact/Adhesion needs either Range or Tabor number, one of them positive and "
      "the other 0.");
  }

  void
  ZoomParameters::bind(ParameterSection section)
  {
    section.add("Enabled", enabled).meaning =
      "Solve the contact on finer points in windows around the throats that matter, "
      "three times finer with each level, and estimate the total error of the leak rate.";
    ParameterSection effect = section.when("Enabled = true");
    effect.add("Points along throat", points_along_throat, any_number.at_least(4.))
      .meaning =
      "Levels are added until a throat has this many points along the flow, from its "
      "narrowest one to where the gap is twice as large [1]; minor throats need fewer.";
    effect.add("Maximum levels", maximum_levels, any_number.at_least(1).at_most(10))
      .meaning =
      "Largest number of levels around a throat, each with a third of the spacing of the "
      "one before [1].";
  }

  void
  ContactParameters::bind(ParameterSection section)
  {
    section.add("Enabled", enabled).meaning =
      "true: press an elastic half-space onto the surface. false: the surface is the gap "
      "itself, closed where it is not positive; in this pure flow problem Control and "
      "Load programme/Pressures are ignored.";
    section
      .add("Grid points",
           grid_points,
           any_number.at_least(least_grid_points).at_most(most_grid_points))
      .meaning =
      "Nx, Ny: grid points of the periodic box in x and y [1]; one number: both. "
      "Products of small primes are fastest. Surface/Kind = file, if empty: those of the "
      "map.";
    ParameterSection theory_too = section.when("Enabled = true | Theory/Enabled = true");
    ParameterSection effect     = section.when("Enabled = true");
    theory_too.add("Effective modulus", effective_modulus, positive).meaning =
      "E*: contact modulus, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [pressure].";
    theory_too.add("Young's moduli", young_moduli, positive).meaning =
      "E1, E2 of the two bodies, or E1 if the other one is rigid, in place of Effective "
      "modulus [pressure].";
    theory_too.add("Poisson ratios", poisson_ratios, any_number.above(-1.).at_most(0.5))
      .meaning = "nu1, nu2 of the same bodies [1].";
    theory_too.add("Hardness", hardness, not_negative).meaning =
      "H: pressure at which the softer body flows, about three times its yield stress "
      "[pressure]. The column validity compares the pressure of an elastic contact with "
      "it, or with a tenth of the effective modulus if it is 0.";
    section.add("Yielding", yields, Names{"none", "cut-off"}).meaning =
      "none: the contact is elastic at any pressure; cut-off: no pressure exceeds the "
      "Hardness, and where it is reached the surface stays indented. States then depend "
      "on the load path.";
    theory_too.add("Control", control, Names{"load", "mean gap"}).meaning =
      "What Load programme/Pressures lists: nominal pressures (load) or mean gaps (mean "
      "gap).";
    effect.add("Solver", method, Names{"dual CG", "polonsky-keer"}).meaning =
      "dual CG: preconditioned conjugate gradients on the pressure; polonsky-keer: the "
      "textbook method, slower, for reference. Adhesion has a Solver of its own, for "
      "which this one only finds a start.";
    effect.add("Tolerance", tolerance, positive.below(1.)).meaning =
      "Largest gap allowed under pressure and largest penetration elsewhere, in units of "
      "the rms height [1].";
    effect.add("Maximum iterations", maximum_iterations, any_number.at_least(1)).meaning =
      "Iterations on the fine grid after which a step counts as not converged [1].";
    adhesion.bind(section.subsection("Adhesion"));
    zoom.bind(section.subsection("Zoom"));
  }

  void
  ContactParameters::take_elastic_constants()
  {
    if (young_moduli.empty() && poisson_ratios.empty())
      return;
    require(young_moduli.size() == poisson_ratios.size() && young_moduli.size() <= 2,
            "Contact/Young's moduli and Poisson ratios have " +
              std::to_string(young_moduli.size()) + " and " +
              std::to_string(poisson_ratios.size()) +
              " entries; give one of each for each elastic body, one or two.");
    require(effective_modulus == ContactParameters().effective_modulus,
            "Contact/Effective modulus and Young's moduli are both given; remove one.");
    double compliance = 0; // 1/E* = Σ (1 − ν²)/E
    for (std::size_t i = 0; i < young_moduli.size(); ++i)
      compliance += (1 - poisson_ratios[i] * poisson_ratios[i]) / young_moduli[i];
    effective_modulus = 1 / compliance;
  }
} // namespace strait
