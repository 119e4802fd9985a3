#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solves the parts of prm/cad, from their STEP files on: faces are found, loads are right, finite elements are near.

    run_cad_parts.py --program build/perideal --scenes prm/cad [--mpirun "mpirun ..."]

The STEP files come with the package gmsh-doc. Where it is not installed, or documentation was left out, the status is 77.
"""

import argparse
import gzip
import json
import math
import os
import shlex
import shutil
import sys
from pathlib import Path

from checks import count_failures, expect
from execute import execute

DEMOS = Path("/usr/share/doc/gmsh-doc/doc/gmsh/demos/boolean")
STEP_FILES = ("as1-tu-203.stp", "component8.step")
# Tetrahedra coarser than those of the scenes, component of the load, its value from the CAD sizes [N], Q1's distance.
# Bores: 10 mm wide and 10 mm or 20 mm deep; the nut's: 919.393 mm^2 twice and its upper chamfer. The plate is lifted on
# the walls of its bores along their axes.
PARTS = {"bracket": (10, 0, 10e6 * math.pi * 1e-4, 0.1),
         "plate": (25, 2, 1e6 * 6 * 314.159e-6, 0.15),
         "nut": (6, 1, 50e6 * 2 * 919.393e-6, 0.06)}


def solve(name, launcher, arguments, folder):
    size, component, load, limit = PARTS[name]
    for file in STEP_FILES:
        (folder / file).write_bytes(gzip.decompress((DEMOS / (file + ".gz")).read_bytes()))
    text = (arguments.scenes / f"{name}.geo").read_text(encoding="utf-8")
    expect("DefineConstant[ Size = " in text, "the size of the mesh is no constant")
    (folder / f"{name}.geo").write_text(text + f"Mesh.MeshSizeMax = {size};\n", encoding="utf-8")
    shutil.copy(arguments.scenes / f"{name}.prm", folder)
    status, out, err = execute([*launcher, arguments.program, f"{name}.prm", "--set", "Output directory=output"], folder, 300)
    expect(status == 0, f"exit status {status}\n{out}{err}")
    summary = json.loads((folder / "output" / "summary.json").read_text(encoding="utf-8"))
    expect(summary["solver"]["converged"], "not converged")
    total = summary["loads"]["total"]["applied"]["force"][component]
    expect(0.94 * load < abs(total) < 1.005 * load, f"the load is {total:g} N, not {load:g} N less what polygons cut off")
    held = summary["reactions"]["held"][component]
    expect(math.isclose(held, -total, rel_tol=1e-6), f"the supports bear {held:g} N of {total:g} N")
    error = summary["errors"]["fem"]["l2"]
    expect(error < limit, f"finite elements are {error:g} off")


def main():
    parser = argparse.ArgumentParser(description="solves the parts of prm/cad")
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("--scenes", required=True, type=Path)
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe", help="default: %(default)s")
    arguments = parser.parse_args()
    if not all((DEMOS / (file + ".gz")).exists() for file in STEP_FILES):
        print(f"skipped: {DEMOS} has not {' and '.join(STEP_FILES)} (apt-get install gmsh-doc)")
        return 77
    launcher = [*shlex.split(arguments.mpirun), "-n", "2"]
    return 1 if count_failures([(name, lambda folder, name=name: solve(name, launcher, arguments, folder)) for name in PARTS]) else 0


if __name__ == "__main__":
    sys.exit(main())
