#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Run the commands of the manual: README.md and doc/*.md.

    check_manual.py commands PROJECT PROGRAM FOLDER
    check_manual.py parameters PROJECT PROGRAM       is doc/parameters.md up to date?
    check_manual.py columns PROJECT PROGRAM          and the tables of doc/results.md?

A block of commands is fenced with ```sh, and a comment before it says what to do with it:

    <!-- manual: run -->                      run it
    <!-- manual: run: --set "A/B=c" -->       the same, with more arguments for strait
    <!-- manual: dry-run -->                  the same with --dry-run
    <!-- manual: skip: reason -->             leave it

An indented block, which tells how a table was made, is run with --dry-run if there is no
comment; a line that begins with … continues the command before it.

Everything happens in a copy of the project in FOLDER, where build/strait runs PROGRAM and
tools/setup does nothing. The blocks of a page run one after the other, each with `bash -e`,
and see the files that those before have written.
"""
import difflib
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

TIMEOUT = 240
TAG = re.compile(r"<!-- manual: (run|dry-run|skip)(?:: (.+))? -->$")
COMMAND = re.compile(r"\s*(…|(STRAIT_\w+=\S+ )*(tools/|build/|examples/|cmake |ctest |cpack|git |"
                     r"sudo |apt|python3 |/usr/bin/python3 |mpirun |strait ))")


class Block:
    """A block of commands, its place in the manual, and what is to be done with it."""

    def __init__(self, page, line, lines, fence, tag):
        self.place = f"{page.name}:{line}"
        self.text = self.without_ellipses(lines)
        self.problem = None
        if fence not in (None, "sh"):
            self.problem = "commands belong in a block that begins with ```sh"
        elif fence == "sh" and tag is None:
            self.problem = "no comment <!-- manual: … --> before it"
        self.how, detail = tag or ("dry-run", None)
        if self.how == "skip" and not detail:
            self.problem = "a skipped block must say why"
        self.arguments = ["--dry-run"] if self.how == "dry-run" else shlex.split(detail or "")

    @staticmethod
    def without_ellipses(lines):
        result, last = [], ""
        for line in lines:
            line = line.strip() if COMMAND.match(line) else line
            if line.startswith("…"):
                line = last + line[1:]
            elif COMMAND.match(line):
                last = line.split(" #")[0].rstrip()
            result.append(line)
        return "\n".join(result) + "\n"


def blocks_of(page):
    """All blocks of commands of a page, in order."""
    blocks, tag, tag_line = [], None, 0
    lines = page.read_text("utf-8").split("\n")
    k = 0
    while k < len(lines):
        match = TAG.match(lines[k])
        if match:
            tag, tag_line = match.groups(), k
        begin, body, fence = k, [], None
        if lines[k].startswith("```"):
            fence = lines[k][3:].strip()
            k += 1
            while k < len(lines) and not lines[k].startswith("```"):
                body.append(lines[k])
                k += 1
        elif lines[k].startswith("    ") and (k == 0 or not lines[k - 1].strip()):
            while k < len(lines) and lines[k].startswith("    "):
                body.append(lines[k])
                k += 1
        if body and (fence == "sh" or (fence in (None, "") and COMMAND.match(body[0]))):
            blocks.append(Block(page, begin + 1, body, fence, tag))
            tag = None
        elif tag and lines[k].strip() and k > tag_line:
            raise SystemExit(f"{page.name}:{tag_line + 1}: no commands follow this comment")
        k += 1
    return blocks


def pages_of(project):
    return [project / "README.md"] + sorted((project / "doc").glob("*.md"))


def make_copy(project, folder, package):
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("README.md", "prm", "tools", "doc", "tests", "python", "meshes"):
        source = project / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("fuzz", "*.cc"))
        else:
            folder.mkdir(parents=True)
            shutil.copy(source, folder / name)
    (folder / "tools" / "setup").write_text("#!/bin/sh\n", "utf-8")
    (folder / "build").mkdir()
    if package.is_dir():
        (folder / "build" / "python").symlink_to(package)


def install_program(program, folder, arguments):
    """Make build/strait a call of the program, with more arguments wherever it runs a scene."""
    wrapper = folder / "build" / "strait"
    wrapper.write_text(f"""#!/bin/sh
case "$*" in
*.prm*) exec {shlex.quote(str(program))} "$@" {shlex.join(arguments)} ;;
*) exec {shlex.quote(str(program))} "$@" ;;
esac
""", "utf-8")
    wrapper.chmod(0o755)


def run(block, program, folder):
    """Run a block; return what went wrong, or None."""
    install_program(program, folder, block.arguments)
    with subprocess.Popen(["bash", "-e", "-o", "pipefail", "-c", block.text], cwd=folder,
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL, start_new_session=True) as process:
        try:
            output, _ = process.communicate(timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 15)
            return f"still running after {TIMEOUT} s"
    if process.returncode == 0:
        return None
    return f"exit status {process.returncode}\n{block.text}{output}"


def check_commands(project, program, folder):
    package = program.parent / "python"
    make_copy(project, folder, package)
    n_run, problems = 0, []
    for page in pages_of(project):
        if page.name == "python.md" and not package.is_dir():
            continue
        shutil.rmtree(folder / "output", ignore_errors=True)
        for block in blocks_of(page):
            problem = block.problem
            if not problem and block.how != "skip":
                n_run += 1
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                problem = run(block, program, folder)
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
                print(f"{block.place}: {block.how}, {seconds:.1f} s", flush=True)
            if problem:
                problems.append(f"FAILED {block.place}: {problem}")
    print("\n".join(problems))
    if not n_run:
        problems.append("FAILED: no block of commands was found")
    shutil.rmtree(folder)
    return problems


def printed_by(program, option):
    """The lines of a reference that the program prints."""
    return subprocess.run([program, option, "md"], text=True, check=True,
                          stdout=subprocess.PIPE).stdout.splitlines()


def check_parameters(project, program):
    page = project / "doc" / "parameters.md"
    difference = list(difflib.unified_diff(page.read_text("utf-8").splitlines(),
                                           printed_by(program, "--parameters"),
                                           "doc/parameters.md",
                                           "strait --parameters md", n=0, lineterm=""))
    if difference:
        print("\n".join(difference))
        print("Bring it up to date with: tools/run --parameters md > doc/parameters.md")
    return difference


def check_columns(project, program):
    """Each printed section must be the beginning of that with the same heading in the page."""
    page = (project / "doc" / "results.md").read_text("utf-8").splitlines()
    printed = printed_by(program, "--columns")
    begins = [k for k, line in enumerate(printed) if line.startswith("## ")]
    problems = [] if begins else ["strait --columns md prints no table"]
    for begin, end in zip(begins, begins[1:] + [len(printed)]):
        section = printed[begin:end]
        at = page.index(section[0]) if section[0] in page else len(page)
        problems += difflib.unified_diff(page[at:at + len(section)], section, "doc/results.md",
                                         "strait --columns md", n=0, lineterm="")
    if problems:
        print("\n".join(problems))
        print("Bring the tables up to date from: tools/run --columns md")
    return problems


def main():
    what, project, program, *folder = sys.argv[1:]
    project, program = Path(project).resolve(), Path(program).resolve()
    if what == "commands":
        return 1 if check_commands(project, program, Path(folder[0]).resolve()) else 0
    check = {"parameters": check_parameters, "columns": check_columns}[what]
    return 1 if check(project, program) else 0


if __name__ == "__main__":
    sys.exit(main())
