# SPDX-License-Identifier: GPL-2.0-or-later
"""Many scenes with one call."""
from __future__ import annotations

import itertools
import os
import pathlib
import pickle
import queue
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from . import _core
from .results import Table
from .scene import TEMPORARY, Scene, _flatten


# Variables of mpirun that would make another process take itself for this rank.
OF_A_RANK = ("OMPI_COMM_", "OMPI_UNIVERSE_", "OMPI_MCA_orte_", "OMPI_MCA_ess", "OMPI_MCA_pmix",
             "PMIX_")


def sweep(scene: Scene, parameters: Mapping[str, Iterable[Any]] | Iterable[Mapping[str, Any]], *,
          processes: int = 1, table: str = "leakage.csv",
          output: str | os.PathLike | None = None, force: bool = False) -> Table:
    """Run a scene for all combinations of values of some parameters, or for each mapping of a
    list, and join the tables of the runs one below the other.

    The first columns are the parameters, with the value of the scene where a mapping has none.
    `table` is the file that is read from each run, `output` a folder that keeps the runs,
    numbered from 1, where `force` allows to replace the results of other scenes, and `processes`
    the number that run side by side. A column whose unit differs between the runs states none;
    its numbers are in the units of each run's scene. Steps that fail are marked in the column
    status, as are runs that fail altogether; runs without that file add no rows.

    >>> scene = Scene(contact=dict(grid_points=64), fluid=dict(enabled=False),
    ...               surface=dict(short_cut_off_wavelength=0.125))
    >>> table = sweep(scene, {"Surface/Seed": range(1, 4), "Load programme/Pressures": [0.1]})
    >>> [int(seed) for seed in table["Surface/Seed"]], table["contact_area"].shape
    ([1, 2, 3], (3,))
    """
    if isinstance(parameters, Mapping):
        points = [dict(zip(parameters, values))
                  for values in itertools.product(*parameters.values())]
    else:
        points = [dict(_flatten(point)) for point in parameters]
    jobs: list[tuple] = []
    names = dict.fromkeys(name for point in points for name in point)
    for number, point in enumerate(points, 1):
        own = scene.replace(point)  # raises errors of any scene before the first run
        point.update({name: own[name] for name in names if name not in point})
        folder = None if output is None else pathlib.Path(output) / str(number)
        jobs.append((own.path, own.overrides, folder, table, force))
    if processes > 1:
        if _core.rank()[1] > 1:
            raise _core.SceneError("On several ranks a sweep runs one scene after the other, each "
                                   "on all ranks; leave out processes, or mpirun.")
        tables = _run_in_processes(jobs, processes)
    else:
        tables = [_run(*job) for job in jobs]
    # A run that failed altogether tells nothing of the name.
    if not all(tables) and not any(len(columns) > 1 for columns in tables):
        raise FileNotFoundError(f"None of the runs has {table}.")
    return _under_each_other(points, tables)


def _run(path: str, overrides: list[str], folder: os.PathLike | None, table: str,
         force: bool) -> Table:
    try:
        run = Scene._made_of(path, overrides).run(folder or TEMPORARY, force=force)
    except _core.NotConverged as error:
        if not hasattr(error, "run"):
            return Table({"status": np.array(["failed"])})
        run = error.run
    try:
        result = run.csv(table)
    except FileNotFoundError:  # for one without a jump, say
        result = Table({})
    _core.wait_for_all_ranks()  # before a temporary folder is removed
    if run.keeper:
        run.keeper.remove()  # here, as a Ctrl-C in a finaliser would be lost
    return result


def _under_each_other(points: list[dict[str, Any]], tables: list[Table]) -> Table:
    units: dict[str, str] = {}
    columns: dict[str, list[Any]] = {name: [] for point in points for name in point}
    columns.update((name, []) for table in tables for name in table)
    for point, table in zip(points, tables):
        for name in table:
            unit = table.units.get(name, "")
            if units.setdefault(name, unit) != unit:
                units[name] = ""
        for name, values in columns.items():
            if name in table:
                values.extend(table[name])
            else:
                value = point.get(name, np.nan)
                values.extend([value if np.isscalar(value) else str(value)] * table.n_rows)
    return Table({name: np.array(values) for name, values in columns.items()}, units)


def _run_in_processes(jobs: list[tuple], processes: int) -> list[Table]:
    # A process that is ended in a run cannot remove that run's folder.
    with tempfile.TemporaryDirectory(prefix="strait-") as folder:
        return _share_out(jobs, [_Worker(folder) for _ in range(min(processes, len(jobs)))])


def _share_out(jobs: list[tuple], workers: list[_Worker]) -> list[Table]:
    idle: queue.SimpleQueue[_Worker] = queue.SimpleQueue()
    for worker in workers:
        idle.put(worker)

    def run(job):
        worker = idle.get()
        try:
            return worker.run(job)
        finally:
            idle.put(worker)

    pool = ThreadPoolExecutor(len(workers) or 1)
    try:
        return [future.result() for future in [pool.submit(run, job) for job in jobs]]
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        for worker in workers:
            worker.end()
        pool.shutdown()


class _Worker:
    """Another process that runs scenes, one after the other.

    Not one of multiprocessing, which would import the script of the user again; and a fork would
    inherit a running MPI.
    """

    def __init__(self, folder: str):
        """Temporary folders of runs are made in `folder`."""
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith(OF_A_RANK)}
        environment.update(OMP_NUM_THREADS="1",
                           PYTHONPATH=os.pathsep.join(filter(None, map(str, [
                               pathlib.Path(__file__).parents[1],
                               os.environ.get("PYTHONPATH")]))))
        # In a session of its own: Ctrl-C goes to this process, which ends the others.
        self.process = subprocess.Popen(
            [sys.executable, "-c", "from strait.sweep import _work; _work()", folder],
            env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            start_new_session=True)

    def run(self, job: tuple) -> Table:
        """Return the table of a run, or raise the exception that it ended with."""
        try:
            pickle.dump(job, self.process.stdin)
            self.process.stdin.flush()
            answer = pickle.load(self.process.stdout)
        except (EOFError, BrokenPipeError) as error:
            raise RuntimeError("A process of a sweep ended before its run.") from error
        if isinstance(answer, Exception):
            raise answer
        return answer

    def end(self) -> None:
        """End the process at once."""
        self.process.kill()
        self.process.communicate()


def _work() -> None:
    """Run scenes in the other process, until its input ends."""
    tempfile.tempdir = sys.argv[1]
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # keep what libraries print away from the answers
    while True:
        try:
            job = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        try:
            answer: Any = _run(*job)
        except Exception as error:  # pylint: disable=broad-except
            answer = error
        pickle.dump(answer, answers)
        answers.flush()
