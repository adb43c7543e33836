# SPDX-License-Identifier: GPL-2.0-or-later
"""The model behind a scene: its states, paths, flows and transitions."""
from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from .scene import Scene, checked_heights


class Path(Sequence):
    """States along a path; `path["contact_area"]` is an array of this number of each state."""

    def __init__(self, states: list[_core.State], jumps: list[_core.Jump], parted: bool):
        self.states = states
        self.jumps = jumps  #: discontinuities on the way
        self.parted = parted  #: whether the surfaces parted before the last control

    def __len__(self) -> int:
        return len(self.states)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return np.array([getattr(state, key) for state in self.states])
        return self.states[key]


class Seal(_core.Seal):
    """The seal of a scene: dry, adhesive, plastic or pressed apart by its fluid.

    `heights` replaces the surface of the scene: an array of shape (ny, nx) or, on several ranks,
    the rows of this rank. With Contact/Enabled = false it is the gap itself. `comm` is a
    communicator of mpi4py, or None for all ranks; everything here is collective on it.

    The seal remembers nothing. A state depends on the past only through the state that it is
    reached from:

    >>> seal = Seal(Scene(contact=dict(grid_points=64), fluid=dict(target_accuracy=0.1),
    ...                   surface=dict(short_cut_off_wavelength=0.125)))
    >>> state = seal.solve(0.05)
    >>> state = seal.solve(0.1, from_=state)
    >>> flow = seal.flow(state)
    >>> flow.percolates, flow.lower < flow.leak_rate < flow.upper
    (True, True)
    """

    def __init__(self, scene: Scene, heights: np.ndarray | None = None, comm: Any = None):
        super().__init__(scene, checked_heights(heights), comm)
        self.scene = scene

    def solve(self, control: float | _core.Control = 0., from_: _core.State | None = None
              ) -> _core.State:
        """The state under a nominal pressure (or a mean gap, by Contact/Control) or a `control()`,
        reached from another state or without a past. For a given gap there is only one state."""
        return super().solve(control, from_)

    def follow(self, controls: Iterable[float | _core.Control],
               from_: _core.State | None = None) -> Path:
        """The states at the `controls`, each reached from the one before. Jumps of an adhesive
        contact are enclosed. Steps are halved while the fluid opens or closes a channel in them,
        or while the load that it carries depends on when, within the step, it is cut off. The path
        is shorter if the surfaces part."""
        return Path(*self._follow(list(controls), from_))

    def flow(self, state: _core.State, fields: bool = False) -> _core.Flow:
        """Percolation and leak rate in the gap of a state, to Fluid/Target accuracy. Inlet pressure
        and slip length are those of `state.control`, everything else that of the scene. With
        `fields` also the pressure and current of the fluid at the grid points."""
        return super().flow(state, fields)

    def find_transition(self, first: float | None = None) -> _core.Transition:
        """The critical load, above which nothing leaks, enclosed to Load programme/Threshold
        tolerance. The search begins at the load `first`; raises NotConverged if there is none.
        It is that of the first slip length; find_transitions() finds those of all."""
        return super().find_transitions(first)[0]

    def find_blow_outs(self, loads: Iterable[float]) -> list[_core.BlowOut]:
        """The inlet pressure that opens the seal at each load and, with Load programme/Find
        re-sealing, the one at which it closes again."""
        return super().find_blow_outs(list(loads))


def flow_in_gap(gap: np.ndarray, size: float | tuple[float, float] = 1.,
                parameters: Mapping[str, Any] | None = None, *, fields: bool = False,
                **more: Any) -> _core.Flow:
    """The flow through a given gap, an array of shape (ny, nx), in a box of `size`. The gap is
    closed where it is not positive. Further parameters are those of a Scene; of several slip
    lengths the first one counts.

    >>> x = np.arange(64) / 64
    >>> gap = (1 + np.cos(2 * np.pi * x) / 2) * np.ones((64, 1))
    >>> flow = flow_in_gap(gap, fluid=dict(viscosity=1/12, target_accuracy=1e-3))
    >>> exact = (1 - 1/4)**2.5 / (1 + 1/8)
    >>> bool(flow.lower < exact * 1.001), bool(exact < flow.upper * 1.001)
    (True, True)
    """
    if np.ndim(gap) != 2:
        raise _core.SceneError(f"The gap must be an array of the shape (ny, nx), but has the shape "
                               f"{np.shape(gap)}.")
    n_rows, n_columns = np.shape(gap)
    scene = Scene({"Contact/Enabled": False, "Contact/Grid points": (n_columns, n_rows),
                   "Surface/Kind": "flat", "Surface/Size": size}
                  ).replace(parameters).replace(more)
    seal = Seal(scene, gap)
    return seal.flow(seal.solve(), fields)
