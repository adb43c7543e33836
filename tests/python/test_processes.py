#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The package under signals, in other processes, on several ranks and at the end of a script."""
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

SCENE = """
import sys, strait
scene = strait.Scene({"Contact/Grid points": 128, "Surface/Short cut-off wavelength": 0.0625,
                      "Fluid/Target accuracy": 0.05})
# A solve takes minutes, so that a signal comes within it.
long = scene.replace({"Contact/Grid points": 1024, "Contact/Tolerance": 1e-13,
                      "Contact/Solver": "polonsky-keer", "Contact/Maximum iterations": 10**5})
"""


def run(script, *command, **options):
    return subprocess.run([*command, sys.executable, "-c", SCENE + textwrap.dedent(script)],
                          text=True, capture_output=True, check=False, timeout=120, **options)


class Surroundings(unittest.TestCase):
    """What the script has set up, and what may go wrong there."""

    def test_output_that_knows_few_characters(self):
        done = run("scene.describe()", "env", "PYTHONIOENCODING=ascii")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("grid 128 ? 128", done.stdout)

    def test_output_that_is_full(self):
        done = run("""
            class Full:
                def write(self, text):
                    raise OSError("full")
                def flush(self):
                    pass
            for call in (scene.describe, lambda: scene.run(verbose=True)):
                sys.stdout, screen = Full(), sys.stdout
                try:
                    call()
                except OSError as error:
                    print(error, file=screen)
                sys.stdout = screen
            """)
        self.assertEqual((done.stdout, done.returncode), ("full\nfull\n", 0), done.stderr)

    def test_warnings_as_errors(self):
        done = run("""
            import warnings
            warnings.simplefilter("error")
            try:
                strait.Seal(scene.replace({"Contact/Adhesion/Range": 0.1}))
            except strait.SceneWarning:
                print("caught")
            """)
        self.assertEqual((done.stdout, done.returncode), ("caught\n", 0), done.stderr)

    def test_handlers_of_signals_are_kept(self):
        script = """
            import os, signal, strait
            signal.signal(signal.SIGTERM, lambda *_: print("handled", flush=True))
            strait.Scene()
            os.kill(os.getpid(), signal.SIGTERM)
            read_end, write_end = os.pipe()
            os.close(read_end)
            try:
                os.write(write_end, b"x")
            except BrokenPipeError:
                print("broken pipe")
            """
        done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], text=True,
                              capture_output=True, check=False, timeout=120)
        self.assertEqual((done.stdout, done.returncode), ("handled\nbroken pipe\n", 0), done.stderr)


