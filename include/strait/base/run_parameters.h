// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

namespace strait
{
  struct ParameterSection;

  /** The direction in which the loads are followed. */
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

    void bind(ParameterSection section);
    void check() const;
  };

  /** The section Realisations: several surfaces of one kind in one run. */
  struct RealisationParameters
  {
    std::vector<unsigned long long> seeds; // empty: that of the surface
    std::vector<int> orientations = {0};   // 0: as is, 1: inverted, 2: rotated, 3: both
    std::vector<int> ranks_each;           // one number; empty: all ranks

    /** Whether the scene lists seeds, or other orientations than `as is`. */
    bool
    enabled() const
    {
      return !seeds.empty() || orientations != std::vector<int>{0};
    }

    void bind(ParameterSection section);
    void check() const;
  };

  /** The section Seal: the whole seal that the realisations are patches of. */
  struct WholeSealParameters
  {
    bool        enabled       = false;
    double      circumference = 0.;
    double      contact_width = 0.;
    std::string pressure_profile; // empty: uniform; "hertz"; or the path of a table
    bool        isotropic        = true;
    double      wanted_leak_rate = 0.; // 0: its load is not searched for
    bool        two_in_a_row     = false;

    void bind(ParameterSection section);
    void check() const;
  };

  /** The name of an orientation in a scene. */
  std::string name_of(int orientation);

  /** Whether this orientation turns the surface by 90 degrees. */
  inline bool
  is_rotated(const int orientation)
  {
    return (orientation & 2) != 0;
  }

  /** What sets n of the effective medium, which seals at the contact fraction 1 − 1/n. */
  enum class TheoryDimension
  {
    bruggeman,         // n = 2
    critical_fraction, // it seals at a given contact fraction
    from_threshold     // it seals at the critical load of this run
  };

  /** The section Theory: Persson's theory and the effective medium beside each step. */
  struct TheoryParameters
  {
    bool            enabled             = false;
    bool            spectrum_of_surface = false; // of the grid's heights, not the model
    bool            simulated_gaps      = false; // in the effective medium, not Persson's
    TheoryDimension dimension           = TheoryDimension::bruggeman;
    double          critical_fraction   = .42;
    double          gamma               = .45;

    void bind(ParameterSection section);
  };

  /** At which steps fields are written. */
  enum class FieldOutput
  {
    none,
    last,
    all
  };

  /** The section Output. */
  struct OutputParameters
  {
    std::string              directory        = "output";
    FieldOutput              fields           = FieldOutput::none;
    bool                     pictures         = true;
    bool                     error_budget     = false; // further errors, from more solves
    bool                     checkpoint       = true;
    bool                     surface_map      = false; // surface.nc
    bool                     surface_spectrum = false; // spectrum.csv
    bool                     report           = false; // report.html
    std::vector<std::string> leak_rate_units;

    void bind(ParameterSection section);
  };
} // namespace strait
