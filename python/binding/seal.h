// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/log.h>
#include <strait/base/timers.h>
#include <strait/seal/make_seal.h>

#include <sstream>
#include <stdexcept>
#include <tuple>
#include <variant>

#include "arrays.h"
#include "bindings.h"
#include "environment.h"

namespace strait::python
{
  /**
   * The seal of a scene: its model, and the flow through the gaps of the model. A load
   * alone stands for a control whose other parts are those of the scene. Every function
   * is collective.
   */
  class Seal
  {
  public:
    using LoadOrControl = std::variant<double, Control>;

    /** States, jumps, and whether the surfaces parted before the last control. */
    using Followed = std::tuple<std::vector<State>, std::vector<Jump>, bool>;

    Seal(const SceneSource          &source,
         const std::optional<Array> &heights,
         const py::object           &comm);
    ~Seal();
    Seal(const Seal &)            = delete;
    Seal &operator=(const Seal &) = delete;

    Control control(double                target,
                    std::optional<double> inlet_pressure,
                    std::optional<double> slip_length) const;

    State    solve(const LoadOrControl &at, const State &from);
    Followed follow(const std::vector<LoadOrControl> &through, const State &from);
    std::shared_ptr<Flow>   flow(const State &state, bool with_fields);
    std::vector<Transition> find_transitions(std::optional<double> first);
    std::vector<BlowOut>    find_blow_outs(const std::vector<double> &loads);

    double
    rms_slope() const
    {
      return slope;
    }

  private:
    /** While this exists, the seal is being solved. A signal handler may interrupt that,
     *  and must not solve a seal in an intermediate state. */
    class Use
    {
    public:
      explicit Use(Seal &seal)
        : is_used(seal.is_used)
      {
        if (is_used)
          throw std::runtime_error(
            "This seal is being solved; what interrupts that must use another.");
        is_used = true;
      }

      ~Use()
      {
        is_used = false;
      }

      Use(const Use &)            = delete;
      Use &operator=(const Use &) = delete;

    private:
      const Computing computing;
      bool           &is_used;
    };

    Control          control_of(const LoadOrControl &at) const;
    Aim              aim() const;
    const SealModel &open() const;
    void             require_fluid();
    void             require_own(const SealState &state) const;
    void             free();
    void             pass_warnings_on();

    Scene                      scene;
    MPI_Comm                   communicator;
    std::ostringstream         nowhere;
    Log                        log;
    Timers                     timers;
    SlabLayoutPtr              layout;
    double                     slope = 0.; // rms slope of the surface
    ContactParameters          contact;
    std::unique_ptr<FlowStage> stage;          // unless the fluid is off
    SealModel                  model;          // empty once MPI has ended
    std::size_t                n_warnings = 0; // passed on so far
    bool                       is_used    = false;
  };
} // namespace strait::python
