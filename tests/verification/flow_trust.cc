// SPDX-License-Identifier: GPL-2.0-or-later
// Close to the threshold, the throat is far smaller than a grid spacing. The brackets
// must hold all the same: two of one gap may not contradict each other. STRAIT_TRUST_MAPS
// sets the number of random surfaces; doc/accuracy.md reports 20.
#include <strait/contact/contact_solver.h>
#include <strait/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "flow_fixture.h"

namespace strait
{
  namespace
  {
    /** A rough seal of few grid points, and its critical load. */
    class RoughSeal
    {
    public:
      RoughSeal(const int seed, const int n, const int points_per_wave)
      {
        SurfaceParameters surface;
        surface.seed                     = seed;
        surface.short_cut_off_wavelength = static_cast<double>(points_per_wave) / n;
        ContactParameters contact;
        contact.grid_points = {{n, n}};
        contact.tolerance   = 1e-13;
        const auto layout   = make_layout({n, n, 1., 1.}, MPI_COMM_WORLD);
        solver = std::make_unique<ContactSolver>(contact, make_surface(surface, layout));
        double sealed = 2.;
        open_load     = .01;
        while (sealed / open_load - 1 > 1e-9)
          {
            const double load = sealed > 1.5 * open_load ? std::sqrt(sealed * open_load)
                                                         : .5 * (sealed + open_load);
            (percolates(solver->solve(load).gap) ? open_load : sealed) = load;
          }
      }

      static bool
      percolates(const SlabField &gap)
      {
        return find_clusters(gap, FlowDirection::x).percolates;
      }

      SlabField
      gap(const double reduced_load)
      {
        return solver->solve(open_load * (1 - reduced_load)).gap;
      }

    private:
      std::unique_ptr<ContactSolver> solver;
      double                         open_load;
    };

    Leakage
    leak_to(const SlabField &gap, const double accuracy, const unsigned int most_unknowns)
    {
      FluidParameters fluid  = plain_fluid(accuracy);
      fluid.maximum_unknowns = most_unknowns;
      return leak(gap, fluid);
    }

    void
    expect_overlap(const Leakage &a, const Leakage &b)
    {
      EXPECT_LE(a.lower, b.upper) << a.status << ", " << b.status;
      EXPECT_LE(b.lower, a.upper) << a.status << ", " << b.status;
    }

    int
    n_maps()
    {
      const char *wanted = std::getenv("STRAIT_TRUST_MAPS");
      return wanted != nullptr ? std::atoi(wanted) : 4;
    }

    TEST(FlowTrust, NoGoodBracketMissesTheLeakRate)
    {
      int n_rows = 0, n_good = 0;
      for (int map = 0; map < n_maps(); ++map)
        {
          RoughSeal seal(map + 1, map % 4 == 3 ? 64 : 32, map % 2 == 0 ? 8 : 4);
          for (int decade = 1; decade <= 6; ++decade)
            {
              SCOPED_TRACE("map " + std::to_string(map) + ", 1e-" +
                           std::to_string(decade));
              const SlabField gap = seal.gap(std::pow(10., -decade));
              if (!RoughSeal::percolates(gap))
                continue;
              const Leakage coarse = leak_to(gap, .02, 20000);
              const Leakage fine   = leak_to(gap, .002, 40000);
              ++n_rows;
              n_good += coarse.status == "ok" ? 1 : 0;
              EXPECT_NE(coarse.status, "flow-bracket");
              EXPECT_NE(fine.status, "flow-bracket");
              expect_overlap(coarse, fine);
              if (std::getenv("STRAIT_TRUST_MAPS") != nullptr)
                std::printf(
                  "%2d 1e-%d  %-13s %6llu  %.5e %.5e   %-13s %6llu  %.5e %.5e\n",
                  map,
                  decade,
                  coarse.status.c_str(),
                  coarse.unknowns,
                  coarse.lower,
                  coarse.upper,
                  fine.status.c_str(),
                  fine.unknowns,
                  fine.lower,
                  fine.upper);
            }
        }
      // A program that marked every bracket as inaccurate would pass the test above.
      EXPECT_GE(3 * n_good, 2 * n_rows) << n_good << " of " << n_rows;
    }

    // The extremes of the conductivity cannot miss the throat, however coarse the cells.
    TEST(FlowTrust, RigorousBoundsAgreeNearTheThresholdParallel)
    {
      for (int map = 0; map < std::min(n_maps(), 2); ++map)
        {
          RoughSeal       seal(map + 1, 32, 8);
          const SlabField gap    = seal.gap(1e-3);
          FluidParameters fluid  = plain_fluid(.02);
          fluid.rigorous_bounds  = true;
          fluid.maximum_unknowns = 10000;
          expect_overlap(leak_to(gap, .02, 20000), leak(gap, fluid));
        }
    }

    TEST(FlowTrust, DegreeTwoAgreesWithDegreeOne)
    {
      RoughSeal       seal(1, 32, 8);
      const SlabField gap    = seal.gap(1e-3);
      FluidParameters fluid  = plain_fluid(.02);
      fluid.element_degree   = 2;
      fluid.maximum_unknowns = 20000;
      expect_overlap(leak_to(gap, .02, 20000), leak(gap, fluid));
    }
  } // namespace
} // namespace strait
