#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check that clang-format 14 would change nothing: check_format.py PROJECT_FOLDER

Status 77 (a skipped test) where clang-format 14 is not installed: another
version formats differently.
"""
import os
import re
import shutil
import subprocess
import sys


def find_clang_format():
    for name in ("clang-format-14", "clang-format"):
        program = shutil.which(name)
        if program and " version 14." in subprocess.run(
                [program, "--version"], capture_output=True, text=True, check=True).stdout:
            return program
    return None


def main():
    project = sys.argv[1]
    program = find_clang_format()
    if program is None:
        print("clang-format 14 is not installed: the format is not checked")
        return 77
    files = [os.path.join(path, name)
             for folder in ("include", "source", "python", "tests")
             for path, _, names in os.walk(os.path.join(project, folder))
             for name in sorted(names) if name.endswith((".h", ".cc"))]
    output = subprocess.run([program, "--dry-run"] + files, check=False,
                            capture_output=True, text=True).stderr
    unformatted = sorted(set(re.findall(r"^(.*?):\d+:\d+: warning", output, re.MULTILINE)))
    for path in unformatted:
        print(f"clang-format would change {os.path.relpath(path, project)}")
    return 1 if unformatted else 0


if __name__ == "__main__":
    sys.exit(main())
