// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_base_programme_parameters_h
#define strait_base_programme_parameters_h

#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace strait
{
  /** In which direction the loads are taken. */
  enum class LoadPath
  {
    loading,
    unloading,
    cycle
  };

  /** The section Load programme: which loads (or mean gaps), in which order. */
  struct ProgrammeParameters
  {
    std::vector<double> pressures           = {0.05, 0.1};
    bool                find_threshold      = false;
    bool                find_blow_out       = false;
    bool                find_resealing      = false; // after blow-out
    double              threshold_tolerance = 1e-4;
    std::vector<double> reduced_loads;         // 1 − L/L_c
    double              largest_fitted = 0.02; // reduced load
    LoadPath            path           = LoadPath::loading;
    double              jump_tolerance = 1e-3;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
    void        check() const;
  };
} // namespace strait

#endif
