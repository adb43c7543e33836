#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of tools/strait-completion.bash: what bash offers for the command line so far."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "strait-completion.bash"
PROGRAM = os.environ.get("STRAIT_PROGRAM", "strait")


def offers(*words, folder="."):
    """What is offered for the last of the words."""
    program = r"""source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
                  _strait; printf '%s\n' "${COMPREPLY[@]}" """
    result = subprocess.run(["bash", "-c", program, "bash", SCRIPT, PROGRAM, *words], text=True,
                            cwd=folder, capture_output=True, check=True)
    return result.stdout.split("\n")[:-1]


class Completion(unittest.TestCase):
    def test_options(self):
        self.assertEqual(offers("--res"), ["--resume"])
        self.assertEqual(set(offers("--parameters", "")), {"prm", "md"})

    def test_all_options_of_the_help(self):
        told = subprocess.run([PROGRAM, "--help"], text=True, capture_output=True, check=True).stdout
        named = {line.split()[0] for line in told.split("\n") if line.startswith("  --")}
        self.assertEqual(set(offers("--")), named)

    def test_parameters(self):
        self.assertEqual(offers("scene.prm", "--set", '"Contact/Gr'), ['"Contact/Grid points='])
        self.assertIn('"Contact/Adhesion/Range=', offers("--set", "Contact/Adhesion/"))

    def test_scenes(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.prm", "b.csv"):
                (pathlib.Path(folder) / name).touch()
            (pathlib.Path(folder) / "c").mkdir()
            self.assertEqual(offers("", folder=folder), ["a.prm", "c"])


if __name__ == "__main__":
    unittest.main()
