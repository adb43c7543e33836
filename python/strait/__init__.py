# SPDX-License-Identifier: GPL-2.0-or-later
"""Leakage of rough elastic seals, from Python.

There are three levels, from the whole to its parts:

- `Scene` is a scene file as an object. `Scene.run` does the same as the program and returns a
  `Run`, the results in a folder; `sweep` runs many scenes.
- `Seal` is the model behind a scene: it presses a surface (`Seal.solve`, `Seal.follow`), computes
  the flow (`Seal.flow`), and finds the critical load (`Seal.find_transition`).
- `flow_in_gap` computes the leak rate through a given gap, with its bounds.

Arrays have the shape (ny, nx) for `Contact/Grid points = nx, ny`; lengths, pressures and times
are in the units of the scene. A bad scene raises `SceneError`, a result that was not reached
`NotConverged`; something doubtful is a `SceneWarning`.

>>> import strait
>>> seal = strait.Seal(strait.Scene(surface=dict(kind="sphere", amplitude=2),
...                                 contact=dict(grid_points=64), fluid=dict(enabled=False)))
>>> state = seal.solve(0.01)
>>> state.pressure.shape, round(state.pressure.mean(), 6)
((64, 64), 0.01)
"""


class SceneWarning(UserWarning):
    """A setting of a scene, or a result, that is allowed but should be looked at."""


# The compiled part needs the class above.
from ._core import (BlowOut, Control, Flow, Jump, NotConverged, SceneError, State,  # noqa: E402
                    Transition, __version__)
from .results import Run, Table, read_table  # noqa: E402
from .scaling import closing_law, fit_exponent  # noqa: E402
from .scene import Scene, statistics  # noqa: E402
from .seal import Path, Seal, flow_in_gap  # noqa: E402
from .sweep import sweep  # noqa: E402

for _class in (BlowOut, Control, Flow, Jump, NotConverged, SceneError, State, Transition):
    _class.__module__ = "strait"  # where users find it

__all__ = ["BlowOut", "Control", "Flow", "Jump", "NotConverged", "Path", "Run", "Scene",
           "SceneError", "SceneWarning", "Seal", "State", "Table", "Transition", "__version__",
           "closing_law", "fit_exponent", "flow_in_gap", "read_table", "statistics", "sweep"]
