# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes as objects."""
from __future__ import annotations

import functools
import os
import re
import shutil
import tempfile
import weakref
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from . import _core
from .results import Run

NO_FILE = os.devnull  # the empty scene file
TEMPORARY = ""  # stands for a temporary folder for the results
# The parameters that are paths, and the word that each may have instead.
PATHS = {"Surface/File": "", "Surface/Second file": "", "Fluid/Mesh": "",
         "Seal/Pressure profile": "hertz"}


def _plain(name: str) -> str:
    """The same form of a name, however it is written."""
    return re.sub(r"[\s_-]+", " ", name.replace("'", "").lower())


@functools.lru_cache(maxsize=1)
def _known_names() -> dict[str, str]:
    """Names of parameters and sections, by their plain forms."""
    names = list(_core.Scene(NO_FILE, []).values)
    names += {name[:k] for name in names for k, c in enumerate(name) if c == "/"}
    return {_plain(name): name for name in names}


def _full_name(name: str) -> str:
    """The name as the program writes it; for an unknown one, at least that of its section."""
    known = _known_names()
    if _plain(name) in known:
        return known[_plain(name)]
    section, _, own = name.rpartition("/")
    return f"{_full_name(section)}/{own}" if section else name


def _text(value: Any) -> str:
    """A value as it stands in a scene file."""
    if value is None:
        return ""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (str, bytes, os.PathLike)):
        return " ".join(os.fsdecode(value).splitlines())
    if isinstance(value, Iterable) and getattr(value, "ndim", 1) > 0:
        return ", ".join(map(_text, value))
    return repr(value.item() if isinstance(value, (np.generic, np.ndarray)) else value)


def _value(text: str) -> Any:
    """The value of such a text."""
    if text in ("true", "false"):
        return text == "true"
    parts = []
    for part in text.split(","):
        try:
            number = float(part)
        except ValueError:
            return text
        parts.append(int(part) if re.fullmatch(r"\s*[-+]?\d+\s*", part) else number)
    return tuple(parts) if len(parts) > 1 else parts[0]


