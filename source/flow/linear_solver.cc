// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/linear_solver.h>

namespace strait
{
  LinearSolve
  solve_by_conjugate_gradients(const Multigrid::Matrix &A,
                               Multigrid::Vector       &x,
                               const Multigrid::Vector &b,
                               Multigrid               &multigrid,
                               const double             goal,
                               const unsigned int       max_iterations)
  {
    Multigrid::Vector r(b), z(b), image(b);
    A.vmult(image, x);
    r -= image;
    multigrid.apply(r, z);
    Multigrid::Vector direction(z);

    LinearSolve result;
    result.error_energy = r * z;
    while (result.error_energy > goal && result.iterations < max_iterations)
      {
        A.vmult(image, direction);
        const double step = result.error_energy / (direction * image);
        x.add(step, direction);
        r.add(-step, image);
        multigrid.apply(r, z);
        const double next = r * z;
        direction.sadd(next / result.error_energy, 1., z);
        result.error_energy = next;
        ++result.iterations;
      }
    // Written such that NaN is no success.
    result.converged = result.error_energy <= goal;
    return result;
  }
} // namespace strait
