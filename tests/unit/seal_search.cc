// SPDX-License-Identifier: GPL-2.0-or-later
// How many states a search asks for in a seal whose critical load is known.
#include <strait/seal/seal_search.h>
#include <strait/spectral/slab_field.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    constexpr double critical_load = 1.436;

    /** A saddle-shaped gap that the load lowers as a whole; closes at critical_load. */
    SealState
    closing_saddle(const SlabLayoutPtr &layout, const Control &control)
    {
      SlabField gap = sample(layout, [&](const double x, const double y) {
        return critical_load - control.target +
               .5 * (std::cos(2. * M_PI * x) - std::cos(2. * M_PI * y));
      });
      SlabField pressure(layout);
      for (std::size_t k = 0; k < gap.size(); ++k)
        {
          pressure[k] = std::max(-gap[k], 0.);
          gap[k]      = std::max(gap[k], 0.);
        }
      SealState state;
      state.control = control;
      state.contact.emplace(std::move(pressure), std::move(gap));
      state.contact->converged = true;
      return state;
    }

    Transition
    found_with(const bool path_matters, const bool zooms)
    {
      Scene scene;
      scene.fluid.feedback.enabled        = path_matters;
      scene.contact.zoom.enabled          = zooms;
      scene.contact.effective_modulus     = 1.;
      scene.programme.threshold_tolerance = 1e-3;
      const SlabLayoutPtr layout          = make_layout({32, 32, 1., 1.}, MPI_COMM_WORLD);
      const SealModel     model = [&](const Control &control, const SealState *, Aim) {
        return closing_saddle(layout, control);
      };
      Log        log(MPI_COMM_WORLD, true);
      SealSearch search(scene, model, layout, FlowDirection::x, log);
      return search.find_critical_loads({1.25}).front();
    }

    TEST(SealSearch, WindowsAddQuestionsOnlyWithoutAPath)
    {
      const Transition on_path   = found_with(true, false),
                       on_zoomed = found_with(true, true);
      for (const Transition &found : {on_path, on_zoomed})
        {
          EXPECT_LE(found.lower, critical_load);
          EXPECT_GE(found.upper, critical_load);
          EXPECT_LE(found.relative_width(), 1e-3);
        }
      EXPECT_EQ(on_zoomed.n_solves, on_path.n_solves);
      // Without a path, both ends are asked again, as windows may still change answers.
      EXPECT_EQ(found_with(false, true).n_solves, found_with(false, false).n_solves + 2);
    }
  } // namespace
} // namespace strait
