// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_coupled_seal_h
#define strait_seal_coupled_seal_h

#include <strait/base/log.h>
#include <strait/base/scene.h>
#include <strait/contact/contact_model.h>
#include <strait/seal/flow_stage.h>
#include <strait/seal/harmonic_extension.h>
#include <strait/seal/seal_model.h>

#include <memory>

namespace strait
{
  /**
   * Contact and flow that agree with each other: the fluid presses the walls apart,
   * and the gap decides where the fluid goes. Exists only where the scene enables
   * Wall feedback.
   *
   * Contact is the dry problem for the wall that the fluid's pressure (FluidOnWall) has
   * displaced, under the load that it leaves (the pressure of the contact is that of the
   * solid beyond the fluid's).
   *
   * For a leak rate, contact and flow agree on finer and finer meshes, until what the
   * last mesh changed and the width of a bracket on it are together as small as the
   * accuracy that is asked for.
   */
  class CoupledSeal : public SealModel
  {
  public:
    /** The references must outlive this object. */
    CoupledSeal(const Scene                  &scene,
                std::unique_ptr<ContactModel> contact,
                const SlabLayoutPtr          &layout,
                FlowStage                    &flow,
                Log                          &log);

    SealState solve(const Control &control, const SealState *from, Aim aim) override;

    bool
    depends_on_path() const override
    {
      return true;
    }

  private:
    class Iteration;

    const Scene                  &scene;
    std::unique_ptr<ContactModel> contact;
    const SlabLayoutPtr           layout;
    FlowStage                    &flow;
    Log                          &log;
    HarmonicExtension             extension;
  };

  /**
   * How much the way to a state may decide of it, of the accuracy that is asked for: how
   * closely contact and flow agree while the mesh is being found and for a verdict, and
   * how much of the load may hang on when in a step fluid was cut off. Half of it takes
   * more rounds on meshes that are left again and halves more steps; with double of it
   * what the rounds leave over is taken for an error of the mesh, and the step decides
   * about as much more of what trapped fluid carries.
   */
  constexpr double looseness = .1;

  /** The share of the target accuracy that the bracket of the leak rate in a state may
   *  take, when the fluid's pressure on the wall has taken its own. */
  double share_of_bracket(const SealState &state, double target_accuracy);

  /**
   * Widen the bracket @p result of the leak rate in the gap of @p fluid by what the
   * fluid's pressure on the wall leaves uncertain of that gap.
   */
  void
  allow_for_feedback(Leakage &result, const FluidState &fluid, double target_accuracy);
} // namespace strait

#endif
