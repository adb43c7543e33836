#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Damage a file in many ways and see that each is read, or refused with one sentence.

    mutate.py FILE RUNS [SEED]

Every run is a process of its own, within the bounds of strait_import. Exit status 1, and the
damaged files are kept beside FILE, if one of them ends its reader or goes beyond the bounds.
"""
import argparse
import os
import pathlib
import random
import resource
import signal
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from map_import import read  # noqa: E402
from map_import.channel import Refused  # noqa: E402

SECONDS, MEMORY = 30, 2_000_000_000


def damaged(content, chance):
    """A copy with some bytes changed, removed, repeated or swapped for extreme numbers."""
    content = bytearray(content)
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        if not content:
            break
        # Headers decide; half of the damage goes there.
        place = chance.randrange(min(len(content), chance.choice((600, len(content)))))
        kind = chance.randrange(6)
        if kind == 0:
            content[place] = chance.randrange(256)
        elif kind == 1:
            content[place] ^= 1 << chance.randrange(8)
        elif kind == 2:
            del content[place:place + chance.choice((1, 4, 100, len(content)))]
        elif kind == 3:
            content[place:place] = content[place:place + chance.choice((1, 8, 200))]
        elif kind == 4:
            content[place:place + 4] = chance.choice((b"\xff" * 4, b"\0" * 4, b"\x7f\xff\xff\xff",
                                                      b"\xff\xff\xff\x7f", b"9999"))
        else:
            content[place:place + 1] = chance.choice((b"-", b"e", b",", b"\n", b"nan", b"1e308",
                                                      b"\0", b"=", b"%s", b"999999999999"))
    return bytes(content)


def is_withstood(path, scratch):
    """Whether a process that reads the file ends by itself with a map or a refusal."""
    child = os.fork()
    if child == 0:
        status = 1
        try:
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            signal.alarm(SECONDS)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
            try:
                read.read(path, argparse.Namespace(reading=None, decimal=None), scratch)
            except Refused:
                pass
            status = 0
        finally:
            os._exit(status)
    _, status = os.waitpid(child, 0)
    # A library that is brought down ends its process only: strait_import says so and exits with 2.
    return status == 0 or (os.WIFSIGNALED(status) and os.WTERMSIG(status) != signal.SIGALRM)


def mutate(path, n_runs, chance, keep=False):
    """The damaged files that were not withstood."""
    with open(path, "rb") as file:
        content = file.read()
    failures = []
    with tempfile.TemporaryDirectory() as scratch:
        for run in range(n_runs):
            name = f"{run}-{os.path.basename(path)}"
            place = os.path.join(scratch, name)
            with open(place, "wb") as file:
                file.write(damaged(content, chance))
            if not is_withstood(place, scratch):
                failures.append(name)
                if keep:
                    os.replace(place, os.path.join(os.path.dirname(os.path.abspath(path)), name))
    return failures


def main():
    path, n_runs = sys.argv[1], int(sys.argv[2])
    chance = random.Random(sys.argv[3] if len(sys.argv) > 3 else "1")
    failures = mutate(path, n_runs, chance, keep=True)
    print(f"{path}: {n_runs} damaged files, {len(failures)} not withstood {' '.join(failures)}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
