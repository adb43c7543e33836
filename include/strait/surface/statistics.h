// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <optional>
#include <vector>

namespace strait
{
  /** Measures of the roughness of a surface on its grid. */
  struct SurfaceStatistics
  {
    double rms_height       = 0.; // about the mean
    double rms_slope        = 0.; // √(Σ q² |h~|²)
    double rms_curvature    = 0.; // 1/Rc = √(½ Σ (qx⁴ + qy⁴) |h~|²)
    double curvature_radius = 0.; // Rc, infinite for a flat surface
    double highest          = 0.; // largest height
    double lowest           = 0.; // smallest height
  };

  /**
   * Compute the statistics of @p height, in its unit of length. Slope and curvature are
   * those of the trigonometric interpolant, and thus exact for a surface whose waves the
   * grid resolves. Collective.
   */
  SurfaceStatistics statistics(const SlabField &height);

  /** The waves in a ring of the plane of wave vectors. */
  struct SpectrumBin
  {
    double q       = 0.; // geometric mean of the limits, 1/length
    double density = 0.; // mean of C(q), length⁴
    double modes   = 0.; // wave vectors in the ring
  };

  /**
   * The power spectral density of a surface, averaged over directions:
   * C(q) = |h~(q)|² Lx Ly/(2π)², so that ∫d²q C = h_rms², in four rings per octave up to
   * the largest wave number that the grid has in all directions. Rings without a wave are
   * left out. Collective; the same on all ranks.
   */
  std::vector<SpectrumBin> radial_spectrum(const SlabField &heights);

  /** A self-affine law: C constant up to q_r, then ∝ q^(−2(1+H)). */
  struct SelfAffineFit
  {
    double hurst_exponent = 0.;
    double hurst_error    = 0.; // standard error of the fit
    double roll_off       = 0.; // q_r, 1/length
    double plateau        = 0.; // C below q_r, length⁴
    double q_from         = 0.; // range of the bins that were used
    double q_to           = 0.;
    bool   has_roll_off   = false; // else the law starts at the longest wave
  };

  /**
   * Fit the law to the logarithm of @p spectrum, each bin weighted by how well its mean
   * is known. A drop by a factor of 1000 from one bin to the next is a cut-off: the bin
   * before and all beyond are left out. Nothing if fewer than five bins are left.
   */
  std::optional<SelfAffineFit> fit_self_affine(const std::vector<SpectrumBin> &spectrum);
} // namespace strait
