#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holds every include of the library, and the table of source/README.md, against the table of rooms.

A room may include itself and rooms of lower floors, never a sibling of its own
floor. Own headers are included as <perideal/room/file.h>, never by a relative path.

    check_includes.py [ROOT]       checks ROOT/include/perideal and ROOT/source
    check_includes.py --self-test  shows that each kind of violation is found
"""

import re
import sys
import tempfile
from pathlib import Path

FLOORS = {
    "base": 0,
    "parameters": 1,
    "geometry": 1,
    "mesh": 2,
    "nodes": 3,
    "fem": 3,
    "neighbourhood": 4,
    "quadrature": 5,
    "reconstruction": 5,
    "output": 5,
    "materials": 6,
    "fracture": 6,
    "boundary": 6,
    "operators/weights": 7,
    "operators/force": 8,
    "operators/linear": 9,
    "operators/system": 10,
    "operators/post": 11,
    "solvers": 11,
    "treatments": 12,
    "problem": 13,
    "recorders": 14,
    "drivers": 15,
    "application": 16,
}

README_ROW = re.compile(r"^\|\s*(\d+)\s*\|\s*`([\w/]+)`\s*\|", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def check_line(room, line):
    """The violation that a line of a file in a room commits, or None."""
    match = INCLUDE.match(line)
    if not match:
        return None
    bracket, target = match.groups()
    if bracket == '"' or target.startswith("."):
        return f"{target}: own headers are included as <perideal/room/file.h>, all others in < >"
    parts = target.split("/")
    if parts[0] != "perideal":
        return None
    included = "/".join(parts[1:-1])
    if included not in FLOORS:
        return f"{target}: not of the form <perideal/room/file.h> with a room of the table"
    if included == room or FLOORS[included] < FLOORS[room]:
        return None
    where = "a sibling" if FLOORS[included] == FLOORS[room] else "above"
    return f"{target}: room {room} (floor {FLOORS[room]}) must not include {included} (floor {FLOORS[included]}), {where}"


def check_file(path, folder):
    """Violations of one file below include/perideal or source."""
    room = path.relative_to(folder).parent.as_posix()
    if room not in FLOORS:
        return [f"{path}: not directly in a room of the table ({', '.join(FLOORS)})"]
    violations = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        violation = check_line(room, line)
        if violation:
            violations.append(f"{path}:{number}: {violation}")
    return violations


def check_tree(root):
    """(number of files, violations) of a source tree."""
    files, violations = 0, []
    for folder in (root / "include" / "perideal", root / "source"):
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".h", ".cc"):
                files += 1
                violations += check_file(path, folder)
    return files, violations


def check_readme(text):
    """Where the table of rooms in source/README.md differs from FLOORS."""
    rows = [(room, int(floor)) for floor, room in README_ROW.findall(text)]
    if rows == list(FLOORS.items()):
        return []
    different = sorted(set(rows) ^ set(FLOORS.items())) or "the order of the rooms"
    return [f"source/README.md: its table of rooms is not that of tests/check_includes.py: {different}"]


def self_test():
    """Every good file passes and every bad one is found."""
    cases = [
        ("source/base/good.cc", "#include <perideal/base/types.h>\n#include <deal.II/base/mpi.h>", 0),
        ("include/perideal/solvers/good.h", "#include <perideal/mesh/mesh.h>", 0),
        ("include/perideal/application/good.h", "#include <perideal/solvers/solver.h>", 0),
        ("source/nodes/sibling.cc", "#include <perideal/fem/elastic_fem.h>", 1),
        ("source/output/sibling.cc", "#include <perideal/quadrature/scheme.h>", 1),
        ("source/operators/force/good.cc", "#include <perideal/operators/weights/bond_weights.h>", 0),
        ("source/operators/weights/upwards.cc", "#include <perideal/operators/force/bond_force.h>", 1),
        ("include/perideal/mesh/upwards.h", "\n  #  include <perideal/nodes/nodes.h> // why", 1),
        ("source/base/upwards.cc", "#include <perideal/application/report.h>", 1),
        ("source/base/quotes.cc", '#include "types.h"', 1),
        ("source/base/relative.cc", "#include <../mesh/mesh.h>", 1),
        ("source/base/unknown.cc", "#include <perideal/cellar/wine.h>", 1),
        ("source/base/roomless.cc", "#include <perideal/types.h>", 1),
        ("source/cellar/wine.cc", "", 1),
        ("source/stray.cc", "", 1),
    ]
    failures = 0
    for path, text, expected in cases:
        with tempfile.TemporaryDirectory() as root:
            file = Path(root) / path
            file.parent.mkdir(parents=True)
            file.write_text(text, encoding="utf-8")
            files, violations = check_tree(Path(root))
        if files != 1 or len(violations) != expected:
            failures += 1
            print(f"{path}: {len(violations)} violations found instead of {expected}")
    table = "".join(f"| {floor} | `{room}` | what it holds |\n" for room, floor in FLOORS.items())
    readmes = [(table, 0), (table.replace("| 2 | `mesh`", "| 3 | `mesh`"), 1), (table.replace("mesh", "cellar"), 1), ("", 1)]
    for text, expected in readmes:
        if len(check_readme(text)) != expected:
            failures += 1
            print(f"{text}: {check_readme(text)} instead of {expected} violations")
    n_cases = len(cases) + len(readmes)
    print(f"self-test: {n_cases - failures} of {n_cases} cases as expected")
    return 1 if failures else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    files, violations = check_tree(root)
    violations += check_readme((root / "source" / "README.md").read_text(encoding="utf-8"))
    for violation in violations:
        print(violation)
    print(f"{files} files, {len(violations)} violations")
    return 1 if violations or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
