#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Stop, kill and resume runs of strait; their tables must be those of undisturbed runs.

    check_survival.py --program P --mpirun M --folder F [TEST ...]

The scenes are small. Each test has a folder of its own.
"""
import argparse
import glob
import json
import math
import os
import pty
import random
import resource
import select
import shutil
import signal
import subprocess
import sys
import termios
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import compare_tables  # noqa: E402

SAME = 1e-9
N_KILLS = 20
# On another number of ranks the last digits differ. The contact changes hardly more, but
# now and then another cell is refined, and counts change.
ACROSS_RANKS = {name: 1e-3 for name in (
    "leak_rate", "leak_rate_lower", "leak_rate_upper", "effective_gap", "cells",
    "unknowns")}
ACROSS_RANKS.update((name, float("inf")) for name in (
    "fft_pairs", "contact_iterations", "flow_iterations", "contact_residual",
    "refinements"))
ACROSS_RANKS.update(leak_rate_lower=2e-2, leak_rate_upper=2e-2, cells=2e-1, unknowns=2e-1)

ROUGH = """
subsection Surface
  set Roll-off wavelength = 0.5
  set Short cut-off wavelength = 0.125
end
subsection Output
  set Pictures = false
end
subsection Contact
  set Grid points = 64
end
"""
DRY = ROUGH + """
subsection Fluid
  set Slip length = 0, -0.001
end
subsection Load programme
  set Pressures = 0.05, 0.054, 0.057, 0.1
  set Find threshold = true
  set Threshold tolerance = 1e-3
  set Reduced loads = 0.3
end
"""
ADHESIVE = ROUGH + """
subsection Contact
  subsection Adhesion
    set Enabled = true
    set Surface energy = 0.004
    set Range = 0.02
  end
end
subsection Fluid
  set Slip length = 0, -0.001
end
subsection Load programme
  set Pressures = 0.02, 0.04, 0.06, 0.08
  set Path = cycle
end
"""
PARTING = ADHESIVE.replace("0.02, 0.04, 0.06, 0.08\n  set Path = cycle", """0.02, -0.5
  set Find threshold = true
  set Threshold tolerance = 1e-3
  set Reduced loads = 0.3, 0.2, 0.1, 0.05""")
MATCHED = ADHESIVE.replace("Surface energy = 0.004", "Match area at pressure = 0.03")
YIELDING = ROUGH + """
subsection Contact
  set Yielding = cut-off
  set Hardness = 0.3
end
subsection Load programme
  set Pressures = 0.02, 0.06, 0.065, 0.07
  set Path = cycle
end
"""
WITH_ERRORS = ROUGH.replace("= 64", "= 128") + """
subsection Output
  set Error budget = true
end
subsection Load programme
  set Pressures = 0.05, 0.052, 0.054, 0.056
end
"""
COUPLED = ROUGH + """
subsection Fluid
  set Inlet pressure = 0.02
  set Target accuracy = 0.2
  subsection Wall feedback
    set Enabled = true
  end
end
subsection Load programme
  set Pressures = 0.05, 0.053, 0.056
end
"""
SLOWLY_COUPLED = COUPLED.replace("= 0.05, 0.053, 0.056", "= 0.03, 0.035, 0.04, 0.045, 0.05"
                                 ).replace("0.02", "0.01")
ZOOMED = ROUGH + """
subsection Contact
  subsection Zoom
    set Enabled = true
    set Maximum levels = 2
  end
end
subsection Load programme
  set Pressures = 0.035, 0.04, 0.045, 0.05, 0.055, 0.06
end
"""
COUNTED = ZOOMED.replace("= 0.035, 0.04, 0.045, 0.05, 0.055, 0.06", "=") + """
subsection Load programme
  set Find threshold = true
  set Threshold tolerance = 1e-4
  set Reduced loads = 0.2, 0.1, 0.05, 0.02
end
"""
LONG = """
subsection Contact
  set Grid points = 1024
  set Solver = polonsky-keer
  set Tolerance = 1e-13
  set Maximum iterations = 100000
end

subsection Load programme
  set Pressures = 0.1
