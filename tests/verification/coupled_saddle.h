// SPDX-License-Identifier: GPL-2.0-or-later
// The saddle with its throat in the middle of the box, and a fluid that presses on the
// walls.
#pragma once

#include "run_fixture.h"

namespace strait
{
  inline Scene
  coupled_saddle(const int n)
  {
    Scene scene                    = saddle_scene(n);
    scene.surface.kind             = SurfaceKind::expression;
    scene.surface.expression       = "2 - cos(2*pi*x) + cos(2*pi*y)";
    scene.fluid.target_accuracy    = .02;
    scene.fluid.feedback.enabled   = true;
    scene.fluid.inlet_pressure     = .15;
    scene.programme.find_threshold = true;
    scene.programme.pressures      = {};
    return scene;
  }
} // namespace strait
