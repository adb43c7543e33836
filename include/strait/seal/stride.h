// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_stride_h
#define strait_seal_stride_h

#include <strait/base/contact_parameters.h>
#include <strait/seal/seal_state.h>

#include <optional>
#include <string>

namespace strait
{
  /** What matters of a state of an adhesive contact on its path. */
  struct PathPoint
  {
    double target       = 0; // nominal pressure, or mean gap under gap control
    double pressure     = 0;
    double mean_gap     = 0;
    double contact_area = 0;
    double energy       = 0; // AdhesiveState::total_energy
  };

  /** A discontinuity: from one state to another at almost the same load. */
  struct Jump
  {
    PathPoint before;
    PathPoint after;               // without meaning at a pull-off
    double    dissipated  = 0;     // energy per area
    bool      is_pull_off = false; // the surfaces part
  };

  /** In either direction. Collective. */
  void transfer(StateArchive &archive, Jump &jump);

  /** One line about a jump for the log. */
  std::string describe(const Jump &jump);

  /** One step of a path whose states have an energy; see follow(). */
  class Stride
  {
  public:
    /** Of an adhesive contact, @p from a state @p to another. */
    Stride(const SealState &from, const SealState &to, ContactControl control);

    /** Whether nothing speaks for a jump. */
    bool is_smooth() const;

    /** What a step that is no smooth one, and can be no shorter, may be. */
    std::optional<Jump> jump() const;

    /** The surfaces part in it. */
    Jump pull_off() const;

    /** How the path goes on if it is smooth. */
    PathTrend trend_after() const;

  private:
    double slope_at(const PathPoint &point) const;

    ContactControl  control;
    PathPoint       before, after;
    const PathTrend trend;
    double          largest_slope, change, rise;
    double          least = 0, most = 0;
  };
} // namespace strait

#endif