end
"""
OPTIONS = None


def n_rows(folder):
    """The number of rows of the table so far."""
    try:
        with open(os.path.join(folder, "leakage.csv"), encoding="utf-8") as file:
            return max(0, sum(1 for line in file if line.endswith("\n")) - 1)
    except FileNotFoundError:
        return 0


def contents(folder):
    """The contents of all files in a folder, by name."""
    found = {}
    for path in glob.glob(os.path.join(folder, "**"), recursive=True):
        if os.path.isfile(path):
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = file.read()
    return found


class Survival(unittest.TestCase):
    def setUp(self):
        self.folder = os.path.join(OPTIONS.folder, self.id().split(".")[-1])
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def scene(self, text, name="scene.prm"):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def start(self, scene, output, *options, ranks=1, **how):
        command = [OPTIONS.program, "--quiet", scene, "--output", output, *options]
        if ranks > 1:
            command = [OPTIONS.mpirun, "--quiet", "-np", str(ranks)] + command
        return subprocess.Popen(command, text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **how)

    def run_to_end(self, *arguments, status=0, **how):
        """Let a run end by itself; return what it prints on standard error."""
        with self.start(*arguments, **how) as process:
            message = process.communicate(timeout=120)[1]
        if status is not None:
            self.assertEqual(process.returncode, status, message)
        return message

    references = {}

    def reference(self, scene):
        """The folder of an undisturbed run of the same scene."""
        with open(scene, encoding="utf-8") as file:
            text = file.read()
        if text not in self.references:
            self.run_to_end(scene, self.path("reference"))
            self.references[text] = self.path("reference")
        return self.references[text]

    def wait_for_rows(self, process, output, number):
        while n_rows(output) < number and process.poll() is None:
            time.sleep(0.002)

    def wait_for_checkpoint(self, process, output, number):
        """Wait until the step of this row is complete and the next one has begun."""
        paths = [os.path.join(output, name) for name in ("leakage.csv", "checkpoint")]
        while process.poll() is None:
            try:
                row, checkpoint = (os.stat(path).st_mtime_ns for path in paths)
                if n_rows(output) >= number and checkpoint > row:
                    return
            except FileNotFoundError:
                pass
            time.sleep(0.002)

    @staticmethod
    def error_budget(folder):
        with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
            record = json.load(file)
        return [step["relative_errors"] for step in record.get("error_budget", [])]

    def assert_same(self, reference, output):
        for path in sorted(glob.glob(os.path.join(reference, "*.csv"))):
            name = os.path.basename(path)
            problems = compare_tables.compare(path, os.path.join(output, name),
                                              default_rtol=SAME)
            self.assertEqual(problems, [], name)
        # The record covers all steps, also those before a stop.
        expected, found = map(self.error_budget, (reference, output))
        self.assertEqual(len(expected), len(found))
        for one, other in zip(expected, found):
            self.assertEqual(one.keys(), other.keys())
            for name in one:
                same = (one[name] is other[name] if None in (one[name], other[name])
                        else math.isclose(one[name], other[name], rel_tol=SAME))
                self.assertTrue(same, f"{name}: {one[name]} and {other[name]}")
        # No temporary files are left.
        self.assertEqual(glob.glob(os.path.join(output, "*.new")), [])

    def test_killed_at_random(self):
        scene = self.scene(DRY)
        reference = self.reference(scene)
        random.seed(1)
        kills = finished = 0
        while kills < N_KILLS:
            output = self.path(f"run-{finished}")
            options = []
            patience = 1.  # grows, so that a busy machine comes to an end as well
            while True:
                patience *= 1.05
                limit = random.uniform(.1, patience) if kills < N_KILLS else 120
                with self.start(scene, output, *options) as process:
                    try:
                        message = process.communicate(timeout=limit)[1]
                    except subprocess.TimeoutExpired:
                        process.kill()
                        process.communicate()
                        kills += 1
                        saved = os.path.exists(os.path.join(output, "checkpoint"))
                        options = ["--resume"] if saved else []
                        continue
                self.assertEqual(process.returncode, 0, message)
                break
            self.assert_same(reference, output)
            finished += 1
        print(f"{kills} kills, {finished} runs finished", flush=True)

    def assert_not_begun_anew(self, scene, output):
        before = contents(output)
        message = self.run_to_end(scene, output, status=2)
        self.assertRegex(message, "run of this scene that has not come to its end; .*--force")
        self.assertEqual(contents(output), before)

    def stopped_and_resumed(self, text, rows, number=signal.SIGTERM, more=()):
        """Stop a run after each of these numbers of rows, end it with more options; compare it.

        Many steps should remain, as on a busy machine some pass before the signal arrives.
        """
        scene = self.scene(text)
        reference = self.reference(scene)
        output = self.path("stopped")
        options = []
        for n in rows:
            # A new row shows that the process is ready for a signal.
            n = max(n, n_rows(output) + 1)
            if options and n >= n_rows(reference):
                break
            with self.start(scene, output, *options) as process:
                self.wait_for_rows(process, output, n)
                process.send_signal(number)
                message = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 3, message)
            self.assertRegex(message, "(?m)^strait: Stopped by .*--resume continues.\n\\Z")
            self.assertGreaterEqual(n_rows(output), n)
            self.assertTrue(os.path.exists(os.path.join(output, "run.json")))
            options = ["--resume"]
        self.assert_not_begun_anew(scene, output)
        self.run_to_end(scene, output, "--resume", *more)
        self.assert_same(reference, output)
        before = contents(output)
        self.run_to_end(scene, output, "--resume")  # nothing is left to do
        self.assertEqual(contents(output), before)

    def test_stopped_with_adhesion(self):
        self.stopped_and_resumed(ADHESIVE, [1, 4, 10])

    def test_stopped_after_a_pull_off(self):
        self.stopped_and_resumed(PARTING, [3, 5])
        self.assertEqual(n_rows(self.path("stopped")), 10)  # of 12: none at -0.5

    def test_stopped_with_matched_adhesion(self):
        self.stopped_and_resumed(MATCHED, [1])
        with open(self.path("stopped/log.txt"), encoding="utf-8") as file:
            self.assertEqual(file.read().count("surface energy is sought"), 1)

    def test_stopped_while_yielding(self):
        # The grid of every second point, for the errors, keeps indentations of its own.
        self.stopped_and_resumed(YIELDING + "subsection Output\n  set Error budget = true\nend\n",
                                 [1, 4])

    def test_stopped_with_error_budget(self):
        self.stopped_and_resumed(WITH_ERRORS, [1], more=["--set", "Output/Surface spectrum=true"])
        self.assertIn("spectrum.csv", os.listdir(self.path("stopped")))

    def test_stopped_with_zoom(self):
        self.stopped_and_resumed(ZOOMED, [1, 2])

    def test_stopped_with_zoom_and_feedback(self):
        zoom = ZOOMED[ZOOMED.index("subsection Contact\n  subsection Zoom"):]
        zoom = zoom[:zoom.index("subsection Load programme")]
        self.stopped_and_resumed(SLOWLY_COUPLED + zoom, [1, 2])

    def test_stopped_with_zoom_and_threshold(self):
        self.stopped_and_resumed(COUNTED, [1])

    def test_stopped_with_feedback(self):
        self.stopped_and_resumed(SLOWLY_COUPLED, [1, 2], signal.SIGINT)

    def test_stopped_with_trapped_fluid(self):
        # The fluid of a row depends on the rows before: between the second and the last one
        # some fluid is compressed that no reservoir reaches.
        trapped = COUPLED.replace("Enabled = true", "Enabled = true\n    set Trapped fluid = "
                                  "compressible\n    set Bulk modulus = 1")
        trapped = trapped.replace("0.05, 0.053, 0.056", "0.2, 0.3, 0.4, 0.3, 0.2")
        self.stopped_and_resumed(trapped.replace("subsection Surface",
                                                 "subsection Surface\n  set Seed = 3"), [2])

    def test_ended_by_the_second_interrupt(self):
        """On a terminal, whose last line shows the current step."""
        scene = self.scene(LONG)
        screen, terminal = pty.openpty()
        termios.tcsetwinsize(terminal, (24, 80))
        with subprocess.Popen([OPTIONS.program, scene, "--output", self.path("output")],
                              stdout=terminal, stderr=terminal) as process:
            os.close(terminal)
            shown = b""

            def read_until(ending):
                nonlocal shown
                deadline = time.monotonic() + 60
                while not shown.endswith(ending) and time.monotonic() < deadline:
                    if select.select([screen], [], [], 1)[0]:
                        shown += os.read(screen, 4096)
                self.assertTrue(shown.endswith(ending), shown.decode())

            read_until(b"\rstep 1 of 1\x1b[K")
            process.send_signal(signal.SIGINT)
            read_until(b"Ctrl-C again ends the run at once.\r\n")
            process.send_signal(signal.SIGINT)
            read_until(b"strait: Ended at once, as it was asked to twice; --resume continues "
                       b"from the last checkpoint, if there is one.\r\n")
            self.assertEqual(process.wait(timeout=10), -signal.SIGINT)
        os.close(screen)

    @staticmethod
    def wait_for_script(process, name):
        """Wait until the run has started a script, and this the interpreter."""
        while process.poll() is None:
            for path in glob.glob("/proc/[0-9]*/cmdline"):
                try:
                    with open(path, "rb") as file:
                        words = file.read().decode(errors="replace").split("\0")
                    if (os.getpgid(int(path.split("/")[2])) == process.pid and
                            "python" in words[0] and words[1].endswith("/" + name)):
                        return
                except (OSError, IndexError):  # it has just ended
                    pass
            time.sleep(0.002)

    def test_interrupted_in_a_script(self):
        """Ctrl-C reaches scripts as well; what has begun is completed."""
        scene = self.scene(ROUGH.replace("Pictures = false", "Pictures = true") + """
