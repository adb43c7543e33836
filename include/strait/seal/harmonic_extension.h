// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_harmonic_extension_h
#define strait_seal_harmonic_extension_h

#include <strait/base/fluid_parameters.h>
#include <strait/spectral/fourier_transform.h>

#include <vector>

namespace strait
{
  /**
   * Continues a fluid pressure, known at the open grid points, smoothly under the
   * contact: there it solves Laplace's equation (five-point stencil), with the
   * pressure at the open points around it and at the reservoirs as boundary values.
   * So it obeys the maximum principle, and a uniform pressure stays uniform.
   *
   * A point that is about to open must not change the result at once, or the iteration
   * of contact and flow jumps to and fro with it. Points at the contact line, whose gap
   * is less than half of the largest beside them, are therefore tied to the fluid by a
   * spring: −∇²p + κ (p − p_f) = 0, with κ from 0 where the gap vanishes to infinity
   * where the point counts as open.
   *
   * Conjugate gradients, preconditioned with the inverse Laplacian of the whole box,
   * screened, in single precision: 20 to 40 FFT pairs.
   */
  class HarmonicExtension
  {
  public:
    HarmonicExtension(SlabLayoutPtr layout, FlowDirection direction);

    /**
     * @p pressure: on entry that of the fluid where @p flow_gap > 0 and a start
     * elsewhere; on return that everywhere, to 1e-7 of the boundary values, or with the
     * residual of the start times @p reduction where that is more. On the seam, which is
     * inlet and outlet at once, every point gets the mean of the two reservoirs, as the
     * sum over the grid is a trapezoidal rule. Returns the number of iterations.
     * Collective.
     */
    int extend(SlabField       &pressure,
               const SlabField &flow_gap,
               double           inlet_pressure,
               double           outlet_pressure,
               double           reduction = 0.);

  private:
    bool is_on_seam(int ix, int local_row) const;

    /** The strength of all springs. */
    void classify(const SlabField &flow_gap);

    /** −Laplacian times dx·dy, and the springs' pull towards 0, where the pressure is
     *  sought, zero elsewhere; the seam counts as @p inlet from its one side and as
     *  @p outlet from the other. */
    void apply(const SlabField &values, double inlet, double outlet, SlabField &result);

    /** z = the preconditioner times r, zero where the pressure is known. */
    void precondition(const SlabField &r, SlabField &z);

    SlabLayoutPtr       layout;
    FlowDirection       direction;
    double              weight_x, weight_y;       // dy/dx and dx/dy
    std::vector<double> stiffness_x, stiffness_y; // of each wave number
    // κ dx dy; infinite where the pressure is known.
    std::vector<double> spring;

    BasicFourierTransform<float> transform;
    std::vector<float>           softness; // that makes all points alike; 0 where known
    std::vector<float>           waves;    // what is transformed
  };
} // namespace strait

#endif
