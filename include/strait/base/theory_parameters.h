// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_theory_parameters_h
#define strait_base_theory_parameters_h

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
  struct Scene;

  /** The spectrum for which the theory is evaluated. */
  enum class TheorySpectrum
  {
    model,  // what a self-affine surface has on average: no grid
    surface // that of the heights on the grid
  };

  /** Whose gaps the effective medium is made of. */
  enum class TheoryGaps
  {
    persson,
    simulated
  };

  /** What sets n of the effective medium. */
  enum class TheoryDimension
  {
    bruggeman,         // n = 2
    critical_fraction, // given contact fraction at the threshold
    from_threshold     // that at the run's own critical load
  };

  /** The section Theory: Persson's theory and the effective medium beside each step. */
  struct TheoryParameters
  {
    bool            enabled           = false;
    TheorySpectrum  spectrum          = TheorySpectrum::model;
    TheoryGaps      gaps              = TheoryGaps::persson;
    TheoryDimension dimension         = TheoryDimension::bruggeman;
    double          critical_fraction = .42;
    double          gamma             = .45;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    /** Throws InputError where the section contradicts itself or the rest of @p scene. */
    void check(const Scene &scene) const;
  };
} // namespace strait

#endif