subsection Load programme
  set Pressures = 0.05
  set Find threshold = true
  set Reduced loads = 0.3, 0.2
  set Largest reduced load of fits = 0.3
end
""")
        with self.start(scene, self.path("output"), start_new_session=True) as process:
            for script, number in (("fit.py", signal.SIGINT), ("plot.py", signal.SIGTERM)):
                self.wait_for_script(process, script)
                self.assertIsNone(process.poll())
                os.killpg(process.pid, number)
            message = process.communicate(timeout=120)[1]
        self.assertNotIn("failed", message)
        self.assertEqual(process.returncode, 0, message)
        for name in ("fit.csv", "leakage.png", "picture-1.png"):
            self.assertTrue(os.path.exists(self.path("output/" + name)), name)

    def wait_for_probes(self, process, output, number):
        """Wait until the checkpoint has been rewritten this many times."""
        path = os.path.join(output, "checkpoint")
        last = None
        while process.poll() is None and number >= 0:
            try:
                written = os.stat(path).st_mtime_ns
                number -= written != last
                last = written
            except FileNotFoundError:
                pass
            time.sleep(0.001)

    @staticmethod
    def wait_for_log(process, output, text):
        while process.poll() is None:
            try:
                with open(os.path.join(output, "log.txt"), encoding="utf-8") as file:
                    if text in file.read():
                        return
            except FileNotFoundError:
                pass
            time.sleep(0.002)

    def test_stopped_in_a_search(self):
        search = "subsection Load programme\n  set Threshold tolerance = 1e-4\n"
        threshold = search + "  set Find threshold = true\nend\n"
        blow_out = search + "  set Find blow-out = true\nend\n"
        both = (COUPLED.replace("0.02", "0.06")
                .replace("subsection Surface\n", "subsection Surface\n  set Seed = 3\n")
                .replace("0.125", "0.25").replace("= 64", "= 32")
                .replace("= 0.05, 0.053, 0.056", "= 0.3") + search.replace("1e-4", "3e-3")
                + "  set Find threshold = true\n  set Find blow-out = true\n"
                "  set Find re-sealing = true\nend\n")
        for name, text in (("dry", DRY.replace("1e-3", "1e-4")),
                           ("adhesive", ADHESIVE + threshold),
                           ("coupled", COUPLED.replace("0.02", "0.002") + threshold),
                           ("blow-out", COUPLED.replace("0.05, 0.053, 0.056", "0.2") + blow_out),
                           ("both", both)):
            with self.subTest(name):
                scene = self.scene(text, name + ".prm")
                self.run_to_end(scene, self.path(name + "-reference"), status=None)
                output = self.path(name)
                options = []
                for how in (signal.SIGTERM, signal.SIGKILL):
                    with self.start(scene, output, *options) as process:
                        if name == "both": # stop in the second search
                            self.wait_for_log(process, output, "threshold: critical load")
                        self.wait_for_probes(process, output, 3)
                        process.send_signal(how)
                        message = process.communicate(timeout=60)[1]
                    self.assertEqual(process.returncode, 3 if how == signal.SIGTERM
                                     else -signal.SIGKILL, message)
                    self.assertEqual(n_rows(output), 0)
                    options = ["--resume"]
                self.run_to_end(scene, output, "--resume", status=None)
                with open(os.path.join(output, "log.txt"), encoding="utf-8") as file:
                    log = file.read()
                self.assertRegex(log, "resumed after [0-9]+ solves of a search")
                self.assertNotIn("fit.py failed", log)
                self.assert_same(self.path(name + "-reference"), output)

    def test_other_numbers_of_ranks(self):
        # The place of a critical load in its bracket depends on the last digits of the gap.
        scene = self.scene(DRY.replace("Threshold tolerance = 1e-3", "Threshold tolerance = 1e-7"))
        reference = self.reference(scene)
        output = self.path("moved")
        options = []
        for ranks, rows in ((2, 2), (3, 4), (1, 6)):
            with self.start(scene, output, *options, ranks=ranks) as process:
                self.wait_for_rows(process, output, rows)
                # mpirun passes this signal on and does not kill.
                process.send_signal(signal.SIGUSR1)
                message = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 3, message)
            options = ["--resume"]
        self.run_to_end(scene, output, "--resume", ranks=2)
        self.assertEqual(compare_tables.compare(
            os.path.join(reference, "leakage.csv"), os.path.join(output, "leakage.csv"),
            ACROSS_RANKS), [])

    def test_realisations(self):
        scene = self.scene(DRY.replace(", 0.054, 0.057", "") + """
