// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/scene.h>
#include <strait/seal/transition_search.h>
#include <strait/theory/persson.h>

#include <optional>

namespace strait
{
  /** What the theory says about one step. */
  struct TheoryResult
  {
    double pressure     = 0.; // nominal; not a number without contact, as what follows
    double contact_area = 0.; // fraction of the nominal area, by Persson's theory
    double mean_gap     = 0.;
    double leak_rate    = 0.; // of the effective medium in the scene's box
    double error        = 0.; // of mean gap and leak rate by quadrature, relative

    std::optional<YieldingAreas> yielding; // if the scene's contact yields

    /** P(u) in broad bins by Persson's theory, and as simulated, if fields are written.
     */
    std::optional<GapDistribution> persson_gaps;
    std::optional<GapDistribution> simulated_gaps;
  };

  /** Persson's theory and the effective medium for the surface, the fluid and the box of
   *  a scene, as its section Theory asks. */
  class TheoryPrediction
  {
  public:
    /** @p heights are measured where the scene takes the spectrum of the surface, and may
     *  be null where it takes the model's. Throws InputError if the surface is flat.
     *  @p scene must outlive this object. Collective. */
    TheoryPrediction(const Scene &scene, const SlabField *heights);

    /** The theory at one nominal @p pressure and @p slip_length. @p gap is the simulated
     *  one, which may be null unless the scene asks for its distribution, @p threshold
     *  the critical load or null where it was not sought. A pressure that is not positive
     *  leaves contact area and mean gap not numbers. Collective. */
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
    PerssonTheory coarse; // the difference to it estimates the error
  };
} // namespace strait
