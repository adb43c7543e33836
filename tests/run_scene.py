#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Run strait on one scene and judge what it did.

    run_scene.py regression|robustness SCENE.prm --program P --mpirun M --ranks N --folder F

Tags in the comment lines at the top of the scene:

    # MPI: 1 2              numbers of ranks (read by CMake)
    # ARGS: --set "A/B=c"   further arguments of the program
    # TIMEOUT: 60           seconds after which the run counts as hung

regression: the exit status must be 0, and the table F/output/leakage.csv agree
with SCENE/leakage.csv (the folder beside the scene).

    # RTOL: leak_rate=1e-4 mean_gap=1e-9    relative tolerances; others 1e-6
    # NOT COMPARED ACROSS RANKS: cells      columns compared on one rank only

With --accept the table becomes the reference, whatever it was before; look at the
difference before you commit it.

robustness: exit status, messages and table must be as the tags tell.

    # STATUS: 2             exit status, default 0
    # STDERR: regex         must be found on standard error; repeatable
    # STDOUT: regex         must be found on standard output; repeatable
    # COLUMN: leak_rate=0   each row of leakage.csv must have this value
    # RANGE: mean_gap=1..2  or one in this range
    # NOTHING WRITTEN       nothing may have been written to F
    # COMMAND: --frobnicate the whole command line, in place of the scene

