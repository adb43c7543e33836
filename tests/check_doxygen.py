#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check that the headers are documented: check_doxygen.py DOXYFILE

Doxygen runs without writing pages. Each of its warnings is a failure, except for undocumented
members whose name is enough: fields, aliases, getters, constructors, operators, overrides, and
bind() and check() of parameters. Status 77 (a skipped test) where doxygen is not installed.
"""
import re
import shutil
import subprocess
import sys
import tempfile

UNDOCUMENTED = re.compile(r"Member (.*) \((\w+)\) of (\w+) (.+) is not documented")


def speaks_for_itself(warning):
    """Whether a warning is about a member that needs no docstring."""
    match = UNDOCUMENTED.search(warning)
    if not match:
        return False
    signature, kind, scope, scope_name = match.groups()
    if kind in ("variable", "typedef"):
        return scope != "namespace"
    if kind != "function" or scope == "namespace":
        return False
    name = signature.split("(")[0]
    return (name.startswith("operator") or name in ("bind", "check")
            or name == re.sub(r"<.*", "", scope_name).split("::")[-1]
            or signature.endswith(" override") or name[0].isupper()  # inherited
            or re.search(r"\(\)( const)?( override)?( ?=0)?$", signature) is not None)


def warnings_of(doxyfile):
    with open(doxyfile, encoding="utf-8") as file:
        settings = file.read()
    with tempfile.TemporaryDirectory() as folder:
        settings += f"\nOUTPUT_DIRECTORY = {folder}\nGENERATE_HTML = NO\nGENERATE_XML = YES\n"
        process = subprocess.run(["doxygen", "-"], input=settings, text=True, check=True,
                                 capture_output=True)
        # Further lines of a warning only list candidates.
        return sorted({line for line in process.stderr.splitlines() if "warning:" in line
                       or "error:" in line})


def main():
    if shutil.which("doxygen") is None:
        print("doxygen is not installed: the documentation of the code is not checked")
        return 77
    problems = [line for line in warnings_of(sys.argv[1]) if not speaks_for_itself(line)]
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