class Interrupted(unittest.TestCase):
    def interrupt(self, script, most_seconds=30):
        """Interrupt a script half a second after it prints "begun"; return what it prints then."""
        with subprocess.Popen([sys.executable, "-uc", SCENE + textwrap.dedent(script)], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
            self.assertEqual(process.stdout.readline(), "begun\n")
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            began = time.monotonic()
            try:
                printed, _ = process.communicate(timeout=60)
            except subprocess.TimeoutExpired:
                process.kill()
                self.fail("goes on for a minute: " + process.communicate()[0])
        self.assertLess(time.monotonic() - began, most_seconds)
        self.assertEqual(process.returncode, 0, printed)
        return printed

    def test_within_a_long_solve(self):
        for call in ("strait.Seal(long).solve(0.1)", "long.run()"):
            with self.subTest(call):
                printed = self.interrupt(f"""
                    print("begun")
                    try:
                        {call}
                    except KeyboardInterrupt:
                        print("interrupted")
                    """, 5)
                self.assertEqual(printed, "interrupted\n")

    def test_a_handler_must_not_solve_what_it_interrupts(self):
        printed = self.interrupt("""
            import signal
            seal = strait.Seal(long)
            signal.signal(signal.SIGINT, lambda *_: seal.solve(0.2))
            print("begun")
            try:
                seal.solve(0.1)
            except RuntimeError as error:
                print(error)
            """)
        self.assertIn("This seal is being solved", printed)

    def test_a_run_stops_within_a_step_and_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            printed = self.interrupt(f"""
                import signal, threading
                scene = scene.replace({{"Load programme/Pressures": [0.05 + 0.0001 * k
                                        for k in range(1000)], "Output/Pictures": False}})
                print("begun")
                try:
                    scene.run({folder!r})
                except KeyboardInterrupt:
                    print("interrupted")
                n_rows = strait.Run({folder!r}).table.n_rows
                try:
                    scene.run({folder!r})
                except strait.SceneError as error:
                    print("not come to its end" in str(error))
                threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGTERM)).start()
                try:
                    scene.run({folder!r}, resume=True)
                except KeyboardInterrupt as stop:
                    print(stop, n_rows < strait.Run({folder!r}).table.n_rows)
                short = scene.replace({{"Load programme/Pressures": 0.1}}).run()
                print(0 < n_rows < 1000, short.table.n_rows)
                print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)
                """)
            self.assertTrue(printed.startswith("interrupted\nTrue\nStopped by SIGTERM after a "
                                               "complete step"), printed)
            self.assertIn("continues. True\n", printed)
            self.assertTrue(printed.endswith("True 1\nTrue\n"), printed)

    def test_paths_searches_and_sweeps(self):
        for call in ("seal.follow([0.05 + 1e-6 * k for k in range(10**5)])",
                     "[seal.solve(0.1) for _ in range(10**5)]",
                     "[seal.find_transition() for _ in range(10**5)]",
                     "strait.sweep(scene, {'Surface/Seed': range(1, 10**4)}, processes=2)",
                     "strait.sweep(scene, {'Surface/Seed': range(1, 10**4)})"):
            with self.subTest(call):
                printed = self.interrupt(f"""
                    seal = strait.Seal(scene)
                    print("begun")
                    try:
                        {call}
                    except KeyboardInterrupt:
                        print("interrupted")
                    print(seal.solve(0.1).converged)
                    """)
                self.assertEqual(printed, "interrupted\nTrue\n")


class Ended(unittest.TestCase):
    def test_what_lives_on_at_the_end(self):
        ended = run("""
            sys.argv[:] = ["script", "--mca", "nonsense", "-log_view"]  # are the script's own
            seal = strait.Seal(scene)
            flow = seal.flow(seal.solve(0.1), fields=True)
            class Late:
                def __del__(self):
                    flow.leak_rate, seal.rms_slope
            late = Late()
            print(sys.argv)
            """)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("nonsense", ended.stdout)

    def test_mpi_starts_when_it_is_needed(self):
        started = subprocess.run(
            [sys.executable, "-c", textwrap.dedent("""
                import ctypes
                import strait
                for step in (lambda: None, strait.Scene):
                    step()
                    flag = ctypes.c_int()
                    ctypes.CDLL(strait._core.__file__).MPI_Initialized(ctypes.byref(flag))
                    print(flag.value)
                """)], text=True, capture_output=True, check=True)
        self.assertEqual(started.stdout, "0\n1\n")

    def test_exit_status_of_an_exception(self):
        ended = run("scene.replace({'Contact/Grid points': 'many'})")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("strait.SceneError: --set", ended.stderr)


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
class Ranks(unittest.TestCase):
    def run_on_two(self, script):
        return run(script, "mpirun", "-n", "2")

    def test_a_rank_has_its_rows(self):
        script = """
            seal = strait.Seal(scene)
            state = seal.solve(0.1)
            whole = scene.heights()
            same = strait.Seal(scene, whole).solve(0.1).contact_area == state.contact_area
            table = scene.run().table
            sys.stdout.write(f"{state.gap.shape} {state.first_row} {same} "
                             f"{seal.flow(state).leak_rate:.2g} {table['leak_rate'][1]:.2g}\\n")
            """
        alone, both = run(script), self.run_on_two(script)
        self.assertEqual((alone.returncode, both.returncode), (0, 0), both.stderr)
        rate = alone.stdout.split()[-1]
        self.assertEqual(sorted(both.stdout.splitlines()),
                         [f"(64, 128) {row} True {rate} {rate}" for row in (0, 64)])

    def test_communicators_of_mpi4py(self):
        ended = self.run_on_two("""
            try:
                from mpi4py import MPI
            except ImportError:
                print("there is no mpi4py")
                sys.exit()
            own = strait.Seal(scene, comm=MPI.COMM_SELF).solve(0.1 + 0.1 * MPI.COMM_WORLD.rank)
            area = strait.Seal(scene, comm=MPI.COMM_WORLD).solve(0.2).contact_area
            sys.stdout.write(f"{own.gap.shape} {own.contact_area == area}\\n")
            """)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        if "there is no mpi4py" not in ended.stdout:
            self.assertEqual(sorted(ended.stdout.splitlines()),
                             ["(128, 128) False", "(128, 128) True"])

    def test_sweeps(self):
        script = """
            table = strait.sweep(scene, {"Surface/Seed": [1, 2]}, processes=%d)
            sys.stdout.write(f"{table['leak_rate'][3]:.1e}\\n")
            """
        rate = run(script % 2, "mpirun", "-n", "1").stdout
        self.assertEqual(self.run_on_two(script % 1).stdout, 2 * rate)
        self.assertIn("leave out processes", self.run_on_two(script % 2).stderr)

    def test_one_rank_that_fails_ends_all(self):
        for failure in ("raise RuntimeError('only here')", "sys.exit('only here')",
                        "raise SystemExit('only here')"):
            with self.subTest(failure):
                began = time.monotonic()
                ended = self.run_on_two(f"""
                    if strait.Seal(scene).solve(0.1).first_row > 0:
                        {failure}
                    scene.run()  # waits for the other
                    """)
                self.assertNotEqual(ended.returncode, 0)
                self.assertIn("only here", ended.stderr)
                self.assertLess(time.monotonic() - began, 30)


if __name__ == "__main__":
    unittest.main()
