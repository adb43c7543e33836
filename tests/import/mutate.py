#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Damage a file in many ways, and check that each copy is read, or refused with one sentence.

    mutate.py FILE RUNS [SEED]

Each run is a process of its own, within the bounds of strait_import. A copy that makes its reader
crash or exceed the time ends this process alone, as strait_import reports; such runs are counted.
After any other outcome than these, a map or one sentence, the copy is kept beside FILE, and the
exit status is 1.
"""
import argparse
import collections
import os
import pathlib
import random
import resource
import signal
import sys
import tempfile

import h5py  # noqa: F401  here, rather than in each process that reads
import scipy.io  # noqa: F401

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from map_import import read  # noqa: E402
from map_import.channel import Refused  # noqa: E402

SECONDS, MEMORY = 25, 2_000_000_000


def damaged(content, chance):
    """A copy with some bytes changed, removed, repeated or swapped for extreme numbers."""
    content = bytearray(content)
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        if not content:
            break
        # Headers matter most; half of the damage goes there.
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


def outcome(path, scratch):
    """"read" (or refused), "killed" by a signal, "endless" or "error"."""
    child = os.fork()
    if child == 0:
        status = 1
        try:
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            signal.alarm(SECONDS)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
            try:
                read.read(path, argparse.Namespace(
                    reading=None, decimal=None, size=None, unit=None, xy_unit=None), scratch)
            except Refused as reason:
                assert str(reason).strip()
            status = 0
        finally:
            os._exit(status)
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status):
        return "endless" if os.WTERMSIG(status) == signal.SIGALRM else "killed"
    return "error" if status else "read"


def mutate(path, n_runs, chance, keep=False):
    """Read damaged copies of a file; return how often each outcome was met."""
    with open(path, "rb") as file:
        content = file.read()
    counts = collections.Counter()
    with tempfile.TemporaryDirectory() as scratch:
        for run in range(n_runs):
            name = f"{run}-{os.path.basename(path)}"
            place = os.path.join(scratch, name)
            with open(place, "wb") as file:
                file.write(damaged(content, chance))
            found = outcome(place, scratch)
            counts[found] += 1
            if found == "error" and keep:
                os.replace(place, os.path.join(os.path.dirname(os.path.abspath(path)), name))
            elif os.path.exists(place):
                os.remove(place)
    return counts


def main():
    path, n_runs = sys.argv[1], int(sys.argv[2])
    counts = mutate(path, n_runs, random.Random(sys.argv[3] if len(sys.argv) > 3 else "1"),
                    keep=True)
    print(f"{path}: {n_runs} damaged files, "
          + ", ".join(f"{count} {name}" for name, count in counts.items()), flush=True)
    return 1 if counts["error"] else 0


if __name__ == "__main__":
    sys.exit(main())
