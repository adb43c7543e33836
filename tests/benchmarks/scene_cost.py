#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What one load and its leak rate cost, stage by stage, and the memory at the peak.

    scene_cost.py [--program build/strait] [--sizes 1024 2048] [--ranks 1 2] [--repeat 1]

The surface is that of prm/paper/fig1_full.prm, with 64 grid points to its shortest wave,
at 0.05 E*. Times are wall-clock seconds, the least of the repetitions: they say something
on a quiet machine only. Bytes are those of all ranks' high-water marks, less what a grid of
64 x 64 points takes, a grid point.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SCENE = HERE.parents[1] / "prm" / "paper" / "fig1_full.prm"
STAGES = ["contact", "flow/channel", "flow/bridge", "flow/mesh and solver", "total"]


def run(program, size, ranks, settings=(), launcher=()):
    """Run the scene; the seconds of its stages, and the bytes of all ranks at their peaks."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "-n", str(ranks), *launcher, str(program), str(SCENE),
                   "--output", folder, "--force", "--quiet"]
        for setting in ["Load programme/Find threshold=false",
                        "Load programme/Reduced loads=",
                        "Load programme/Pressures=0.05",
                        "Theory/Enabled=false",
                        f"Contact/Grid points={size}",
                        f"Surface/Short cut-off wavelength={min(64 / size, 0.25)}",
                        *settings]:
            command += ["--set", setting]
        process = subprocess.Popen(command, env={**os.environ, "OMP_NUM_THREADS": "1"})
        # The largest resident set of any of its descendants: that of one rank.
        _, status, usage = os.wait4(process.pid, 0)
        if status:
            raise SystemExit(f"{' '.join(command)} ended with {status}")
        seconds = json.loads((pathlib.Path(folder) / "run.json").read_text())["seconds"]
        return seconds, 1024. * usage.ru_maxrss * ranks


def fastest(program, size, ranks, repeat):
    runs = [run(program, size, ranks) for _ in range(repeat)]
    return ({stage: min(seconds[stage] for seconds, _ in runs) for stage in STAGES},
            max(bytes_ for _, bytes_ in runs))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=HERE.parents[1] / "build" / "strait")
    parser.add_argument("--sizes", nargs="+", type=int, default=[1024, 2048])
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--repeat", type=int, default=1)
    options = parser.parse_args()

    print(f"{'N':>6} {'ranks':>5}" +
          "".join(f" {stage.split('/')[-1]:>16}" for stage in STAGES) + f" {'bytes':>8}")
    alone = {}
    for ranks in options.ranks:
        base = run(options.program, 64, ranks)[1]
        for size in options.sizes:
            seconds, peak = fastest(options.program, size, ranks, options.repeat)
            alone.setdefault(size, seconds)
            print(f"{size:6d} {ranks:5d}" +
                  "".join(f" {seconds[stage]:8.2f} ({alone[size][stage] / seconds[stage]:4.2f}x)"
                          for stage in STAGES) +
                  f" {(peak - base) / size**2:8.1f}", flush=True)


if __name__ == "__main__":
    main()