def _flatten(parameters: Mapping[str, Any], section: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in parameters.items():
        if isinstance(value, Mapping):
            yield from _flatten(value, f"{section}{name}/")
        else:
            yield section + name, value


def _from_here(path: str) -> str:
    """An absolute path, from one that counts from the current folder of the first rank.
    Collective."""
    if os.path.isabs(path):
        return path
    return os.path.join(_core.current_folder(), path)


def _override(name: str, text: str) -> str:
    if name in PATHS and text.strip() not in ("", PATHS[name]):
        text = _from_here(text.strip())
    return f"{name}={text}"


def _overrides(*parameters: Mapping[str, Any] | None) -> list[str]:
    for some in parameters:
        if not isinstance(some, (Mapping, type(None))):
            raise TypeError(f"{some!r} is no dictionary of parameters; Scene.from_prm(PATH) reads a "
                            "scene file")
    return [_override(_full_name(name), _text(value))
            for some in parameters for name, value in _flatten(some or {})]


class Scene(_core.Scene):
    """A scene: the content of a scene file, checked.

    Parameters are those of doc/parameters.md, given by their names or as keywords with a dictionary
    for each section. Values are numbers, truth values, texts or sequences of them. The relative
    path of a file counts from the folder that is the current one when it is given:

    >>> a = Scene({"Contact/Grid points": 128, "Surface/Kind": "square saddle"})
    >>> b = Scene(contact=dict(grid_points=128), surface=dict(kind="square saddle"))
    >>> a.text == b.text
    True
    >>> a["Contact/Grid points"], a["Load programme/Pressures"]
    (128, (0.05, 0.1))
    >>> Scene({"Contact/Grid pints": 128})
    Traceback (most recent call last):
    strait.SceneError: --set "Contact/Grid pints=128": ...
    """

    def __init__(self, parameters: Mapping[str, Any] | None = None, /, **more: Any):
        super().__init__(NO_FILE, _overrides(parameters, more))

    @classmethod
    def _made_of(cls, path: str, overrides: list[str]) -> Scene:
        scene = cls.__new__(cls)
        _core.Scene.__init__(scene, path, overrides)
        return scene

    @classmethod
    def from_prm(cls, path: str | os.PathLike, parameters: Mapping[str, Any] | None = None, /,
                 **more: Any) -> Scene:
        """The scene of a file, with other values for some parameters."""
        return cls._made_of(_from_here(os.fspath(path)), _overrides(parameters, more))

    def replace(self, parameters: Mapping[str, Any] | None = None, /, **more: Any) -> Scene:
        """This scene with other values for some parameters.

        >>> Scene().replace(surface=dict(seed=7))["Surface/Seed"]
        7
        """
        return self._made_of(self.path, self.overrides + _overrides(parameters, more))

    def __getitem__(self, name: str) -> Any:
        return _value(self.values[_full_name(name)])

    def __reduce__(self):
        return Scene._made_of, (self.path, self.overrides)

    def __repr__(self) -> str:
        source = "" if self.path == NO_FILE else f"{self.path!r}, "
        return f"Scene({source}{', '.join(map(repr, self.overrides))})"

    @property
    def units(self) -> dict[str, str]:
        """Units of the quantities of a state or a flow, by name; empty if the scene states none.

        >>> Scene(units=dict(length="mm", pressure="MPa"), surface=dict(size=1)).units["gap"]
        'mm'
        """
        dimensions = {
            "length": "gap mean_gap effective_gap indentation constriction_gap heights",
            "pressure": "pressure nominal_pressure fluid_pressure fluid_load",
            "length³/time": "leak_rate lower upper"}
        return {name: self.unit(dimension)
                for dimension, names in dimensions.items() for name in names.split()}

    def run(self, output: str | os.PathLike | None = None, *, verbose: bool = False,
            resume: bool = False, force: bool = False) -> Run:
        """Run the scene as the program does; collective on all ranks.

        Results go to the folder `output`, or else to Output/Directory of the scene. If that is
        not set, or has the default value in a scene file, they go, without pictures, to a
        temporary folder that exists as long as the returned object on the first rank. `verbose`
        shows the log; `resume` and `force` are the options of the program. Ctrl-C ends the run
        within its step; complete steps are kept, and the run can be resumed. Raises NotConverged,
        whose attribute `run` has the results, if a step did not reach what was asked.

        >>> run = Scene(contact=dict(grid_points=64, enabled=False), fluid=dict(viscosity=1/12),
        ...             surface=dict(kind="expression", expression="1 + 0*x")).run()
        >>> [round(rate, 6) for rate in run.table["leak_rate"]]
        [1.0]
        """
        temporary = None
        says_where = (self["Output/Directory"] != "output" or
                      any(text.startswith("Output/Directory=") for text in self.overrides))
        if output == TEMPORARY or (output is None and not says_where):
            temporary = _core.broadcast(tempfile.mkdtemp(prefix="strait-")
                                        if _core.rank()[0] == 0 else "")
            scene = self.replace({"Output/Directory": temporary, "Output/Pictures": False})
        elif output is not None:
            scene = self.replace({"Output/Directory": output})
        else:
            scene = self
        keeper = _TemporaryFolder(temporary) if temporary and _core.rank()[0] == 0 else None
        converged = scene._run(verbose, resume, force or temporary is not None)
        run = Run(scene.directory)
        run.keeper = keeper
        _core.wait_for_all_ranks()  # the first may remove the folder
        if not converged:
            error = _core.NotConverged(
                "Some steps, or states that a critical load or blow-out pressure rests on, did "
                "not reach what was asked; the column status of the table in "
                f"'{scene.directory}' and its log tell which and why.")
            error.run = run
            raise error
        return run


class _TemporaryFolder:
    """A folder that is removed when nothing refers to this object any more."""

    def __init__(self, path: str):
        self.remove = weakref.finalize(self, shutil.rmtree, path, ignore_errors=True)


def checked_heights(heights: np.ndarray | None) -> np.ndarray | None:
    """The heights. Raises SceneError if a mask hides points, which would be taken for heights,
    or if they are complex, of which the real part would be taken."""
    if np.ma.is_masked(heights):
        raise _core.SceneError("The heights have masked points; fill them first.")
    if np.iscomplexobj(heights):
        raise _core.SceneError("The heights are complex numbers; take their real part.")
    return heights


def statistics(heights: np.ndarray, size: float | tuple[float, float] = 1.) -> dict[str, float]:
    """Rms height, slope and curvature, highest and lowest point of a periodic surface on a box
    of `size`. Slope and curvature are those of the sum of waves through the points.

    >>> x = np.linspace(0, 1, 32, endpoint=False)
    >>> round(statistics(np.cos(2 * np.pi * x) * np.ones((32, 1)))["rms_slope"], 6)
    4.442883
    """
    return _core.statistics(checked_heights(heights), np.broadcast_to(size, 2))