subsection Realisations
  set Seeds = 1, 2, 3
end
""")
        reference = self.reference(scene)
        output = self.path("stopped")
        with self.start(scene, output) as process:
            self.wait_for_rows(process, os.path.join(output, "realisation-2"), 2)
            process.kill()
            process.communicate()
        first = os.path.join(output, "realisation-1")
        before = contents(first)
        self.assert_not_begun_anew(scene, output)
        self.run_to_end(scene, output, "--resume")
        self.assertEqual(contents(first), before)
        # A checkpoint of another realisation is refused before a table is written.
        shutil.copy(os.path.join(output, "realisation-1", "checkpoint"),
                    os.path.join(output, "realisation-2", "checkpoint"))
        self.assert_refused("had Surface/Seed = 1 where", scene, output)
        self.run_to_end(scene, output)  # a complete run may be repeated
        self.assert_same(reference, output)
        for number in (1, 2, 3):
            name = f"realisation-{number}"
            self.assert_same(os.path.join(reference, name), os.path.join(output, name))

    def stopped(self, scene, rows=3):
        output = self.path("stopped")
        with self.start(scene, output) as process:
            self.wait_for_rows(process, output, rows)
            process.kill()
            process.communicate()
        return output

    def assert_refused(self, pattern, scene, output, *options, ranks=1):
        before = contents(output)
        message = self.run_to_end(scene, output, "--resume", *options, status=2,
                                  ranks=ranks)
        self.assertRegex(message, pattern)
        self.assertEqual(len(message.splitlines()), 1, message)
        self.assertEqual(contents(output), before)

    def test_what_cannot_be_resumed(self):
        scene = self.scene(DRY)
        output = self.stopped(scene)
        changed = self.scene(DRY.replace("0.057", "0.058"), "changed.prm")
        for ranks in (1, 2):
            self.assert_refused("had Load programme/Pressures = .*0.057.* now has .*0.058",
                                changed, output, ranks=ranks)
        self.assert_refused("had Surface/Seed = 1 .* now has 2", scene, output,
                            "--set", "Surface/Seed=2")
        self.assert_refused("There is no checkpoint", scene, self.path("nowhere"))
        checkpoint = os.path.join(output, "checkpoint")
        with open(checkpoint, "rb") as file:
            whole = file.read()
        flipped = bytearray(whole)
        flipped[len(whole) // 2] ^= 1
        for spoilt in (b"", whole[:1], whole[:len(whole) // 2], whole[:-1], whole + b"x",
                       bytes(flipped), b"\x89HDF" + whole[4:], b"x" * len(whole)):
            with open(checkpoint, "wb") as file:
                file.write(spoilt)
            self.assert_refused("is not a whole checkpoint", scene, output)
        self.assert_refused("is not a whole checkpoint", scene, output, ranks=2)

    def test_another_map(self):
        """No run goes on, or begins anew, with a map other than the one it began with."""
        heights = self.path("heights.txt")
        text = [" ".join(f"{math.cos(.4 * i) * math.sin(.4 * j + k):.6f}" for i in range(32))
                for k in (0, 1) for j in range(32)]
        def write(lines):
            with open(heights, "w", encoding="utf-8") as file:
                file.write("\n".join(
                    ["# Width: 32 m", "# Height: 32 m", "# Value units: m", *lines, ""]))
        write(text[:32])
        of_map = f"""
