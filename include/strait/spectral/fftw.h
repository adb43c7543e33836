// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_spectral_fftw_h
#define strait_spectral_fftw_h

#include <fftw3.h>

#include <complex>
#include <memory>

/** FFTW's functions for both kinds of numbers under one name. */
namespace strait
{
  /** FFTW's names for what it does with one kind of number. */
  template <class Number>
  struct Fftw;

  /** Those in double precision. */
  template <>
  struct Fftw<double>
  {
    using Complex                              = fftw_complex;
    using Plan                                 = fftw_plan_s;
    static constexpr auto plan_row_forward     = fftw_plan_dft_r2c_1d;
    static constexpr auto plan_row_backward    = fftw_plan_dft_c2r_1d;
    static constexpr auto plan_column          = fftw_plan_dft_1d;
    static constexpr auto execute_row_forward  = fftw_execute_dft_r2c;
    static constexpr auto execute_row_backward = fftw_execute_dft_c2r;
    static constexpr auto execute_column       = fftw_execute_dft;
    static constexpr auto destroy_plan         = fftw_destroy_plan;
    static constexpr auto forget_wisdom        = fftw_forget_wisdom;
  };

  /** Those in single precision. */
  template <>
  struct Fftw<float>
  {
    using Complex                              = fftwf_complex;
    using Plan                                 = fftwf_plan_s;
    static constexpr auto plan_row_forward     = fftwf_plan_dft_r2c_1d;
    static constexpr auto plan_row_backward    = fftwf_plan_dft_c2r_1d;
    static constexpr auto plan_column          = fftwf_plan_dft_1d;
    static constexpr auto execute_row_forward  = fftwf_execute_dft_r2c;
    static constexpr auto execute_row_backward = fftwf_execute_dft_c2r;
    static constexpr auto execute_column       = fftwf_execute_dft;
    static constexpr auto destroy_plan         = fftwf_destroy_plan;
    static constexpr auto forget_wisdom        = fftwf_forget_wisdom;
  };

  /** As FFTW takes them. A std::vector begins at a multiple of 16 B, as FFTW's vector
   *  instructions want. */
  template <class Number>
  typename Fftw<Number>::Complex *
  as_fftw(std::complex<Number> *values)
  {
    return reinterpret_cast<typename Fftw<Number>::Complex *>(values);
  }

  /** Destroys what FFTW has made. */
  template <class Number>
  struct DestroyFftwPlan
  {
    void
    operator()(typename Fftw<Number>::Plan *plan) const
    {
      Fftw<Number>::destroy_plan(plan);
    }
  };

  /** Owner of a plan. */
  template <class Number>
  using FftwPlan = std::unique_ptr<typename Fftw<Number>::Plan, DestroyFftwPlan<Number>>;
} // namespace strait

#endif
