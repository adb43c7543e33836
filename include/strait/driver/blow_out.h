// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_blow_out_h
#define strait_driver_blow_out_h

#include <strait/percolation/flow_lattice.h>
#include <strait/spectral/state_archive.h>

#include <functional>
#include <optional>

namespace strait
{
  /** The inlet pressure at which an open seal closes when it falls. */
  struct Resealing
  {
    double lower = 0.; // largest inlet pressure known to be held
    double upper = 0.; // smallest known to leak
  };

  /** The inlet pressure at which a seal under a given load begins to leak. */
  struct BlowOut
  {
    double    load         = 0.;
    double    lower        = 0.; // largest inlet pressure known to be held
    double    upper        = 0.; // smallest known to leak; 0: it leaks without any
    double    contact_area = 0.; // at lower
    GridPoint constriction;      // the first to open, at upper
    int       n_solves = 0;      // of contact and flow together

    /** How far the pressure must fall for the open seal to close, if asked for. */
    std::optional<Resealing> resealing;
  };

  /** What one inlet pressure does. */
  struct BlowOutProbe
  {
    bool      leaks        = false;
    double    contact_area = 0.;
    GridPoint constriction; // the narrowest point of the channel, if it leaks
  };

  /** In either direction. Collective. */
  void transfer_probe(StateArchive &archive, BlowOutProbe &probe);

  /**
   * Raise the inlet pressure until the seal leaks, then bisect to the relative width
   * @p tolerance, and see whether it leaks after a small step as well (see
   * approach_slowly()). @p probe gets inlet pressures above that of the outlet and is to
   * start from the last that was held; @p first is where to begin, for example the load.
   * Collective if the probe is. Throws ComputationError if a pressure of a thousand times
   * the first is held.
   */
  BlowOut find_blow_out(const std::function<BlowOutProbe(double)> &probe,
                        double                                     first,
                        double                                     tolerance);

  /**
   * Lower the inlet pressure from @p leaking, at which the seal leaks, until it closes,
   * then bisect, in small steps in the end. Of what leaks with next to no pressure both
   * bounds are 0. The rest as for find_blow_out(), but for where @p probe starts: from
   * the last that leaked; @p n_solves is raised by the number of probes.
   */
  Resealing find_resealing(const std::function<BlowOutProbe(double)> &probe,
                           double                                     leaking,
                           double                                     tolerance,
                           int                                       &n_solves);
} // namespace strait

#endif
