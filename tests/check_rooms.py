#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check how rooms depend on each other: check_rooms.py PROJECT_FOLDER [--one-user]

A room is a folder of include/strait with the folder of source of the same name.

- A file includes only headers of its own room and of rooms before it in the list.
- The rooms that must compile quickly do not include deal.II.
- Each source has a header in the same place, or includes one of its room that several
  sources share. Every file names its licence in the first line.
- No header includes itself, not even through other headers and their sources.

The option --one-user lists the headers that only one other file of the library needs;
many of them would be better off inside that file.
"""
import os
import re
import sys

ROOMS = ["base", "spectral", "surface", "contact", "percolation",
         "interface", "flow", "theory", "seal", "run"]
WITHOUT_DEAL_II = ["base", "spectral", "surface", "contact", "percolation",
                   "theory"]
# Headers whose declarations may have a source each.
SHARED_HEADERS = ("base/memory.h", "base/parameter_table.h", "base/scene.h",
                  "surface/readers/height_map.h", "surface/map_processing.h",
                  "contact/gap_optimisation.h", "contact/optimisers.h",
                  "spectral/state_archive.h",
                  "percolation/channel.h", "interface/gap_field.h",
                  "flow/leakage.h", "flow/potential_problem.h", "flow/reynolds_solver.h",
                  "flow/seal_mesh.h",
                  "seal/fluid_on_wall.h", "seal/seal_models.h",
                  "run/field_output.h", "run/load_sweep.h", "run/output_directory.h",
                  "run/result_tables.h",
                  "run/simulation.h", "run/step.h")
LICENCE = "// SPDX-License-Identifier: GPL-2.0-or-later"
INCLUDE = re.compile(r"^\s*#\s*include\s*<([^>]+)>")


def files_of(folder, ending):
    for path, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            if name.endswith(ending):
                yield os.path.join(path, name)


def includes_of(path):
    with open(path, encoding="utf-8") as file:
        return [match.group(1) for match in map(INCLUDE.match, file) if match]


def check_file(project, path):
    relative = os.path.relpath(path, project)
    room = os.path.relpath(path, os.path.join(
        project, "source" if relative.startswith("source") else "include/strait")
    ).split(os.sep)[0]
    with open(path, encoding="utf-8") as file:
        if file.readline().rstrip("\n") != LICENCE:
            yield f"{relative}: the first line must be '{LICENCE}'"
    if relative == os.path.join("source", "main.cc"):
        return
    if room not in ROOMS:
        yield f"{relative}: '{room}' is not a room of the house"
        return
    for header in includes_of(path):
        if header.startswith("deal.II/") and room in WITHOUT_DEAL_II:
            yield f"{relative}: the room '{room}' must not include {header}"
        if not header.startswith("strait/"):
            continue
        other = header.split("/")[1]
        if not os.path.exists(os.path.join(project, "include", header)):
            yield f"{relative}: {header} does not exist"
        elif other not in ROOMS:
            yield f"{relative}: {header} is in no room of the house"
        elif ROOMS.index(other) > ROOMS.index(room):
            yield f"{relative}: the room '{room}' must not know {header}"


def check_mirror(project):
    for source in files_of(os.path.join(project, "source"), ".cc"):
        name = os.path.relpath(source, os.path.join(project, "source"))
        header = os.path.join(project, "include/strait", name[:-3] + ".h")
        shared = [f"strait/{header}" for header in SHARED_HEADERS
                  if os.path.dirname(header) == os.path.dirname(name)]
        if (name != "main.cc" and not os.path.exists(header)
                and not set(shared) & set(includes_of(source))):
            yield f"source/{name}: has no header include/strait/{name[:-3]}.h"


def check_guard(project):
    for path in files_of(os.path.join(project, "include"), ".h"):
        with open(path, encoding="utf-8") as file:
            if "\n#pragma once\n" not in file.read():
                relative = os.path.relpath(path, os.path.join(project, "include"))
                yield f"include/{relative}: has no line #pragma once"


def units_of(project):
    """The units that each unit includes: headers with their sources, without ending."""
    units = {}
    for folder, ending in (("include/strait", ".h"), ("source", ".cc")):
        top = os.path.join(project, folder)
        for path in files_of(top, ending):
            unit = os.path.relpath(path, top)[:-len(ending)]
            units.setdefault(unit, set()).update(
                header[len("strait/"):-len(".h")] for header in includes_of(path)
                if header.startswith("strait/"))
            units[unit].discard(unit)
    return units


def cycles_of(graph):
    """Strongly connected components of two or more nodes (Tarjan's algorithm)."""
    order, lowest, stack, cycles = {}, {}, [], []

    def visit(node):
        order[node] = lowest[node] = len(order)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in order:
                visit(other)
            if other in stack:
                lowest[node] = min(lowest[node], lowest[other])
        if lowest[node] == order[node]:
            start = stack.index(node)
            cycles.append(sorted(stack[start:]))
            del stack[start:]

    for node in sorted(graph):
        if node not in order:
            visit(node)
    return [cycle for cycle in cycles if len(cycle) > 1]


def check_cycles(project):
    for cycle in cycles_of(units_of(project)):
        yield (f"{', '.join(cycle)}: each of these includes the others, perhaps "
               "round a corner")


def headers_with_one_user(project):
    """Headers that only one file of the library includes, apart from their sources."""
    users = {}
    for folder, ending in (("include", ".h"), ("source", ".cc")):
        for path in files_of(os.path.join(project, folder), ending):
            own = "strait/" + os.path.relpath(path, os.path.join(project, "source"))[:-3] + ".h"
            for header in includes_of(path):
                if header != own:
                    users.setdefault(header, set()).add(path)
    return sorted(header for header, paths in users.items()
                  if header.startswith("strait/") and len(paths) == 1)


def main():
    project = os.path.abspath(sys.argv[1])
    sources = list(files_of(os.path.join(project, "source"), ".cc"))
    headers = list(files_of(os.path.join(project, "include"), ".h"))
    problems = [problem for path in sources + headers for problem in check_file(project, path)]
    problems += [*check_mirror(project), *check_guard(project), *check_cycles(project)]
    for problem in problems:
        print(problem)
    lonely = headers_with_one_user(project)
    if "--one-user" in sys.argv:
        print("\n".join(lonely))
    print(f"{len(sources)} sources and {len(headers)} headers, {len(lonely)} of them with "
          f"one user, {len(problems)} problems")
    return 1 if problems or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