SCENE and OUTPUT in ARGS and COMMAND stand for the scene and the output folder.
A scene with an exit status other than 0 must print exactly one line on standard error.
Every row of leakage.csv must make sense: finite numbers, a contact fraction between 0
and 1, and a leak rate within its bounds, which is zero if and only if nothing percolates.
"""
import argparse
import csv
import math
import os
import re
import shlex
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import compare_tables  # noqa: E402

DEFAULT_TIMEOUT = 300


def read_tags(scene):
    """The tags of a scene: a dictionary from name to the list of its values."""
    known = {"MPI", "ARGS", "TIMEOUT", "RTOL", "NOT COMPARED ACROSS RANKS", "STATUS",
             "STDERR", "STDOUT", "COLUMN", "RANGE", "NOTHING WRITTEN", "COMMAND"}
    tags = {}
    with open(scene, encoding="utf-8") as file:
        for line in file:
            if not line.startswith("#"):
                break
            match = re.match(r"# ([A-Z][A-Z ]+[A-Z])(?::\s*(.*?))?\s*$", line)
            if not match:
                continue
            name, value = match.groups()
            if name not in known:
                raise ValueError(f"{scene}: unknown tag '{name}'")
            tags.setdefault(name, []).append(value or "")
    return tags


def command_line(options, tags, output):
    """The arguments of the program."""
    def expand(text):
        places = {"SCENE": options.scene, "OUTPUT": output}
        return [re.sub(r"SCENE|OUTPUT", lambda m: places[m.group()], word)
                for word in shlex.split(text)]

    if "COMMAND" in tags:
        return expand(tags["COMMAND"][0])
    extra = [word for text in tags.get("ARGS", []) for word in expand(text)]
    folder = [] if "--output" in extra or any("Output/Directory" in w for w in extra) \
        else ["--output", output]
    return [options.scene] + folder + extra


def run(options, tags, output):
    """The finished process, or None if it had to be stopped."""
    command = [options.program] + command_line(options, tags, output)
    if options.ranks > 1:
        # --quiet: no report of mpirun's own on a status other than 0.
        command = [options.mpirun, "--quiet", "-np", str(options.ranks)] + command
    print(shlex.join(command), flush=True)
    timeout = float(tags.get("TIMEOUT", [DEFAULT_TIMEOUT])[0])
    with subprocess.Popen(command, cwd=options.folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        try:
            stdout, stderr = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.terminate()  # mpirun passes it on to the ranks
            process.communicate()
            return None, f"still running after {timeout:g} s"
    return (process.returncode, stdout, stderr), None


def check_messages(tags, status, stdout, stderr):
    problems = []
    for name, text in (("STDERR", stderr), ("STDOUT", stdout)):
        for pattern in tags.get(name, []):
            if not re.search(pattern, text):
                problems.append(f"no match for /{pattern}/ on {name.lower()}")
    messages = [line for line in stderr.splitlines() if line.strip()]
    if status != 0 and len(messages) != 1:
        problems.append(f"expected one line on stderr, found {len(messages)}")
    return problems


def check_columns(tags, rows):
    problems = []
    wanted = dict(text.split("=", 1) for text in tags.get("COLUMN", []))
    ranges = dict(text.split("=", 1) for text in tags.get("RANGE", []))
    for number, row in enumerate(rows, start=1):
        for name in [*wanted, *ranges]:
            if name not in row:
                problems.append(f"column {name} is missing")
        for name, value in wanted.items():
            if name in row and compare_tables.cells_differ(value, row[name], 0.):
                problems.append(f"column {name}, row {number}: expected {value}, "
                                f"found {row[name]}")
        for name, interval in ranges.items():
            low, high = map(float, interval.split(".."))
            if name in row and not low <= float(row[name]) <= high:
                problems.append(f"column {name}, row {number}: {row[name]} is not in "
                                f"{interval}")
    return problems


def check_sense(rows):
    """Check what must hold in every row of every scene.

    Numbers must be finite, except the worst constriction of a sealed step, and those of
    a row where the walls have lifted off.
    """
    problems = []
    for number, row in enumerate(rows, start=1):
        numbers = {}
        for name, text in row.items():
            try:
                numbers[name] = float(text)
            except (TypeError, ValueError):
                continue
            is_left_out = row.get("status") == "lifted-off" or (
                row.get("percolates") == "0" and name.startswith("worst_constriction"))
            if not math.isfinite(numbers[name]) and not is_left_out:
                problems.append(f"row {number}: {name} is {text}")
        area, rate = numbers.get("contact_area", 0.), numbers.get("leak_rate", 0.)
        if not 0. <= area <= 1.:
            problems.append(f"row {number}: the contact fraction is {area}")
        if not numbers.get("leak_rate_lower", rate) <= rate <= \
                numbers.get("leak_rate_upper", rate):
            problems.append(f"row {number}: the leak rate is not within its bounds")
        if (rate > 0.) != (numbers.get("percolates", float(rate > 0.)) == 1.):
            problems.append(f"row {number}: leak rate {rate} and percolates "
                            f"{numbers['percolates']:g}")
    return problems


def check_table(tags, table):
    if not os.path.exists(table):
        return [f"{table} was not written"] if {"COLUMN", "RANGE"} & tags.keys() else []
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    problems = [] if rows else [f"{table} has no row"]
    return problems + check_columns(tags, rows) + check_sense(rows)


def judge_robustness(options, tags, output, outcome):
    status, stdout, stderr = outcome
    problems = []
    expected = int(tags.get("STATUS", ["0"])[0])
    if status != expected:
        problems.append(f"expected exit status {expected}, found {status}")
    problems += check_messages(tags, expected, stdout, stderr)
    if "NOTHING WRITTEN" in tags and os.listdir(options.folder):
        problems.append(f"expected nothing written, found {os.listdir(options.folder)}")
    return problems + check_table(tags, os.path.join(output, "leakage.csv"))


def judge_regression(options, tags, output, outcome):
    status = outcome[0]
    if status != 0:
        return [f"expected exit status 0, found {status}"]
    reference = os.path.join(os.path.splitext(options.scene)[0], "leakage.csv")
    result = os.path.join(output, "leakage.csv")
    if options.accept:
        os.makedirs(os.path.dirname(reference), exist_ok=True)
        shutil.copyfile(result, reference)
    if not os.path.exists(reference):
        return [f"the reference {reference} is missing; if {result} is right, use --accept"]
    rtol = dict(compare_tables.parse_tolerance(word)
                for text in tags.get("RTOL", []) for word in text.split())
    if options.ranks > 1:
        for text in tags.get("NOT COMPARED ACROSS RANKS", []):
            rtol.update((name, float("inf")) for name in text.split())
    try:
        return compare_tables.compare(reference, result, rtol)
    except (OSError, ValueError) as error:
        return [str(error)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=["regression", "robustness"])
    parser.add_argument("scene", type=os.path.abspath)
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--folder", required=True, type=os.path.abspath)
    parser.add_argument("--accept", action="store_true")
    options = parser.parse_args()

    tags = read_tags(options.scene)
    shutil.rmtree(options.folder, ignore_errors=True)
    os.makedirs(options.folder)
    output = os.path.join(options.folder, "output")
    outcome, hung = run(options, tags, output)
    if hung:
        problems = [hung]
    else:
        judge = judge_regression if options.kind == "regression" else judge_robustness
        problems = judge(options, tags, output, outcome)
        if problems:
            print("--- standard output\n" + outcome[1] + "--- standard error\n" + outcome[2])
    for problem in problems:
        print("FAILED: " + problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
