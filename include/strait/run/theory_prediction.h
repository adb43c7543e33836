// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/seal/transition_search.h>
#include <strait/theory/persson.h>

#include <optional>

namespace strait
{
  /** What the theory predicts for one step. */
  struct TheoryResult
  {
    double pressure     = 0.; // nominal; 0 if the gap is given
    double contact_area = 0.; // fraction of the nominal area, by Persson's theory
    double mean_gap     = 0.;
    double leak_rate    = 0.; // of the effective medium in the scene's box
    double error        = 0.; // relative, of mean gap and leak rate by quadrature

    std::optional<YieldingAreas> yielding; // if the scene's contact yields

    /** P(u) in broad bins, by Persson's theory and simulated, if fields are written. */
    std::optional<GapDistribution> persson_gaps;
    std::optional<GapDistribution> simulated_gaps;
  };

  /** Persson's theory and the effective medium for the surface, the fluid and the box of
   *  a scene, as its section Theory asks. */
  class TheoryPrediction
  {
  public:
    /** The spectrum is measured on @p heights if the scene asks for that of the surface;
     *  for that of the model @p heights may be null. Throws InputError if the surface is
     *  flat. @p scene must outlive this object. Collective. */
    TheoryPrediction(const Scene &scene, const SlabField *heights);

    /** Evaluate the theory at one nominal @p pressure and @p slip_length. @p gap is the
     *  simulated one, which may be null unless the scene asks for its distribution, and
     *  @p threshold the critical load, or null if it was not sought. If the pressure is
     *  not positive, contact area and mean gap are not numbers, nor is the leak rate
     *  unless it is that of the simulated gap. Collective. */
    TheoryResult predict(double            pressure,
                         double            slip_length,
                         const SlabField  *gap,
                         const Transition *threshold) const;

    const RadialSpectrum &
    spectrum() const
    {
      return persson.spectrum();
    }

  private:
    const Scene  &scene;
    PerssonTheory persson;
    PerssonTheory coarse; // with fewer points, for an estimate of the error
  };
} // namespace strait