subsection Surface
  set Kind = file
  set File = {heights}
end
subsection Load programme
  set Pressures = 0.05
end
subsection Output
  set Pictures = false
end
"""
        scene = self.scene(of_map + """
subsection Realisations
  set Orientations = as is, inverted
end
""", "map.prm")
        output = self.path("map")
        self.run_to_end(scene, output)
        write(text[32:])
        self.assert_refused("heights.txt.* is not the one that the run .* began with", scene, output)
        write(text[:32])
        self.run_to_end(scene, output, "--resume")

        # Nor is a stopped run replaced, as its own map may come back.
        loads = ", ".join(f"{.01 + .0002 * k:.4f}" for k in range(500))
        scene = self.scene(of_map.replace("0.05", loads), "loads.prm")
        output = self.path("loads")
        with self.start(scene, output) as process:
            self.wait_for_rows(process, output, 1)
            process.send_signal(signal.SIGTERM)
            message = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 3, message)
        write(text[32:])
        self.assert_not_begun_anew(scene, output)

    def assert_kept_out(self, scene, output, running):
        """No run enters the folder of another one, which is paused meanwhile."""
        running.send_signal(signal.SIGSTOP)
        try:
            before = contents(output)
            for ranks in (1, 2):
                for options in ((), ("--force",), ("--resume",)):
                    message = self.run_to_end(scene, output, *options, status=2, ranks=ranks)
                    self.assertRegex(message, "^strait: Another run is writing into '.*'; wait for "
                                     "it to end or choose another Output/Directory.\n$")
            self.run_to_end(scene, output, "--dry-run")
            self.assertEqual(contents(output), before)
        finally:
            running.send_signal(signal.SIGCONT)

    def test_two_in_one_folder(self):
        ensemble = DRY.replace(", 0.054, 0.057", "") + (
            "subsection Realisations\n  set Seeds = 1, 2\nend\n")
        for name, text, of_first in (("one", DRY, ""), ("several", ensemble, "realisation-1")):
            with self.subTest(name):
                scene = self.scene(text, name + ".prm")
                reference = self.path(name + "-reference")
                self.run_to_end(scene, reference)
                output = self.path(name)
                with self.start(scene, output) as process:
                    self.wait_for_rows(process, os.path.join(output, of_first), 1)
                    self.assert_kept_out(scene, output, process)
                    message = process.communicate(timeout=120)[1]
                self.assertEqual(process.returncode, 0, message)
                self.assert_same(reference, output)
                # One that is killed leaves no lock behind.
                shutil.rmtree(output)
                with self.start(scene, output) as process:
                    self.wait_for_rows(process, os.path.join(output, of_first), 1)
                    process.kill()
                    process.communicate()
                self.assertEqual(process.returncode, -signal.SIGKILL)
                self.run_to_end(scene, output, "--force")
                self.assert_same(reference, output)

    def test_files_of_the_user_are_kept(self):
        scene = self.scene(DRY)
        for name, text in (("parameters.prm", DRY), ("parameters.prm", "my notes\n"),
                           ("log.txt", "my notes\n")):
            with self.subTest(name, text=text[:8]):
                output = self.path(f"{name}-of-{len(text)}-characters")
                os.makedirs(output)
                with open(os.path.join(output, name), "w", encoding="utf-8") as file:
                    file.write(text)
                before = contents(output)
                refused = f"has a {name} that no run has written; .*--force"
                self.assertRegex(self.run_to_end(scene, output, status=2), refused)
                dry_run = [OPTIONS.program, scene, "--output", output, "--dry-run"]
                self.assertRegex(subprocess.check_output(dry_run, text=True),
                                 "a run would end here: .*" + refused)
                self.assertEqual(contents(output), before)
        self.run_to_end(scene, output, "--force")

    def test_full_disk(self):
        """Files may not exceed a limit, which the checkpoint reaches, and then the fields."""
        scene = self.scene(DRY)
        reference = self.reference(scene)
        output = self.path("full")
        options = []
        for rows, limit in ((1, 20000), (2, 60000)):
            with self.start(scene, output, "--set", "Output/Fields=all",
                            *options) as process:
                self.wait_for_checkpoint(process, output, rows)
                resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (limit, limit))
                message = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 1, message)
            self.assertRegex(message, "^strait: error: .*could not be written.*\n$")
            self.assertGreaterEqual(n_rows(output), rows)
            self.assertEqual(glob.glob(os.path.join(output, "*.new")), [])
            options = ["--resume"]
        self.run_to_end(scene, output, "--resume")
        self.assert_same(reference, output)


def main():
    global OPTIONS
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--folder", required=True, type=os.path.abspath)
    OPTIONS, rest = parser.parse_known_args()
    os.makedirs(OPTIONS.folder, exist_ok=True)
    unittest.main(argv=sys.argv[:1] + rest)


if __name__ == "__main__":
    main()
