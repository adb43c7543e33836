// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_feedback_parameters_h
#define strait_base_feedback_parameters_h

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
  /** How the next fluid pressure is guessed from those before. */
  enum class Acceleration
  {
    anderson,
    none
  };

  /** The subsection Fluid/Wall feedback: the fluid presses the walls apart. */
  struct FeedbackParameters
  {
    bool         enabled            = false;
    double       tolerance          = 1e-4; // of leak rate and fluid pressure
    int          maximum_iterations = 200;
    Acceleration acceleration       = Acceleration::anderson;
    double       relaxation         = 1.;
    double       pool_pressure      = 0.;

    /** Both expect the handler to be in the section Fluid. */
    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };
} // namespace strait

#endif
