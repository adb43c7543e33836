# SPDX-License-Identifier: GPL-2.0-or-later
"""Types of the compiled part; its docstrings describe what it does."""
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

class SceneError(ValueError): ...
class NotConverged(RuntimeError):
    run: Any

class Scene:
    def __init__(self, path: str, overrides: list[str]) -> None: ...
    @property
    def path(self) -> str: ...
    @property
    def overrides(self) -> list[str]: ...
    @property
    def values(self) -> dict[str, str]: ...
    @property
    def text(self) -> str: ...
    @property
    def directory(self) -> str: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def size(self) -> tuple[float, float]: ...
    def unit(self, dimension: str) -> str: ...
    def heights(self, comm: Any = None) -> NDArray[np.float64]: ...
    def describe(self) -> None: ...
    def _run(self, verbose: bool, resume: bool, force: bool) -> bool: ...

class Control:
    target: float
    inlet_pressure: float
    slip_length: float

class State:
    control: Control
    gap: NDArray[np.float64]
    pressure: NDArray[np.float64] | None
    fluid_pressure: NDArray[np.float64] | None
    indentation: NDArray[np.float64] | None
    first_row: int
    mean_gap: float
    nominal_pressure: float | None
    contact_area: float | None
    contact_area_corrected: float | None
    residual: float | None
    iterations: int | None
    adhesive_energy: float | None
    plastic_area: float | None
    fluid_load: float | None
    converged: bool

class Flow:
    percolates: bool
    leak_rate: float
    lower: float
    upper: float
    effective_gap: float
    status: str
    cells: int
    unknowns: int
    constriction_x: float
    constriction_y: float
    constriction_gap: float
    clusters: NDArray[np.uint8]
    pressure: NDArray[np.float64] | None
    current: NDArray[np.float64] | None

class PathPoint:
    pressure: float
    mean_gap: float
    contact_area: float
    energy: float

class Jump:
    before: PathPoint
    after: PathPoint
    dissipated: float
    is_pull_off: bool

class Transition:
    lower: float
    upper: float
    middle: float
    contact_area: float
    place: list[float]
    slip_length: float
    n_solves: int

class BlowOut:
    load: float
    opening: Transition
    closing: Transition | None

class Seal:
    def __init__(self, scene: Scene, heights: NDArray[np.float64] | None = None,
                 comm: Any = None) -> None: ...
    def control(self, target: float, inlet_pressure: float | None = None,
                slip_length: float | None = None) -> Control: ...
    def solve(self, control: float | Control = 0., from_: State | None = None) -> State: ...
    def _follow(self, controls: list[float | Control], from_: State | None = None
                ) -> tuple[list[State], list[Jump], bool]: ...
    def flow(self, state: State, fields: bool = False) -> Flow: ...
    def find_transitions(self, first: float | None = None) -> list[Transition]: ...
    def find_blow_outs(self, loads: list[float]) -> list[BlowOut]: ...
    @property
    def rms_slope(self) -> float: ...

def statistics(heights: NDArray[np.float64], size: Any) -> dict[str, float]: ...
def broadcast(text: str) -> str: ...
def current_folder() -> str: ...
def wait_for_all_ranks() -> None: ...
def rank() -> tuple[int, int]: ...
