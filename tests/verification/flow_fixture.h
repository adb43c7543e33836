// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/flow/reynolds_solver.h>
#include <strait/percolation/bottleneck.h>
#include <strait/percolation/channel.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace strait
{
  constexpr double pi = 3.14159265358979323846;

  using GapFunction = std::function<double(double x, double y)>;

  /** @p gap sampled at the points of an nx × ny grid on the box lx × ly. */
  inline SlabField
  sample(const GapFunction &gap,
         const int          nx,
         const int          ny,
         const double       lx = 1.,
         const double       ly = 1.)
  {
    SlabField field(make_layout({nx, ny, lx, ly}, MPI_COMM_WORLD));
    for (int row = 0; row < field.layout().n_rows(); ++row)
      for (int ix = 0; ix < nx; ++ix)
        field(ix, row) = gap(ix * lx / nx, (field.layout().first_row() + row) * ly / ny);
    return field;
  }

  /** A liquid in reduced units with η = 1/12, so that K = g³. */
  inline FluidParameters
  plain_fluid(const double target_accuracy = 1e-3)
  {
    FluidParameters fluid;
    fluid.viscosity       = 1. / 12;
    fluid.target_accuracy = target_accuracy;
    return fluid;
  }

  /** The channel of a gap and its conductivity, found as the program does. */
  struct GivenGap
  {
    GivenGap(const SlabField &gap, const FluidParameters &fluid)
      : GivenGap(gap, fluid, fluid.direction)
    {
    }

    GivenGap(const SlabField &gap, const FluidParameters &fluid, const FlowDomain &domain)
      : channel(make_channel(gap, 0., domain, 1))
      , field(gap.layout_pointer(), fluid)
    {
      if (!channel.percolates())
        return;
      field.take_gas(make_rarefied_flow(fluid, channel.paths.front()));
      field.update(channel.gap,
                   1e-8 * field.conductivity_of(channel.paths.front().bottleneck_gap));
    }

    Channel  channel;
    GapField field;
  };

  inline Leakage
  leak(const SlabField                &gap,
       const FluidParameters          &fluid,
       const ReynoldsSolver::Observer &observer = {})
  {
    const GivenGap given(gap, fluid);
    ReynoldsSolver solver(fluid, given.field);
    return solver.run(given.channel, observer);
  }
} // namespace strait
